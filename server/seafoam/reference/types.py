"""Array types of the reference, what its sections pass to each other, and functions that all of them use."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Ranks = NDArray[np.uint32] | NDArray[np.int64]

Footprints = tuple[Floats, Floats]
"""Both sides of samples' footprints on a surface: their x and z, (r, 2) m each."""

Gradient = tuple[Floats | float, Floats | float] | Floats
"""Derivatives by x and z, (2, r), or the same everywhere."""

Sunlight = Callable[[Floats, Footprints], Floats]
"""Share (r,) of the sunlight that reaches places (r, 3), m from the origin, averaged over footprints."""


class Rows:
    """Arrays of as many rows each, as the fields of a dataclass."""

    def subset(self, rows: Bools | Indices) -> Self:
        """Return some of the rows, in order."""
        return type(self)(*(array[rows] for array in vars(self).values()))


@dataclass(frozen=True)
class SurfacePoints:
    """Points of the surface at which sources of foam are evaluated."""

    x: Floats
    """(r,) m from ``origin``."""
    z: Floats
    height: Floats
    """(r,) m over still water."""
    footprints: Footprints | None
    """Both sides of each sample's footprint, (r, 2) m; None: no average over footprints."""
    cap: float
    """Upper limit of the saturation."""
    time: float
    """s."""
    origin: tuple[float, float]
    """World coordinates (x, z) of the point below the camera, m."""


def smoothstep(low: float, high: float, x: ArrayLike) -> Floats:
    """3q² − 2q³ of q = (x − low)/(high − low) clamped to [0, 1]; low < high; of the shape of ``x``."""
    q = np.clip((np.asarray(x, np.float64) - low) / (high - low), 0.0, 1.0)
    return q * q * (3.0 - 2.0 * q)


def smoothstep_slope(low: float, high: float, x: Floats) -> tuple[Floats, Floats]:
    """The smoothstep and its derivative; of the shape of ``x`` each."""
    q = np.clip((x - low) / (high - low), 0.0, 1.0)
    return q * q * (3.0 - 2.0 * q), 6.0 * q * (1.0 - q) / (high - low)


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar product along the last axis; shapes broadcast."""
    return np.asarray(np.einsum("...i,...i->...", *np.broadcast_arrays(a, b)), np.float64)


def henyey_greenstein(asymmetry: float, cosine: Floats) -> Floats:
    """Phase function of Henyey and Greenstein (1941) at cosines of the scattering angle, 1/sr; of their shape."""
    g = asymmetry
    return (1.0 - g**2) / (4.0 * math.pi * (1.0 + g**2 - 2.0 * g * cosine) ** 1.5)


def unit(a: Floats) -> Floats:
    """Vectors along the last axis scaled to length 1; a zero vector stays zero."""
    length = np.sqrt(dot(a, a))[..., None]
    return a / np.where(length > 0.0, length, 1.0)
