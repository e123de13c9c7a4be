"""Upper bounds of a shore's waves, floor and land, measured on the texels of its maps. docs/formulae.md, section 8.

Functions import scipy themselves: scenes without a shore do not wait for it.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from seafoam.effects.shore.maps import MASK_WAVES, blur_deviation
from seafoam.framegraph.rules import significant
from seafoam.ocean.arrays import Floats, smoothstep
from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.coast.travel import travel_grid
from seafoam.ocean.constants import GRAVITY
from seafoam.quality import Quality
from seafoam.scene import Shore
from seafoam.sums import summed
from seafoam.textures.shore import ROWS, shore_profiles

BREAKING_RATIO = 0.78
"""Height of a wave over the water depth at which it breaks."""
BETWEEN_TEXELS = 1.1
"""Factor on slope and curvature of the shore waves, for what lies between the texels that are measured."""


@dataclass(frozen=True)
class Limits:
    """Upper bounds of a shore. Those of waves hold in every phase."""

    wave_slope: float
    wave_curvature: float
    """Second derivative, 1/m."""
    open_share_slope: float
    """Gradient of the open sea's share of the surface, 1/m."""
    floor_slope: float
    land_slope: float
    """Slope of the ground above y = 0."""
    floor_curvature: float
    """Second derivative of the ground where it turns up, 1/m."""
    land_top: float
    """Highest ground, m; negative without a coast."""


def limits(shore: Shore, quality: Quality) -> Limits:
    """Bounds of a shore; those of its waves without the mask's pauses, exposure and ridges, which only lower them."""
    # Shores that differ in their look alone share one measurement.
    measured = shore.ground.model_copy(update={"smoothing": shore.smoothing, "surf": shore.surf})
    return _measured(measured, quality.shore_map, quality.shore_floor, quality.shore_profile)


def rounded_up(value: float) -> float:
    """At least 1.02 times ``value``, to 3 significant digits: hides last bits that differ between processors."""
    if value <= 0.0:
        return 0.0
    scale = 10.0 ** (math.floor(math.log10(value)) - 2)
    return significant(math.ceil(value * 1.02 / scale) * scale)


@lru_cache(maxsize=32)
def _measured(shore: Shore, map_texels: int, floor_texels: int, nodes: int) -> Limits:
    floor = floor_grid(shore, floor_texels)[..., 0]
    texel = shore.size / map_texels
    depth, heights, phases, skews = _wave_fields(shore, floor, map_texels)
    slope, curvature = _steepest_waves(shore, heights, phases, skews, texel, nodes)
    open_share = _gradient(smoothstep(0.0, 0.6 * shore.deep, depth), texel)
    # A lagoon's ring takes 0.9 of the share over a quarter of its radius; a smoothstep is at most 1.5 steep.
    shelter = 1.5 * 0.9 / (0.25 * shore.radius) if shore.kind == "lagoon" else 0.0
    return Limits(
        wave_slope=BETWEEN_TEXELS * slope,
        wave_curvature=BETWEEN_TEXELS * curvature,
        open_share_slope=float(np.hypot(open_share[..., 0], open_share[..., 1]).max()) + shelter,
        floor_slope=_steepest_step(floor, shore.size / floor_texels),
        land_slope=_steepest_step(np.maximum(floor, 0.0), shore.size / floor_texels),
        floor_curvature=_sharpest_bend(floor, shore.size / floor_texels),
        land_top=float(floor.max()),
    )


def _wave_fields(shore: Shore, floor: Floats, map_texels: int) -> tuple[Floats, Floats, Floats, Floats]:
    """What determines the shore waves, at every texel of the map, (texels, texels) each: the smoothed depth, m,
    negative on land; the waves' greatest height, m; the gradient of their phase, (texels, texels, 2) periods/m, which
    is no steeper between texels; and their row of the profile table over the last, 1 that of a breaking wave.
    """
    from scipy import ndimage

    surf = shore.surf
    heights = ndimage.zoom(floor, map_texels / floor.shape[0], order=1, grid_mode=True, mode="nearest")
    deviation = blur_deviation(shore, map_texels)
    distance = ndimage.gaussian_filter(_coast_distance(shore, heights), deviation, mode="nearest")
    depth = ndimage.gaussian_filter(-heights, deviation, mode="nearest")
    breaking_depth = max(surf.height, 0.05) / BREAKING_RATIO
    broken = 0.3 + 0.7 * smoothstep(0.0, breaking_depth, depth)
    # Green's law where the wave has not broken.
    shoal = np.where(depth >= breaking_depth, (breaking_depth / np.maximum(depth, breaking_depth)) ** 0.25, broken)
    inland = smoothstep(-1.2 * max(surf.height, 0.05) / shore.slope, 0.0, distance)
    height: Floats = surf.height * shoal * inland * (1.0 - smoothstep(0.45 * shore.deep, 0.9 * shore.deep, depth))
    skew = 1.0 - smoothstep(breaking_depth, 2.5 * breaking_depth, depth)
    return depth, height, _phase_gradient(shore, distance, map_texels), skew


