"""Array types of the reference, what its sections pass to each other, and functions that all of them use."""

import math
from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Ranks = NDArray[np.uint32] | NDArray[np.int64]
Pair = tuple[Floats, Floats]
Vec2 = tuple[float, float]  # (x, z), or two bounds
Vec3 = tuple[float, float, float]
Footprints = Pair
"""Both sides of samples' footprints on a surface: their x and z, (r, 2) m each."""
Gradient = tuple[Floats | float, Floats | float] | Floats
"""Derivatives by x and z, (2, r), or the same everywhere."""
Sunlight = Callable[[Floats, Footprints], Floats]
"""Share (r,) of the sunlight that reaches places (r, 3), m from the origin, averaged over footprints."""


@dataclass(frozen=True)
class Bounds:
    """Of a part of the surface: its height is in [trough, top] m, trough at most 0."""

    top: float = 0.0
    trough: float = 0.0
    slope: float = 0.0  # the greatest, rounded up
    curvature: float = 0.0  # the greatest second derivative along any line, rounded up, 1/m
    shape: float = math.inf  # size of the finest feature, m


class ReliefPart(Protocol):
    """A part of the surface's height, at one time around one origin."""

    @property
    def bounds(self) -> Bounds: ...

    def height(self, x: Floats, z: Floats) -> Floats:
        """Height at (x, z), m from the origin, shape (r,); (r,) m."""

    def gradient(self, x: Floats, z: Floats) -> Floats:
        """(h_x, h_z) at (x, z); (2, r)."""


class Relief:
    """The sum of parts, itself a part."""

    def __init__(self, parts: Iterable[ReliefPart]) -> None:
        self.raised = tuple(part for part in parts if part.bounds.top > 0.0)  # the parts that are not flat
        rows = [astuple(part.bounds) for part in self.raised] or [astuple(Bounds())]
        top, trough, slope, curvature, shape = zip(*rows, strict=True)
        self.bounds = Bounds(sum(top), sum(trough), sum(slope), sum(curvature), min(shape))

    def height(self, x: Floats, z: Floats) -> Floats:
        return sum((part.height(x, z) for part in self.raised), np.zeros_like(x))

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return sum((part.gradient(x, z) for part in self.raised), np.zeros((2, x.size)))


class Rows:
    """Arrays of as many rows each, as the fields of a dataclass."""

    def subset(self, rows: Bools | Indices) -> Self:
        """Return some of the rows, in order."""
        return type(self)(*(array[rows] for array in vars(self).values()))


@dataclass(frozen=True, eq=False)
class WaterSamples:
    """Where r rays meet the water."""

    d: Floats  # (r, 3) unit vectors along the rays
    distance: Floats  # (r,) m
    x: Floats  # (r,) m from the origin
    z: Floats
    height: Floats  # (r,) m
    footprints: Footprints
    normal: Floats  # (r, 3) unit vectors, with ripples
    foam_normal: Floats  # the same with half of the ripples, which foam damps


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
    origin: Vec2
    """World coordinates (x, z) of the point below the camera, m."""


def smoothstep(low: float, high: float, x: ArrayLike) -> Floats:
    """3q² − 2q³ of q = (x − low)/(high − low) clamped to [0, 1]; low < high; of the shape of ``x``."""
    q = np.clip((np.asarray(x, np.float64) - low) / (high - low), 0.0, 1.0)
    return q * q * (3.0 - 2.0 * q)


def smoothstep_slope(low: float, high: float, x: Floats) -> Pair:
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
