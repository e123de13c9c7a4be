"""Groups in which parametric waves travel. docs/formulae.md, section 2."""

import math
from dataclasses import dataclass

from seafoam.effects.effect import Resources
from seafoam.effects.noise import HASH
from seafoam.effects.shader import Piece, Source, constant_function
from seafoam.framegraph.rules import Wrap, array, vector
from seafoam.ocean.waves.groups import PERIOD, group_cells, group_key, group_velocity, in_groups
from seafoam.scene.models import Scene

PLACE = "u_wave_groups_place"
"""Uniform of the camera's place in the noise."""

FACTOR = (HASH, "waves/groups.glsl@factor")
"""Files of the factor, for what evaluates waves itself."""

SLOPE, CURVATURE, VARIANCE = 1.5, 6.0, 0.091973
"""Of the noise: greatest slope and second derivative along any line, in cells; variance, (1/6)(26/35)²."""

_WAVES = "waves/parametric.glsl"
_EVEN_WAVES = Source(_WAVES, (("parametric_waves", "even_waves"), ("parametric_shading", "even_shading")))
"""The waves if all have one height, under other names."""
_EVEN = {
    "waves/groups.glsl@fronts": ("fronts_then", "even_fronts"),
    "waves/groups.glsl@carry": ("parametric_carry", "even_carry"),
    "waves/groups.glsl@signal": ("front_signal", "even_signal"),
    "waves/groups.glsl@way": ("front_way", "even_way"),
}
"""Functions that a file scales, and their names before."""
_NO_GROUPS = constant_function("float", "front_group", "vec2 q, float ago", "1.0")


@dataclass(frozen=True)
class GroupBounds:
    """Upper bounds of the factor's change along any line: ``slope``, 1/m; ``curvature``, 1/m²."""

    slope: float = 0.0
    curvature: float = 0.0


def group_part(scene: Scene) -> Resources:
    """What places the groups, for programs with :data:`FACTOR`; empty without groups."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return Resources()
    along, (v_x, v_z) = group_cells(scene, groups), group_velocity(scene)
    across = (-along[1], along[0])
    place = (Wrap(k=(k_x, k_z), period=float(PERIOD), rate=-(k_x * v_x + k_z * v_z)) for k_x, k_z in (along, across))
    return Resources(
        consts={"GROUP_KEY": group_key(groups.seed), "GROUP_PERIOD": PERIOD, "GROUP_VARIANCE": VARIANCE},
        uniforms={PLACE: array("vec2", place, 1), "u_wave_groups": vector((*along, groups.contrast))},
    )


def wave_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the parametric waves: of one height each, or in groups."""
    if not in_groups(scene):
        return (_WAVES,)
    return (*FACTOR, _EVEN_WAVES, "waves/groups.glsl@waves")


def earlier_wave_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the parametric waves of an earlier time."""
    waves = (*FACTOR, _EVEN_WAVES) if in_groups(scene) else (_WAVES,)
    return (*waves, *scaled_files(scene, "spray/births.glsl@fronts", "waves/groups.glsl@fronts"))


def scaled_files(scene: Scene, path: str, scaled: str) -> tuple[Piece, ...]:
    """Files of what is proportional to the waves' heights: ``path``, which has it if all have one height.

    In groups, its function has another name, and ``scaled`` scales it by the factor: the fronts of an earlier time; the
    way to where the waves' water rests; the sum of a front's own waves, and the way to where the water rests by these.
    """
    return (*FACTOR, Source(path, (_EVEN[scaled],)), scaled) if in_groups(scene) else (path,)


def front_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the factor of waves that passed before."""
    return (*FACTOR, "waves/groups.glsl@front") if in_groups(scene) else (_NO_GROUPS,)


def group_bounds(scene: Scene) -> GroupBounds:
    """Upper bounds of the factor."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return GroupBounds()
    step = 1.000001 * math.hypot(*group_cells(scene, groups))
    return GroupBounds(groups.contrast * SLOPE * step, groups.contrast * CURVATURE * step * step)
