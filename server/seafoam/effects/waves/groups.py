"""Groups in which parametric waves travel. docs/formulae.md, section 2."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seafoam.effects.effect import HALF_FLOAT, Part, Piece, Source, TextureUse, constant_function
from seafoam.framegraph.resources import TextureInput
from seafoam.framegraph.rules import Wrap, array, significant, vector
from seafoam.ocean.groups import TEXELS, group_side, group_velocity
from seafoam.scene.models import Scene
from seafoam.textures import WaveGroupField, group_field

OFFSET = "u_wave_groups_offset"
"""Uniform of the camera's place in the field."""

FACTOR = "waves/groups/factor.glsl"
"""File of the factor, for what evaluates waves itself."""

_WAVES = "waves/parametric.glsl"
EVEN_WAVES = Source(_WAVES, (("parametric_waves", "even_waves"), ("parametric_shading", "even_shading")))
"""The waves if all have one height, under other names."""
_NO_GROUPS = constant_function("float", "front_group", "vec2 q, float ago", "1.0")


@dataclass(frozen=True)
class GroupBounds:
    """Upper bounds of the factor's change: ``slope``, 1/m; ``curvature``, 1/m²; ``error`` of its interpolation."""

    slope: float = 0.0
    curvature: float = 0.0
    error: float = 0.0


def in_groups(scene: Scene) -> bool:
    """Whether the scene's parametric waves travel in groups."""
    groups = scene.wave_groups
    return groups is not None and groups.contrast > 0.0 and any(wave.amplitude > 0.0 for wave in scene.waves)


def group_part(scene: Scene) -> Part:
    """The field and what places it, for programs with :data:`FACTOR`; empty without groups."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return Part()
    length, (v_x, v_z) = group_side(groups), group_velocity(scene)
    place = (
        Wrap(k=(1.0 / length, 0.0), rate=-v_x / length),
        Wrap(k=(0.0, 1.0 / length), rate=-v_z / length),
    )
    return Part(
        consts={"GROUP_TEXELS": TEXELS},
        uniforms={
            OFFSET: array("vec2", place, 1),
            "u_wave_groups_scale": vector((significant(1.0 / length), significant(0.5 * groups.contrast))),
        },
        inputs={"u_wave_groups": TextureInput(texture="wave_groups")},
        textures={"wave_groups": TextureUse(WaveGroupField(seed=groups.seed), filter="linear")},
    )


def wave_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the parametric waves: of one height each, or in groups."""
    if not in_groups(scene):
        return (_WAVES,)
    return (FACTOR, EVEN_WAVES, "waves/groups/waves.glsl")


def carry_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the way to where the waves' water rests."""
    return _scaled(scene, "foam/carry/parametric.glsl", "parametric_carry", "carry")


def signal_files(scene: Scene, path: str) -> tuple[Piece, ...]:
    """Files of the sum of a front's own waves; ``path``: of the sum if all have one height."""
    return _scaled(scene, path, "front_signal", "signal")


def way_files(scene: Scene, path: str) -> tuple[Piece, ...]:
    """Files of the way to where the water rests by a front's own waves; ``path``: if all have one height."""
    return _scaled(scene, path, "front_way", "way")


def _scaled(scene: Scene, path: str, function: str, name: str) -> tuple[Piece, ...]:
    """A file, or with groups: it with its function renamed, and the file ``name``, which scales that by the factor."""
    if not in_groups(scene):
        return (path,)
    return (FACTOR, Source(path, ((function, f"even_{name}"),)), f"waves/groups/{name}.glsl")


def front_files(scene: Scene) -> tuple[Piece, ...]:
    """Files of the factor of waves that passed before."""
    return (FACTOR, "waves/groups/front.glsl") if in_groups(scene) else (_NO_GROUPS,)


def group_bounds(scene: Scene) -> GroupBounds:
    """Upper bounds of the factor, from the field's values and bilinear reads between them."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return GroupBounds()
    field, length, part = group_field(groups.seed), group_side(groups), 0.5 * groups.contrast
    # Differences of neighbours: what bilinear values change by, in steps of a texel.
    rises = [np.abs(_step(field[..., 0], axis)) for axis in (0, 1)]
    drawn = math.hypot(*(float(rise.max()) for rise in rises)) * TEXELS
    read = float(np.hypot(field[..., 1], field[..., 2]).max())
    bends = [np.abs(_step(field[..., 1 + i], axis)) * TEXELS for i in (0, 1) for axis in (0, 1)]
    curvature = float(np.sqrt(sum(bend * bend for bend in bends)).max())
    texel = 1.0 / TEXELS
    return GroupBounds(
        part * max(read, drawn) / length,
        part * 1.1 * curvature / length**2,
        part * (HALF_FLOAT + 0.25 * texel * texel * curvature),
    )


def _step(values: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Differences from each value to the next along an axis of the period."""
    result: NDArray[np.float64] = np.roll(values, -1, axis) - values
    return result