def _phase_gradient(shore: Shore, distance: Floats, map_texels: int) -> Floats:
    texel, surf = shore.size / map_texels, shore.surf
    if surf.refraction:
        return 1.05 * _gradient(travel_grid(shore, map_texels)[..., 0], texel)
    toward = _gradient(distance, texel)
    # The gradient of a smoothed distance is about 1; between texels it may be a little more.
    toward *= 1.05 / np.maximum(np.hypot(toward[..., :1], toward[..., 1:]), 1.0)
    speed_squared = GRAVITY * (max(0.3 * surf.height, 0.05) + shore.slope * np.maximum(distance, 0.0))
    result: Floats = toward / (surf.period * np.sqrt(speed_squared))[..., None]
    return result


def _coast_distance(shore: Shore, heights: Floats) -> Floats:
    """Distance from the coast, m; negative on land; the square's side where there is no coast."""
    from scipy import ndimage

    texel = shore.size / heights.shape[0]
    dry = heights >= 0.0
    if dry.all() or not dry.any():
        return np.full_like(heights, (-1.0 if dry.all() else 1.0) * shore.size)
    inside, outside = ndimage.distance_transform_edt(dry), ndimage.distance_transform_edt(~dry)
    distance: Floats = np.where(dry, 0.5 - inside, outside - 0.5) * texel
    return distance


def _steepest_waves(
    shore: Shore, heights: Floats, phases: Floats, skews: Floats, texel: float, nodes: int
) -> tuple[float, float]:
    """Greatest slope of the shore waves in any phase, and their greatest second derivative, 1/m."""
    surf = shore.surf
    # Every second texel suffices for fields this smooth.
    waves = np.zeros(heights.shape, np.bool_)
    waves[::2, ::2] = heights[::2, ::2] > 0.05 * surf.height
    if not waves.any():
        return 0.0, 0.0
    height, turns = heights[waves][:, None], phases[waves]
    height_slope, skew_slope = _gradient(heights, texel)[waves], _gradient(skews, texel)[waves]
    table = shore_profiles(nodes, surf.skew, surf.sharpness).astype(np.float64)
    # The profile's row below each skew, and the share of the next row.
    at = skews[waves] * (ROWS - 1)
    row = np.minimum(at.astype(np.intp), ROWS - 2)
    share = (at - row)[:, None]
    by_phase = (np.roll(table, -1, axis=1) - table) * nodes
    by_skew = np.diff(table, axis=0) * (ROWS - 1)
    value = table[row] * (1.0 - share) + table[row + 1] * share
    phase_slope = by_phase[row] * (1.0 - share) + by_phase[row + 1] * share
    components = [
        height * (by_skew[row] * skew_slope[:, i : i + 1] - phase_slope * turns[:, i : i + 1])
        + value * height_slope[:, i : i + 1]
        for i in (0, 1)
    ]
    # Slope of the mask: four sines of about 75 m, through a step of slope 1.6.
    mask_slope = surf.variation * 0.94 * 0.5 * summed(2.0 * math.pi / length for length, _, _ in MASK_WAVES)
    slope = float(np.hypot(*components).max()) + 0.5 * surf.height * mask_slope
    # The second derivative is greatest in troughs, across the crests; height and skew change far more slowly.
    bends = np.maximum(np.roll(table, -1, axis=1) - 2.0 * table + np.roll(table, 1, axis=1), 0.0).max(axis=1)
    steepest_turns = np.hypot(turns[:, 0], turns[:, 1])
    steepest_phase = np.abs(phase_slope).max(axis=1)
    by_profile = np.maximum(bends[row], bends[row + 1]) * nodes**2 * steepest_turns**2 * height[:, 0]
    by_height = 2.0 * steepest_phase * steepest_turns * np.hypot(*height_slope.T)
    by_mask = 2.0 * mask_slope * float((steepest_phase * steepest_turns).max())
    curvature = float((by_profile + by_height).max()) + by_mask
    return slope, curvature


def _gradient(values: Floats, texel: float) -> Floats:
    """(rows, columns, 2) gradient along rows' and columns' index, per metre."""
    gradient: Floats = np.stack([np.gradient(values, texel, axis=axis) for axis in (0, 1)], axis=-1)
    return gradient


def _sharpest_bend(heights: Floats, texel: float) -> float:
    """Greatest second derivative of the quadratic B-spline through the texels in any direction, 1/m; at least 0.

    At each place the elements of its Hessian are means, with positive weights, of second differences of the texels
    around, and its greater eigenvalue grows with each.
    """
    from scipy import ndimage

    along = [ndimage.correlate1d(heights, (1.0, -2.0, 1.0), axis=axis, mode="nearest") for axis in (0, 1)]
    first, second = (ndimage.maximum_filter1d(along[axis], 3, axis=1 - axis, mode="nearest") for axis in (0, 1))
    mixed = np.abs(np.diff(np.diff(np.pad(heights, 1, mode="edge"), axis=0), axis=1))
    mixed = ndimage.maximum_filter(mixed, 2, origin=-1, mode="nearest")[:-1, :-1]
    greatest = 0.5 * (first + second) + np.hypot(0.5 * (first - second), mixed)
    return max(float(greatest.max()), 0.0) / texel**2


def _steepest_step(heights: Floats, texel: float) -> float:
    return math.hypot(*(float(np.abs(np.diff(heights, axis=axis)).max()) / texel for axis in (0, 1)))
