"""Travel time of a swell over a shore's floor. Its crests are lines of equal time, bent by the depth and by islands.

Functions import scipy themselves: scenes without a shore do not wait for it.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.arrays import Floats, read_only, smoothstep
from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Shore

HUNT = (0.6666666667, 0.3555555556, 0.1608465608, 0.0632098765, 0.0217540484, 0.0065407983)
"""Coefficients of the wavenumber at a depth (Hunt 1979); relative error at most 10⁻³."""
SPREAD = tuple(math.radians(5.0 * i) for i in range(-8, 9))
"""Headings about the swell's from which it comes as well, weighted by the tenth power of their cosine."""
ROUNDS = 6
_STEPS = 65536
_SLOW = 0.02
"""Share of its speed that a front keeps on land while it seeks its way through the water."""


def speed(depth: Floats, period: float) -> Floats:
    """Phase speed of waves of a period (s) over depths above 0 (m); m/s, of their shape. Sums, products and roots."""
    rate2 = (2.0 * math.pi / period) ** 2
    y = rate2 * depth / GRAVITY
    total, power = np.ones_like(y), np.ones_like(y)
    for coefficient in HUNT:
        power = power * y
        total += coefficient * power
    return math.sqrt(rate2) * depth / np.sqrt(y * y + y / total)


def travel_grid(shore: Shore, texels: int) -> Floats:
    """(texels, texels, 2): periods from the swell's arrival at the square's middle over deep water to that
    here, and the share of its height that islands leave, in [0, 1]; row z, column x. Rounded to 2⁻¹⁶.
    """
    return _travel_grid(shore.approach, texels)


@lru_cache(maxsize=16)
def _travel_grid(shore: Shore, texels: int) -> Floats:
    from scipy import ndimage

    surf = shore.surf
    texel = shore.size / texels
    deviation = min(shore.smoothing / texel, texels / 12.0)
    depth = ndimage.gaussian_filter(-floor_grid(shore, texels)[..., 0], deviation, mode="nearest")
    least = max(0.3 * surf.height, 0.05)
    pace = speed(np.maximum(depth, least), surf.period)
    wet = depth > 0.0
    centres = ((np.arange(texels) + 0.5) / texels - 0.5) * shore.size
    x, z = np.meshgrid(centres, centres, indexing="xy")
    offshore = float(speed(np.array([shore.deep]), surf.period)[0])
    plane = (math.cos(surf.heading) * x + math.sin(surf.heading) * z) / offshore
    fixed = np.zeros_like(wet)
    fixed[[0, -1], :] = fixed[:, [0, -1]] = True
    far = np.full_like(plane, 1e6)
    through_water = arrival(np.where(fixed, plane, far), fixed, texel / np.where(wet, pace, _SLOW * pace))
    fixed |= wet
    seconds = arrival(np.where(fixed, through_water, far), fixed, texel / pace)
    seconds = ndimage.gaussian_filter(seconds, 1.0, mode="nearest")
    along = [np.asarray(np.gradient(seconds, texel, axis=axis), np.float64) for axis in (0, 1)]
    # Where fronts meet behind an island the time has a kink, and waves from both sides would add up.
    alone = smoothstep(0.3, 0.8, np.hypot(along[0], along[1]) * pace)
    reached = 1.0 - surf.exposure + surf.exposure * _exposed(depth < 0.0, surf.heading)
    return read_only(np.round(np.stack((seconds / surf.period, alone * reached), axis=-1) * _STEPS) / _STEPS)


def arrival(start: Floats, fixed: NDArray[np.bool_], delay: Floats) -> Floats:
    """Least times (rows, columns) of arrival: solution of |∇t| = ``delay`` per texel with ``start`` where ``fixed``.

    Godunov's upwind scheme by fast sweeping (Zhao 2005), which has the solution of fast marching; along diagonals,
    whose texels do not depend on each other. Of first order; exact where the delay is even and the front plane.
    """
    rows, columns = start.shape
    width = columns + 2
    time = np.pad(start, 1, constant_values=1e9).ravel()
    cost = np.pad(np.where(fixed, np.inf, delay), 1, constant_values=np.inf).ravel()
    sweeps = []
    for flipped in (False, True):
        diagonals = []
        for k in range(rows + columns - 1):
            row = np.arange(max(0, k - columns + 1), min(rows, k + 1))
            column = k - row
            if flipped:
                column = columns - 1 - column
            at = (row + 1) * width + column + 1
            at = at[np.isfinite(cost[at])]
            if at.size:
                diagonals.append(at)
        sweeps += [diagonals, diagonals[::-1]]
    for _ in range(ROUNDS):
        before = time.copy()
        for sweep in sweeps:
            for at in sweep:
                a = np.minimum(time[at - width], time[at + width])
                b = np.minimum(time[at - 1], time[at + 1])
                f = cost[at]
                apart = np.abs(a - b)
                both = 0.5 * (a + b + np.sqrt(np.maximum(2.0 * f * f - apart * apart, 0.0)))
                time[at] = np.minimum(time[at], np.where(apart >= f, np.minimum(a, b) + f, both))
        if np.abs(time - before).max() <= 1e-6:
            break
    return time.reshape(rows + 2, width)[1:-1, 1:-1]


def _exposed(land: NDArray[np.bool_], heading: float) -> Floats:
    """Share of the swell's headings from which no land stands before a texel; of the shape of ``land``."""
    from scipy import ndimage

    count = land.shape[0]
    middle = 0.5 * (count - 1)
    solid = ndimage.gaussian_filter(land.astype(np.float64), 1.0, mode="nearest")
    side = math.ceil(1.42 * count)
    u = np.arange(side) - 0.5 * (side - 1)
    v, w = np.meshgrid(u, u, indexing="xy")
    row, column = np.indices(land.shape) - middle
    total, weights = np.zeros(land.shape), 0.0
    for aside in SPREAD:
        c, s = math.cos(heading + aside), math.sin(heading + aside)
        # Columns run with the waves.
        ahead = (s * v + c * w + middle, c * v - s * w + middle)
        turned = ndimage.map_coordinates(solid, ahead, order=1, mode="nearest")
        shadow = np.maximum.accumulate(turned, axis=1)
        back = (-s * column + c * row + 0.5 * (side - 1), c * column + s * row + 0.5 * (side - 1))
        weight = math.cos(aside) ** 10
        clear = 1.0 - ndimage.map_coordinates(shadow, back, order=1, mode="nearest")
        total += weight * clear
        weights += weight
    return np.clip(total / weights, 0.0, 1.0)
