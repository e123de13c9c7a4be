"""Places on a shore where spray rises."""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.seabed import floor_grid
from seafoam.scene.shore import Shore

ROCKS = 1024
"""Number of places on rocks at which drops start."""

_TEXELS = 256

_SEED = 7


def rocks(shore: Shore, steep: float) -> Floats:
    """(ROCKS, 4): places on the coast (x, z) from the square's middle, m, and the way out to sea there, a unit vector.

    Where the ground at the water's edge is as steep as ``steep`` or more, in a random order, some more than once;
    (0, 4) where there is none. Rounded to 1/1024.
    """
    return _rocks(shore.ground, steep)


@lru_cache(maxsize=16)
def _rocks(shore: Shore, steep: float) -> Floats:
    height = floor_grid(shore, _TEXELS)[..., 0]
    texel = shore.size / _TEXELS
    # Heights are level where the square ends: no coast is lost with the last row and column.
    along_z, along_x = (np.asarray(np.gradient(height, texel, axis=axis), np.float64) for axis in (0, 1))
    found = []
    for axis in (0, 1):
        a, b = (height[:-1], height[1:]) if axis == 0 else (height[:, :-1], height[:, 1:])
        row, column = np.nonzero((a >= 0.0) != (b >= 0.0))
        share = a[row, column] / (a[row, column] - b[row, column])
        z, x = row + 0.5, column + 0.5
        if axis == 0:
            z = z + share
        else:
            x = x + share
        uphill = np.stack((along_x[row, column], along_z[row, column]), axis=-1)
        slope: Floats = np.hypot(uphill[:, 0], uphill[:, 1])
        out = -uphill / np.maximum(slope, 1e-6)[:, None]
        places = np.stack((x, z), axis=-1) * texel - 0.5 * shore.size
        both: Floats = np.concatenate((places, out), axis=1)
        found.append(both[slope >= steep])
    every = np.concatenate(found)
    if len(every) == 0:
        return np.zeros((0, 4))
    random = np.random.Generator(np.random.PCG64(_SEED))
    chosen = np.concatenate([random.permutation(len(every)) for _ in range(math.ceil(ROCKS / len(every)))])[:ROCKS]
    result: Floats = np.round(every[chosen] * 1024.0) / 1024.0
    result.setflags(write=False)
    return result
