"""Section 8: the heights from which the sun is seen over the land, and its light past the land."""

import math
from functools import lru_cache

import numpy as np

from seafoam.reference.shore.maps import QuadraticSpline, floor_spline
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats, Footprints, Sunlight, Vec2, dot, smoothstep
from seafoam.scene.shore import Shore

CELLS = 128  # cells along a side of the map
STEPS = 256  # steps toward the sun
SUN_RADIUS = 0.00465  # angular radius of the sun, rad
STEEPEST, LOWEST_RISE = 1.5, 1e-3  # greatest elevation of a rim (rad) and least slope of its sight
FARTHEST = 1.5  # end of the steps, in sides of the square
SOFT = 0.25  # error of an edge's place that softens it, cells


def land_shadow(coast: Coast, sun: Floats) -> Sunlight:
    """The share of the sunlight that a coast's land leaves under a sun (3,)."""
    x, y, z = (float(part) for part in sun)
    elevation, level = math.atan2(y, math.hypot(x, z)), max(math.hypot(x, z), 1e-6)
    toward, size = (x / level, z / level), coast.shore.size
    rises = tuple(
        max(math.tan(min(elevation + side * SUN_RADIUS, most)), LOWEST_RISE)
        for side, most in ((1.0, STEEPEST), (-1.0, STEEPEST - 0.01))
    )
    seen_from = QuadraticSpline(_heights(coast.shore.ground, toward, rises), size)

    def sunlight(place: Floats, footprints: Footprints) -> Floats:
        q = coast.place(place[:, 0], place[:, 2])
        enters = [
            np.maximum(-0.5 * size - math.copysign(1.0, u) * part, 0.0) / max(abs(u), 1e-6)
            for u, part in zip(toward, q, strict=True)
        ]
        far = np.maximum(enters[0], enters[1])
        here, change = seen_from.all(q[0] + far * toward[0], q[1] + far * toward[1])
        slope = change[..., 1].T
        soft = 0.5 * sum(np.abs(dot(slope, side)) for side in footprints) + SOFT * rises[1] * size / CELLS
        low, high = (here[:, i] - far * rise for i, rise in enumerate(rises))
        return smoothstep(0.0, 1.0, (place[:, 1] - low + soft) / (high - low + 2.0 * soft))

    return sunlight


@lru_cache(maxsize=8)
def _heights(shore: Shore, toward: Vec2, rises: tuple[float, ...]) -> Floats:
    """Heights from which the sun's upper and lower rim are seen over the land, (CELLS, CELLS, 2), rows along z, m."""
    floor = floor_spline(shore)
    side = shore.size / CELLS
    centres = (np.arange(CELLS) + 0.5) * side - 0.5 * shore.size
    x, z = (part.ravel() for part in np.meshgrid(centres, centres, indexing="xy"))
    highest = np.full((x.size, 2), -np.inf)
    for s in np.linspace(0.0, 1.0, STEPS):
        far = side + (FARTHEST * shore.size - side) * s * (0.25 + 0.75 * s)
        ground = floor.value(x + far * toward[0], z + far * toward[1])[:, 0]
        highest = np.maximum(highest, ground[:, None] - far * np.array(rises))
    return highest.reshape(CELLS, CELLS, 2)
