"""Spray: drops thrown up by waves, and rocks on which surf breaks. docs/formulae.md, section 13."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from seafoam.scene.shore import Shore, floor_grid

DROPS = 16384
"""Number of drops; a quality that draws fewer draws each larger."""
ROCKS = 1024
"""Number of places on rocks at which drops start."""
_TEXELS = 256
_SEED = 7


class Spray(BaseModel):
    """Drops thrown up where waves rise fast, or, with a shore, where surf breaks on rocks."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    threshold: float = Field(
        default=1.5,
        ge=0.0,
        le=20.0,
        description="Minimum speed that throws drops, m/s: of the rising water on waves, of the drops "
        "themselves on rocks",
    )
    speed: float = Field(
        default=3.0,
        ge=0.1,
        le=10.0,
        description="Initial speed of the drops: on waves relative to the speed of the rising water, on rocks "
        "to √(gH), H the height of the surf",
    )
    steep: float = Field(
        default=0.3, ge=0.0, le=2.0, description="Slope of the ground above which a coast is rock and throws spray"
    )
    size: float = Field(
        default=0.04, ge=0.002, le=0.3, description="Radius of a drop, m; each stands for a cluster of many"
    )
    mist: float = Field(default=0.3, ge=0.0, le=1.0, description="Fraction of the drops that are puffs of mist")
    drag: float = Field(
        default=0.8,
        ge=0.05,
        le=10.0,
        description="Time constant of air drag: a drop's velocity relative to the wind falls to 1/e, s",
    )
    life: float = Field(default=2.5, ge=0.2, le=8.0, description="Lifetime of a drop, s")
    wind: float = Field(default=3.0, ge=0.0, le=40.0, description="Speed of the wind that carries the drops, m/s")
    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction toward which the wind blows, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    reach: float = Field(
        default=60.0,
        ge=5.0,
        le=1000.0,
        description="Maximum distance from the camera at which waves throw drops, m; rocks throw them at any distance",
    )


@lru_cache(maxsize=16)
def rocks(ground: str, steep: float) -> NDArray[np.float64]:
    """(ROCKS, 4): places on the coast (x, z) from the square's middle, m, and the way out to sea there, a unit vector.

    Where the ground at the water's edge is as steep as ``steep`` or more, in a random order, some more than once;
    (0, 4) where there is none. ``ground``: :attr:`Shore.ground`. Rounded to 1/1024.
    """
    shore = Shore.of_ground(ground)
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
        slope: NDArray[np.float64] = np.hypot(uphill[:, 0], uphill[:, 1])
        out = -uphill / np.maximum(slope, 1e-6)[:, None]
        places = np.stack((x, z), axis=-1) * texel - 0.5 * shore.size
        both: NDArray[np.float64] = np.concatenate((places, out), axis=1)
        found.append(both[slope >= steep])
    every = np.concatenate(found)
    if len(every) == 0:
        return np.zeros((0, 4))
    random = np.random.Generator(np.random.PCG64(_SEED))
    chosen = np.concatenate([random.permutation(len(every)) for _ in range(math.ceil(ROCKS / len(every)))])[:ROCKS]
    result: NDArray[np.float64] = np.round(every[chosen] * 1024.0) / 1024.0
    result.setflags(write=False)
    return result
