"""Section 8: maps of a shore: its floor, distances to its coast, and the waves that approach it."""

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np
from scipy import ndimage

from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.coast.travel import travel_grid
from seafoam.ocean.constants import GRAVITY
from seafoam.reference.types import Bools, Floats, Indices, Pair, smoothstep
from seafoam.reference.waves.parametric import reduced
from seafoam.scene import Shore, Surf
from seafoam.textures.shore import shore_profiles

BREAKS = 0.78  # ratio of height to depth at which a wave breaks (McCowan 1894)
LEAST = 0.05
SWASH = 0.3  # share of its height that a broken wave has on the beach
MAP = 256  # texels along a side of the map
FLOOR = 512  # texels along a side of the height field
NODES = 256  # nodes of a profile
PERIOD = 2.0**18  # side of the square in which a shore repeats, m
MASK = ((83.0, 0.4, 31.0), (57.0, 2.1, 23.0), (119.0, 3.6, 43.0), (71.0, 5.3, 37.0))
"""Wavelength (m), heading (rad) and period (s) of the sines that vary the waves' height; sine i starts at 1.7 i rad."""


def step_between(low: float, high: float, x: Floats) -> Floats:
    """Smoothstep with ends at least 10⁻⁶ apart, for ends that may coincide."""
    return smoothstep(low, low + max(high - low, 1e-6), x)


def signed_distance(land: Bools) -> Floats:
    """Exact distance of texels to the other kind, less ½, negative on land, in texels; without it the map's side."""
    if land.all() or not land.any():
        return np.where(land, -1.0, 1.0) * float(land.shape[1])
    inland: Floats = ndimage.distance_transform_edt(land)
    offshore: Floats = ndimage.distance_transform_edt(~land)
    return np.where(land, 0.5 - inland, offshore - 0.5)


def gaussian(values: Floats, deviation: float) -> Floats:
    """Values (n, n) smoothed by a Gaussian, its deviation in texels, cut at 3 deviations, with repeated edges."""
    reach = min(max(math.ceil(3.0 * deviation), 1), 48)
    result: Floats = ndimage.gaussian_filter(values, max(deviation, 0.01), radius=reach, mode="nearest")
    return result


def _quadratic(at: Floats) -> tuple[Indices, Floats, Floats]:
    """The texels nearest to places, and the weights and slopes of these and of those before and after; (3, r)."""
    base = np.floor(at + 0.5)
    t = at + 0.5 - base
    weights = np.stack((0.5 * (1.0 - t) ** 2, 0.5 + t * (1.0 - t), 0.5 * t * t))
    return base.astype(np.intp), weights, np.stack((t - 1.0, 1.0 - 2.0 * t, t))


@dataclass(frozen=True, eq=False)
class QuadraticSpline:
    """A quadratic B-spline of texels (n, n, c) over a square, texel centres at (i + ½)/n."""

    texels: Floats
    size: float

    def _sums(self, x: Floats, z: Floats, kinds: tuple[tuple[int, int], ...]) -> Floats:
        """Sums over the nine texels around places, by weights (0) or slopes (1) along x and z; (kinds, r, c)."""
        count, _, channels = self.texels.shape
        flat, totals = self.texels.reshape(-1, channels), np.zeros((len(kinds), x.size, channels))
        at = [_quadratic(np.clip(place / self.size + 0.5, 0.0, 1.0) * count - 0.5) for place in (x, z)]
        (columns, *by_x), (rows, *by_z) = at
        for j, i in product(range(3), repeat=2):
            row, column = (np.clip(base + k - 1, 0, count - 1) for base, k in ((rows, j), (columns, i)))
            here = flat[row * count + column]
            for total, (along, across) in zip(totals, kinds, strict=True):
                total += (by_z[across][j] * by_x[along][i])[:, None] * here
        return totals

    def value(self, x: Floats, z: Floats) -> Floats:
        """(r, c) at (x, z), m from the centre of the square; outside it the value of the nearest point inside."""
        return self._sums(x, z, ((0, 0),))[0, :]

    def all(self, x: Floats, z: Floats) -> Pair:
        """Value (r, c) and its derivatives along x and z, (2, r, c) per metre. Outside the square derivatives are 0."""
        total, *changes = self._sums(x, z, ((0, 0), (1, 0), (0, 1)))
        inside = np.abs(np.stack((x, z))) <= 0.5 * self.size
        return total, np.stack(changes) * (self.texels.shape[0] / self.size * inside)[..., None]


@lru_cache(maxsize=8)
def floor_spline(shore: Shore) -> QuadraticSpline:
    return QuadraticSpline(floor_grid(shore, FLOOR), shore.size)


