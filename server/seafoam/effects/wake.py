"""The waves that boats leave behind them: from a map drawn each frame, or worked out at each place.

docs/formulae.md, section 15.
"""

import math

from seafoam.effects.boat import COURSE
from seafoam.effects.contribution import (
    UNBOUNDED,
    Bound,
    Const,
    Constant,
    Contribution,
    Effect,
    FixedSize,
    HardCase,
    Knob,
    PassSpec,
    SlotFile,
    Target,
    TargetInput,
    array,
    number,
    significant,
)
from seafoam.quality import Quality
from seafoam.scene.boats import NEAR, Boat, Wake, wake_level, wake_slope, wakes
from seafoam.scene.models import Camera, Foam, Scene, SlopeSaturation

ASIDE = 0.36
"""A wake is so wide to each side, in its lengths: just more than Kelvin's tan 19.47 degrees."""
WAY = (COURSE, "wake/way.glsl")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any boat."""
    if not scene.boats:
        return None
    level, steepest = wake_level(scene.boats), wake_slope(scene.boats)
    count, size = len(scene.boats), quality.wake_size
    pattern = ("common/numbers.glsl", COURSE, "wake/pattern.glsl")
    forms = array(
        "vec4",
        [
            Constant(
                value=(
                    significant(wake.k),
                    wake.boat.wake if wake.shows else 0.0,
                    significant(wake.length),
                    significant(wake.shortest),
                )
            )
            for wake in wakes(scene.boats)
        ],
        count,
    )
    mapped = quality.wake == "map"
    bounds = [_bounds(wake, size if mapped else None) for wake in wakes(scene.boats)]
    consts: dict[str, Const] = {"WAKE_SIZE": size, "WAKE_ASIDE": ASIDE, "WAKE_NEAR": NEAR}
    here = ("wake/map.glsl",) if mapped else ("wake/pattern.glsl", "wake/exact.glsl")
    drawn = PassSpec(
        name=f"wakes, {size} texels along",
        program="wake",
        fragment=(*pattern, "wake/map_pass.glsl"),
        target="wake",
    )
    return Contribution(
        why=f"wakes up to {level:.2g} m high",
        slots=(
            SlotFile("waves", "wake/waves.glsl", prefix="wakes", needs=(*WAY, *here)),
            SlotFile("bounds", "wake/bounds.glsl", prefix="wakes"),
        ),
        consts=consts,
        uniforms={
            "u_wake": forms,
            "u_wake_level": number(level),
            "u_wake_bounds": array("vec3", [Constant(value=of) for of in bounds], count),
        },
        inputs={"u_wake_map": TargetInput(target="wake")} if mapped else {},
        targets={
            "wake": Target(
                size=FixedSize(width=size, height=size // 2 * count),
                format="RGBA16F",
                filter="linear",
            )
        }
        if mapped
        else {},
        passes=(drawn,) if mapped else (),
        bound=Bound(0.0, "no boat moves, or none raises a wave") if level == 0.0 else None,
        top=2.0 * level,
        steepest=steepest,
        curvature=sum(near for _, near, _ in bounds),
        grain=significant(sum(wake.grain(wake.length / size) for wake in wakes(scene.boats))) if mapped else 0.0,
        march=2,
    )


def _bounds(wake: Wake, texels: int | None) -> tuple[float, float, float]:
    """Greatest slope, and greatest second derivatives (1/m); of a map it turns by twice its slope at most a texel."""
    near, far = wake.curvature
    held = UNBOUNDED
    if texels is not None and wake.shows:
        held = 2.0 * wake.steepest / (0.75 * min(1.0, 2.0 * ASIDE) * wake.length / texels)
    return significant(wake.steepest), significant(min(near, held)), significant(min(far, held))


_FAST = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0, wake=0.3)
_ABOVE = Camera(position=(0.0, 30.0, -20.0), pitch=-math.pi / 2)

EFFECT = Effect(
    "wakes",
    contribute,
    invisible=(
        Scene(boats=(_FAST.model_copy(update={"speed": 0.0}),)),
        Scene(boats=(_FAST.model_copy(update={"wake": 0.0}),)),
    ),
    knobs=(
        Knob("/wake", "wakes", ("map", "exact"), "geometry"),
        Knob("/wake_size", "texels along the map of a wake", (128, 256, 512, 1024), "geometry"),
    ),
    hard_cases=(
        HardCase(
            name="the edge of a wake, where both systems meet",
            scene=Scene(boats=(_FAST,), foam=Foam(saturation=(SlopeSaturation(),), look="textured")),
            guard="the wake opens where the root is no longer 0 (wake/pattern.glsl)",
            without="2.6 % of samples off by more than 2 levels, the worst by 213: a wall of water at the wake's edge",
            camera=_ABOVE,
        ),
        HardCase(
            name="the centre of a boat's circle, and straight behind it",
            scene=Scene(boats=(_FAST.model_copy(update={"radius": 13.5}),)),
            guard="at least a tenth of the radius, a tangent of at most 5000 (wake/way.glsl, wake/pattern.glsl)",
            without="nothing on llvmpipe: no sample of the frame is there to its last bit",
            camera=_ABOVE.model_copy(update={"position": (0.0, 20.0, -30.0)}),
        ),
        HardCase(
            name="a wake from thirty years ago",
            scene=Scene(boats=(_FAST,)),
            guard="the bearing on the course reduced in float64 (plan/rules.py)",
            without="in float32 at 1e9 s bearings are 8 rad apart: the wake is anywhere on the circle",
            times=(-1e9, 1e9),
            camera=_ABOVE,
        ),
    ),
)
