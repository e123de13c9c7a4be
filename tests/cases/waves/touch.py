"""Hard cases of waves.touch, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.hard.mutations import PLACE, TIME, guards
from support.scenes import (
    TOUCHES_MOST,
    Camera,
    Current,
    Foam,
    HeightSaturation,
    ParametricWave,
    Ripples,
    Scene,
    Sea,
    Touch,
    Water,
)

_NEAR = Camera(position=(0.0, 2.0, 0.0), pitch=-0.45)
_TRAIN = tuple(Touch(place=(0.35 * i - 2.0, -4.0 - 0.1 * i), time=0.15 * i - 2.0) for i in range(12))


def _moved(touches: tuple[Touch, ...], by: tuple[float, float]) -> tuple[Touch, ...]:
    return tuple(
        touch.model_copy(update={"place": (touch.place[0] + by[0], touch.place[1] + by[1])}) for touch in touches
    )


_INVISIBLE = (
    Scene(touches=(Touch(strength=0.0), Touch(strength=1e-4))),
    Scene(waves=(ParametricWave(),), foam=Foam(), touches=_TRAIN, light=None),
)

_HARD = (
    HardCase(
        "as many touches as there may be, at one place",
        Scene(touches=(Touch(strength=0.004, time=-0.5),) * TOUCHES_MOST),
        guard="slopes without height, so no ray misses a crest (waves/rings.glsl@touch)",
        camera=_NEAR,
        without={
            "waves/rings.glsl": {
                "vec3 touches_detail(vec2 p, Footprint fp) {": (
                    "vec3 touched(vec2 p, Footprint fp, bool high);\n"
                    "vec3 touches_waves(vec2 p) {\n"
                    "    return touched(p, Footprint(vec2(0.0), vec2(0.0)), true);\n"
                    "}\n"
                    "vec4 touches_shading(vec2 p, Footprint fp) {\n"
                    "    return vec4(touched(p, fp, true).x, touched(p, fp, false));\n"
                    "}\nvec3 touched(vec2 p, Footprint fp, bool high) {"
                ),
                "sum += vec3(kept": "sum += high ? vec3(ring.x, ring.y * ring.z * way) : vec3(kept",
            },
            "effects/waves/rings.py": {
                'SlotFile("detail"': 'SlotFile("waves"',
                "bound=effect.Bound.zero_if(": (
                    "max_height=0.004, min_height=-0.004, max_slope=1.0, bound=effect.Bound.zero_if("
                ),
            },
        },
        missed_by=guards("waves", "no_ray_misses_a_ring_of_touches"),
    ),
    HardCase(
        "touches a thousand million seconds from now",
        Scene(touches=tuple(touch.model_copy(update={"time": 1e9 + touch.time}) for touch in _TRAIN[-1:])),
        guard="ages are reduced in float64 (framegraph/evaluation.py)",
        times=(1e9 - 8.0, 1e9, 1e9 + 0.75),
        camera=_NEAR,
        without=TIME,
    ),
    HardCase(
        "touches ten thousand kilometres away",
        Scene(touches=_moved(_TRAIN, (1e7 - 8.0, -1e7 + 8.0)), water=Water(ripples=Ripples())),
        guard="the vector from the centre to the camera is reduced in float64 (framegraph/evaluation.py)",
        camera=Camera(position=(1e7 - 8.0, 2.0, -1e7 + 8.0), pitch=-0.45),
        without=PLACE,
    ),
    HardCase(
        "touches long over, and touches of no strength",
        Scene(touches=(*_TRAIN, Touch(strength=0.0)), foam=Foam(saturation=(HeightSaturation(),))),
        guard="negative amplitudes count as 0, and strengths of 0 are passed over (waves/rings.glsl@ring)",
        times=(12.0, 1e9),
        camera=_NEAR,
        without={"waves/rings.glsl": {"amplitude <= 0.0 || rho": "rho", "touch.w <= 0.0 || !ring": "!ring"}},
    ),
    HardCase(
        "touches of a river thirty years after its current set in",
        Scene(
            current=Current(speed=2.0, direction=0.6),
            touches=tuple(touch.model_copy(update={"time": 9e8 + touch.time}) for touch in _TRAIN),
        ),
        guard="velocity times the time of the touch and velocity times time cancel in float64 (effects/waves/rings.py)",
        times=(9e8,),
        camera=_NEAR,
        without=TIME,
    ),
)

_VARIANTS = (
    Scene(sea=Sea(), touches=_TRAIN),
    Scene(waves=(ParametricWave(),), water=Water(ripples=Ripples(), depth=2.0), touches=_TRAIN),
)

CASES = {"touch": Cases(invisible=_INVISIBLE, hard=_HARD, variants=_VARIANTS)}