@lru_cache(maxsize=8)
def _smooth(shore: Shore) -> tuple[Floats, Floats, Floats, Floats]:
    """Distance (m), depth (m) and the gradient of the distance, smoothed; (MAP, MAP) each."""
    centres = ((np.arange(MAP) + 0.5) / MAP - 0.5) * shore.size
    x, z = np.meshgrid(centres, centres, indexing="xy")
    heights = floor_spline(shore).value(x.ravel(), z.ravel())[:, 0].reshape(MAP, MAP)
    texel = shore.size / MAP
    deviation = min(shore.smoothing / texel, MAP / 12.0)
    d = gaussian(signed_distance(heights >= 0.0) * texel, deviation)
    depth = gaussian(-heights, deviation)
    g_x, g_z = (ndimage.sobel(d, axis=axis, mode="nearest") / (8.0 * texel) for axis in (1, 0))
    return d, depth, g_x, g_z


def travel(shore: Shore, d: Floats) -> Floats:
    """Time from a distance d (m) to the shore at √(g h) over a floor of constant slope, in periods."""
    least = max(SWASH * shore.surf.height, LEAST)
    out, inward = np.maximum(d, 0.0), np.minimum(d, 0.0)
    seconds = 2.0 * out / (math.sqrt(least) + np.sqrt(least + shore.slope * out)) + inward / math.sqrt(least)
    return seconds / (math.sqrt(GRAVITY) * shore.surf.period)


def _rhythm(surf: Surf, time: float, x: Floats, z: Floats) -> Floats:
    """Factor of the waves' height at (x, z), m from the square's centre; of the shape of ``x``."""
    total = np.zeros_like(x)
    for i, (wavelength, heading, period) in enumerate(MASK):
        k, omega = 2.0 * math.pi / wavelength, 2.0 * math.pi / period
        phase = reduced((omega, time), plus=1.7 * i)
        total += np.sin(phase + k * (math.cos(heading) * x + math.sin(heading) * z))
    return 1.0 - surf.variation * smoothstep(-0.8, 0.8, 0.5 * total)


def shore_map(shore: Shore, time: float) -> Floats:
    """(MAP, MAP, 4): phase (periods), height (m), skew (0 to 1) and share of the open sea's waves."""
    d, depth, g_x, g_z = _smooth(shore)
    surf = shore.surf
    centres = ((np.arange(MAP) + 0.5) / MAP - 0.5) * shore.size
    x, z = np.meshgrid(centres, centres, indexing="xy")
    if surf.refraction:
        arrived, left = np.moveaxis(travel_grid(shore, MAP), -1, 0)
        periods = -arrived
    else:
        steep = np.hypot(g_x, g_z)
        met = -(g_x * math.cos(surf.heading) + g_z * math.sin(surf.heading)) / np.maximum(steep, 1e-6)
        left = 1.0 - surf.exposure + surf.exposure * step_between(-0.3, 0.7, met)
        left = left * step_between(0.3, 0.8, steep)
        periods = travel(shore, d)
    open_ = np.ones_like(d)
    if shore.kind == "lagoon":
        open_ = step_between(0.85 * shore.radius, 1.1 * shore.radius, np.hypot(x, z))
    breaks = max(surf.height, LEAST) / BREAKS
    beach = SWASH + (1.0 - SWASH) * step_between(0.0, breaks, depth)
    shoal = np.where(depth >= breaks, (breaks / np.maximum(depth, breaks)) ** 0.25, beach)
    near = 1.0 - step_between(0.45 * shore.deep, 0.9 * shore.deep, depth)
    inland = step_between(-1.2 * max(surf.height, LEAST) / shore.slope, 0.0, d)
    return np.stack(
        (
            periods,
            surf.height * shoal * near * inland * left * open_ * _rhythm(surf, time, x, z),
            1.0 - step_between(breaks, 2.5 * breaks, depth),
            step_between(0.0, 0.6 * shore.deep, depth) * (0.1 + 0.9 * open_),
        ),
        axis=-1,
    )


class Profiles:
    """The table of profiles: quadratic splines along a wave, straight lines between rows."""

    def __init__(self, skew: float, sharpness: float) -> None:
        self.table = shore_profiles(NODES, skew, sharpness).astype(np.float64)

    def __call__(self, turn: Floats, skew: Floats) -> tuple[Floats, Floats, Floats]:
        """Height in [0, 1], its derivative per period and its derivative by skew; (r,) each."""
        rows, nodes = self.table.shape
        base, weights, slopes = _quadratic(turn * nodes - 0.5)
        y = np.clip(skew, 0.0, 1.0) * (rows - 1)
        row = np.minimum(y.astype(np.intp), rows - 2)
        share = y - row
        around = (base + np.arange(-1, 2)[:, None]) % nodes
        here = self.table[row + np.arange(2)[:, None, None], around]
        value, slope = (weights * here).sum(axis=1), (slopes * here).sum(axis=1)
        turned = (slope[0] + share * (slope[1] - slope[0])) * nodes
        return value[0] + share * (value[1] - value[0]), turned, (value[1] - value[0]) * (rows - 1)


profiles = lru_cache(maxsize=8)(Profiles)
