"""Hard cases of waves.sea, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.hard.mutations import PLACE
from support.scenes import Camera, Foam, Ripples, Scene, Sea, Water, WhitecapSaturation

_NEAR = Camera(position=(0.37, 9.0, -0.21), yaw=1.0, pitch=-0.3)

_INVISIBLE = (Scene(sea=Sea(wind=0.0)), Scene(sea=Sea(), light=None))

_HARD = (
    HardCase(
        "a sea without wind",
        Scene(sea=Sea(wind=0.0), foam=Foam(saturation=(WhitecapSaturation(),))),
        guard="the spectrum is 0 without wind (ocean/waves/cascades.py)",
        camera=_NEAR,
        without={
            "effects/waves/sea.py": {" or scene.sea.wind_speed <= 0.0": ""},
            "ocean/waves/cascades.py": {
                "if sea.wind_speed <= 0.0:": "if sea.wind_speed < 0.0:",
                "sea.wind_speed > 0.0 and": "",
            },
            "ocean/basics/spectrum.py": {"if wind <= 0.0:": "if wind < 0.0:"},
        },
        error="ZeroDivisionError",
    ),
    HardCase(
        "the open sea at any time",
        Scene(sea=Sea(wind=8.0)),
        guard="every frequency is a multiple of 2π per loop, and the time in the loop is reduced in float64 "
        "(waves/sea_passes.glsl@spectrum)",
        times=(-1e9, 1e9),
        camera=_NEAR,
        without={
            "framegraph/evaluation.py": {
                "(_modulo(state.time + rule.offset, rule.period),)": "(state.time + rule.offset,)"
            }
        },
    ),
    HardCase(
        "the open sea ten thousand kilometres away",
        Scene(sea=Sea(wind=8.0, model="gerstner")),
        guard="the camera's position in each tile is reduced in float64 (framegraph/evaluation.py)",
        camera=Camera(position=(-1e7, 9.0, 1e7), yaw=1.0, pitch=-0.3),
        without=PLACE,
    ),
    HardCase(
        "a hurricane that has blown over a hundred metres",
        Scene(sea=Sea(wind=60.0, fetch=100.0, choppiness=1.0)),
        guard="choppiness is reduced until the Jacobian is negative at one point in 60 000 (ocean/waves/cascades.py)",
        camera=_NEAR.model_copy(update={"position": (0.37, 8.711393, -0.21)}),
        without={"ocean/waves/cascades.py": {"requested if requested * slope <= TILT else TILT / slope": "requested"}},
    ),
    HardCase(
        "a breath of wind, and no wave on the largest tile",
        Scene(sea=Sea(wind=0.4, fetch=100.0, spread=100.0, against=0.0), water=Water(ripples=Ripples())),
        guard="the divisor is at least 1e-30 where slopes are clamped (waves/sea_passes.glsl@tile_pass)",
        camera=_NEAR,
        without={
            "waves/sea_passes.glsl": {
                "slope *= min(1.0, u_sea_limit.y / max(length(slope), 1e-30))": (
                    "slope = min(length(slope), u_sea_limit.y) * normalize(slope)"
                )
            }
        },
    ),
)

CASES = {"sea": Cases(invisible=_INVISIBLE, hard=_HARD)}
