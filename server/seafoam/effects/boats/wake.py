"""The waves that boats leave behind them: from a map drawn each frame, or worked out at each place.

docs/formulae.md, section 15.
"""

from seafoam.effects.boats.boat import COURSE
from seafoam.effects.effect import Bound, Const, Contribution, Effect, Inline, Knob, PassSpec, SlotFile
from seafoam.effects.waves.measured import BLOCK
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, array, number, significant
from seafoam.ocean.wakes import NEAR, wake_height, wake_slope, wakes
from seafoam.quality import Quality
from seafoam.scene.models import Scene

ASIDE = 0.36
"""A wake is so wide to each side, in its lengths: just more than Kelvin's tan 19.47 degrees."""
AWAY = (0, 2, 4, 8)
"""Lengths from a boat's middle from which on its wake's curvature is told: the window at the bow bends it most."""
WAY = (COURSE, "boats/wake/way.glsl")
READ = {"map": "wake", "bounds": "wake_bounds"}


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by any boat."""
    if not scene.boats:
        return None
    height, steepest = wake_height(scene.boats), wake_slope(scene.boats)
    count, size = len(scene.boats), quality.wake_size
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
    bounds = [(significant(wake.max_slope), *map(significant, wake.curvature)) for wake in wakes(scene.boats)]
    declared = {
        "u_wake_highest": number(height),
        "u_wake_bounds": array("vec3", [Constant(value=of) for of in bounds], count),
    }
    consts: dict[str, Const] = {"WAKE_SIZE": size, "WAKE_ASIDE": ASIDE, "WAKE_NEAR": NEAR, "WAKE_AWAY": AWAY}
    here = ("boats/wake/map.glsl",) if mapped else ("boats/wake/pattern.glsl", "boats/wake/exact.glsl")
    passes = (
        PassSpec(
            name=f"wakes, {size} texels along",
            program="wake",
            fragment=(
                "lib/numbers.glsl",
                "boats/wake/form.glsl",
                "boats/wake/pattern.glsl",
                "boats/wake/map_pass.glsl",
            ),
            target="wake",
        ),
        PassSpec(
            name="wakes, greatest of blocks",
            program="wake_blocks",
            fragment=(
                Inline(f"const int BOUNDS_BLOCK = {BLOCK};\n"),
                "boats/wake/form.glsl",
                "boats/wake/bounds_blocks_pass.glsl",
            ),
            target="wake_blocks",
            inputs={"u_wake_map": TargetInput(target="wake")},
        ),
        PassSpec(
            name="wakes, greatest of all",
            program="wake_bounds",
            fragment=("boats/wake/form.glsl", "boats/wake/bounds_join_pass.glsl"),
            target="wake_bounds",
            inputs={"u_wake_blocks": TargetInput(target="wake_blocks")},
        ),
    )
    targets = {
        "wake": Target(size=FixedSize(width=size, height=size // 2 * count), format="RGBA16F", filter="linear"),
        "wake_blocks": Target(size=FixedSize(width=size // BLOCK, height=size // 2 // BLOCK * count), format="RGBA16F"),
        "wake_bounds": Target(size=FixedSize(width=len(AWAY), height=count), format="RGBA16F"),
    }
    return Contribution(
        why=f"wakes up to {height:.2g} m high",
        slots=(
            SlotFile("waves", "boats/wake/waves.glsl", prefix="wakes", needs=(*WAY, *here)),
            SlotFile("bounds", f"boats/wake/{'bounds' if mapped else 'declared_bounds'}.glsl", prefix="wakes"),
        ),
        consts=consts,
        uniforms={
            "u_wake": forms,
            "u_wake_boat": array("vec2", [Constant(value=(boat.length, boat.radius)) for boat in scene.boats], count),
            **({} if mapped else declared),
        },
        inputs={f"u_wake_{name}": TargetInput(target=target) for name, target in READ.items()} if mapped else {},
        targets=targets if mapped else {},
        passes=passes if mapped else (),
        bound=Bound(0.0, "no boat moves, or none raises a wave") if height == 0.0 else None,
        max_height=height,
        min_height=-height,
        max_slope=steepest,
        max_curvature=sum(near for _, near, _ in bounds),
        map_error=significant(sum(wake.map_error(wake.length / size) for wake in wakes(scene.boats)))
        if mapped
        else 0.0,
        march_factor=2,
    )


EFFECT = Effect(
    "wakes",
    contribute,
    knobs=(
        Knob("/wake", "wakes", ("map", "exact"), "geometry"),
        Knob("/wake_size", "texels of the wake map", (128, 256, 512, 1024), "geometry"),
    ),
)
