"""Points on a rocky coast at which spray starts."""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats, read_only
from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Shore, Spray

ROCKS = 1024
"""Number of points at which drops start."""
_TEXELS = 256
_SEED = 7
_MEAN = 0.65 * 0.7 * 0.625
"""Mean speed of drops, in the greatest: of bursts, of their jets, and of the drops of a jet."""


def rocks(shore: Shore, steep: float) -> Floats:
    """(ROCKS, 4): points on the coast (x, z) from the square's centre, m, and unit vectors from there toward the sea.

    The points are those of the coast at which the ground's slope is at least ``steep``, in random order, some of them
    repeated; (0, 4) if there are none. Rounded to 1/1024.
    """
    return _rocks(shore.ground, steep)


def splash_height(shore: Shore, spray: Spray | None) -> float:
    """Height over still water up to which drops wet rock, m; 0 if none is thrown on rock.

    What a drop of the mean speed at waves of the breaking height rises against linear drag, τ(v − gτ ln(1 + v/(gτ))),
    of the default τ: that of a scene may change without a new plan. docs/formulae.md, section 8.
    """
    if spray is None or shore.surf.height == 0.0:
        return 0.0
    fastest = spray.speed * math.sqrt(GRAVITY * shore.surf.height / 0.3)
    if fastest <= spray.threshold or len(rocks(shore, spray.steep)) == 0:
        return 0.0
    falls, speed, tau = GRAVITY * Spray().drag, _MEAN * fastest, Spray().drag
    return tau * (speed - falls * math.log1p(speed / falls))


@lru_cache(maxsize=16)
def _rocks(shore: Shore, steep: float) -> Floats:
    height = floor_grid(shore, _TEXELS)[..., 0]
    texel = shore.size / _TEXELS
    # The ground is level at the edge of the square, so the last row and column contain no coast.
    along_z, along_x = (np.asarray(np.gradient(height, texel, axis=axis), np.float64) for axis in (0, 1))
    coast = []
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
        coast.append(both[slope >= steep])
    every = np.concatenate(coast)
    if len(every) == 0:
        return np.zeros((0, 4))
    random = np.random.Generator(np.random.PCG64(_SEED))
    chosen = np.concatenate([random.permutation(len(every)) for _ in range(math.ceil(ROCKS / len(every)))])[:ROCKS]
    return read_only(np.round(every[chosen] * 1024.0) / 1024.0)
