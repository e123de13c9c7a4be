"""The waves of boats' wakes: from a map drawn each frame, or computed at each sample.

docs/formulae.md, section 15.
"""

from collections.abc import Sequence

from seafoam.effects.boats.boat import COURSE
from seafoam.effects.effect import Bound, Contribution, Effect, Inline, Knob, PassSpec, SlotFile
from seafoam.effects.waves.measured import BLOCK
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Uniform, array, number, significant
from seafoam.ocean.wakes import NEAR, Wake, wake_height, wake_slope, wakes
from seafoam.quality import Quality
from seafoam.scene.models import Scene

ASIDE = 0.36
"""Width of a wake to each side over its length: slightly more than Kelvin's tan 19.47 degrees."""
AWAY = (0, 2, 4, 8)
"""Distances from a boat's middle, in boat lengths, from which on a bound of the wake's curvature is given: the
curvature is greatest at the bow, where the window fades the wake in."""
WAY = (COURSE, "boats/wake/way.glsl")
READ = {"map": "wake", "bounds": "wake_bounds"}


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has boats."""
    if not scene.boats:
        return None
    mapped = quality.wake == "map"
    height, patterns = wake_height(scene.boats), wakes(scene.boats)
    targets, passes = _map_passes(len(scene.boats), quality.wake_size) if mapped else ({}, ())
    return Contribution(
        why=f"wakes up to {height:.2g} m high",
        slots=_slots(mapped=mapped),
        consts={"WAKE_SIZE": quality.wake_size, "WAKE_ASIDE": ASIDE, "WAKE_NEAR": NEAR, "WAKE_AWAY": AWAY},
        uniforms={**_form_uniforms(patterns), **({} if mapped else _bound_uniforms(patterns, height))},
        inputs={f"u_wake_{name}": TargetInput(target=target) for name, target in READ.items()} if mapped else {},
        targets=targets,
        passes=passes,
        bound=Bound(0.0, "no boat moves, or none makes waves") if height == 0.0 else None,
        max_height=height,
        min_height=-height,
        max_slope=wake_slope(scene.boats),
        max_curvature=sum(significant(wake.curvature[0]) for wake in patterns),
        map_error=significant(sum(wake.map_error(wake.length / quality.wake_size) for wake in patterns))
        if mapped
        else 0.0,
        march_factor=2,
    )


def _slots(*, mapped: bool) -> tuple[SlotFile, ...]:
    pattern = ("boats/wake/map.glsl",) if mapped else ("boats/wake/pattern.glsl", "boats/wake/exact.glsl")
    return (
        SlotFile("waves", "boats/wake/waves.glsl", prefix="wakes", needs=(*WAY, *pattern)),
        SlotFile("bounds", f"boats/wake/{'bounds' if mapped else 'declared_bounds'}.glsl", prefix="wakes"),
    )


def _form_uniforms(patterns: Sequence[Wake]) -> dict[str, Uniform]:
    """Of each wake: wavenumber (rad/m), amplitude (m; 0: none), length (m), cut-off (rad/m); and its boat."""
    forms = [
        (significant(of.k), of.boat.wake if of.shows else 0.0, significant(of.length), significant(of.shortest))
        for of in patterns
    ]
    boats = [(of.boat.length, of.boat.radius) for of in patterns]
    return {
        "u_wake": array("vec4", [Constant(value=form) for form in forms], len(forms)),
        "u_wake_boat": array("vec2", [Constant(value=boat) for boat in boats], len(boats)),
    }


def _bound_uniforms(patterns: Sequence[Wake], height: float) -> dict[str, Uniform]:
    """Bounds of the exact wakes, which no map is measured for."""
    bounds = [(significant(of.max_slope), *map(significant, of.curvature)) for of in patterns]
    return {
        "u_wake_highest": number(height),
        "u_wake_bounds": array("vec3", [Constant(value=of) for of in bounds], len(bounds)),
    }


def _map_passes(boats: int, size: int) -> tuple[dict[str, Target], tuple[PassSpec, ...]]:
    """Targets and passes of the wakes' map, ``size`` texels long and half as wide per boat, and of its bounds."""
    targets = {
        "wake": Target(size=FixedSize(width=size, height=size // 2 * boats), format="RGBA16F", filter="linear"),
        "wake_blocks": Target(size=FixedSize(width=size // BLOCK, height=size // 2 // BLOCK * boats), format="RGBA16F"),
        "wake_bounds": Target(size=FixedSize(width=len(AWAY), height=boats), format="RGBA16F"),
    }
    pattern = ("lib/numbers.glsl", "boats/wake/form.glsl", "boats/wake/pattern.glsl", "boats/wake/map_pass.glsl")
    block = Inline(f"const int BOUNDS_BLOCK = {BLOCK};\n")
    return targets, (
        PassSpec(name=f"wakes, {size} texels along", program="wake", fragment=pattern, target="wake"),
        PassSpec(
            name="wakes, greatest of blocks",
            program="wake_blocks",
            fragment=(block, "boats/wake/form.glsl", "boats/wake/bounds_blocks_pass.glsl"),
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


EFFECT = Effect(
    "wakes",
    contribute,
    fields=("/boats/wake",),
    knobs=(
        Knob("/wake", "wakes", ("map", "exact"), "geometry"),
        Knob("/wake_size", "texels of the wake map", (128, 256, 512, 1024), "geometry"),
    ),
)
