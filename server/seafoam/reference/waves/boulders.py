"""Section 16: stones that stand over a current, in float64: where rays meet them, their look, shadow and mirror image.

A stone is the set N(x) ≤ 1 of a norm of the order 8, which is convex: along a ray N falls to a least value and rises
again, so Newton's method from outside comes to the entry from one side.
"""

import math

import numpy as np

from seafoam.ocean.coast.boulders import BOULDER_REACH, cuts
from seafoam.reference.boats.boat import Hit
from seafoam.reference.light.light import Air, land
from seafoam.reference.noise import perlin
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.shore.soil import CRACKED, KEY, Soil
from seafoam.reference.types import Floats, Pair, Sunlight, dot, smoothstep, unit
from seafoam.scene import Current, Shore, Stone

WET, DRY, CELL = 0.3, 1.25, 1.9  # reflectance of wet and of dry rock, in that of the land's; first cells of noise, m
OCTAVES = (0.62, 0.05), (0.52, 0.07), (0.44, 0.07), (0.38, 0.06)  # shares of the pattern; relief's height over cells


class Boulders:
    """The stones of a current that stand over the water, seen by a camera whose origin is that of places."""

    def __init__(self, current: Current, shore: Shore | None, grid: SampleGrid, under: bool) -> None:
        self.mirrors = 0.0 if under else 1.0  # under water no film does
        self.stones, self.wetted, self.grid = current.standing, current.wetted, grid
        self.rock = np.array((shore or Shore()).rock)

    def _local(self, stone: Stone, place: Floats) -> Floats:
        """Places (r, 3) in radii from the stone's middle on still water."""
        x, z = self.grid.origin[0] - stone.place[0], self.grid.origin[1] - stone.place[1]
        return np.asarray((place + np.array([x, 0.0, z])) / stone.radius)

    def trace(self, o: Floats, d: Floats) -> Hit:
        """First hits of rays o + t d, d (r, 3) unit vectors, with t ≥ 0: ``place`` in radii from a stone's middle."""
        none, flat = np.zeros(len(d)), np.zeros_like(d)
        hit = Hit(np.full(len(d), np.inf), flat, flat.copy(), none, none - 1.0)
        for number, stone in enumerate(self.stones):
            start = self._local(stone, np.broadcast_to(o, d.shape))
            way = _way(stone, start, d)
            rows = np.flatnonzero(way * stone.radius < hit.t)
            hit.boat[rows], hit.t[rows] = number, way[rows] * stone.radius
            hit.place[rows] = start[rows] + way[rows, None] * d[rows]
            hit.normal[rows] = unit(norm_of(stone, hit.place[rows])[1])
        return hit

    def _veil(self, stone: Stone, place: Floats, d: Floats, blur: Floats | float) -> Floats:
        """Share (r,) of rays from places (r, 3), spread by ``blur`` rad, that the ellipsoid most like a stone takes."""
        axes = 0.9 * np.array([1.0, stone.dome / stone.radius, 1.0])
        o, way = self._local(stone, place) / axes, d / axes
        along = np.maximum(-dot(o, way), 0.0) / dot(way, way)
        edge, miss = 0.12 + blur * along / 0.9, o + along[:, None] * way
        taken = 1.0 - smoothstep(0.0, 1.0, (np.sqrt(dot(miss, miss)) - 1.0 + edge) / (2.0 * edge))
        before = smoothstep(0.0, 0.5, along * np.sqrt(dot(way, way)))
        return np.asarray(taken * before / np.maximum(edge**2, 1.0))

    def sunlight(self, place: Floats, sun: Floats) -> Floats:
        """Share (r,) of the sunlight that stones leave to places (r, 3)."""
        d = np.broadcast_to(sun, place.shape)
        left = [np.ones(len(place)), *(1.0 - self._veil(stone, place, d, 0.005) for stone in self.stones)]
        return np.asarray(np.prod(left, axis=0))

    def mirrored(self, air: Air, place: Floats, r: Floats, blur: Floats, seen: Floats) -> Floats:
        """What arrives from directions r at places on the water, (r, 3), where ``seen`` (r, 3) comes without stones."""
        facing = np.maximum(-(r[:, ::2] @ air.sun[::2]), 0.0)[:, None]
        rock = WET / math.pi * self.rock * (0.5 * air.sky_irradiance + facing * air.sun_irradiance)
        for stone in self.stones:
            seen = seen + (rock - seen) * self._veil(stone, place, r, blur)[:, None]
        return seen

    def light(self, air: Air, open_sun: Sunlight, o: Floats, d: Floats, hit: Hit) -> Floats:
        """Radiance (r, 3) toward where rays that hit come from, before haze. ``open_sun``: what else leaves."""
        result, step = np.zeros_like(d), math.sqrt(dot(self.grid.steps[1], self.grid.steps[1]))
        for number, stone in enumerate(self.stones):
            rows = np.flatnonzero(hit.boat == number)
            place, way, n = o[rows] + hit.t[rows, None] * d[rows], d[rows], hit.normal[rows]
            depth = (place - np.array([0.0, self.grid.eye_y, 0.0])) @ self.grid.ray_z
            soil, level = self._soil(stone, hit.place[rows], n, depth * step / np.maximum(-dot(n, way), 0.3), way)
            none = np.zeros((rows.size, 2))
            sun = np.where(dot(n, air.sun) > 0.0, open_sun(place, (none, none)), 0.0)
            result[rows] = land(air, soil, way, level, sun)
        return result

    def _soil(self, stone: Stone, x: Floats, n: Floats, width: Floats, d: Floats) -> tuple[Soil, Floats]:
        """The rock at places (r, 3) in radii under footprints so wide (r,), m; and normals (r, 3) of its film."""
        relief, bands, cracks = np.zeros_like(x), np.zeros((4, len(x))), np.zeros(len(x))
        for k, (_, high) in enumerate(OCTAVES):
            cell = CELL * 0.31**k
            kept = 1.0 - smoothstep(0.15, 0.6, width / cell)
            at = x * stone.radius / cell + cuts(stone)[-1]
            m, slope = (5.233 * part for part in perlin(at, KEY + k, sloped=True))
            bands[k] = kept * m
            relief -= (high * kept * m / np.sqrt(m * m + 0.04))[:, None] * slope.T
            if k in (1, 2):
                cracks += CRACKED + kept * (np.maximum(1.0 - 5.0 * np.abs(m), 0.0) ** 2 - CRACKED)
        relief -= dot(relief, n)[:, None] * n
        normal, level, y = unit(n - relief), unit(n - 0.6 * relief), stone.radius * x[:, 1]
        pattern = np.array(OCTAVES)[:, 0] @ bands
        tone = np.maximum(1.0 + 0.3 * pattern, 0.2) * (1.0 - 0.35 * np.minimum(cracks, 1.0))
        warm = np.clip(0.5 * (bands[0] + bands[1]), -1.0, 1.0)[:, None] * np.array([0.12, 0.0, -0.14])
        wet = 1.0 - smoothstep(1.0, 2.0, y / self.wetted - 0.3 * bands[1:].sum(axis=0))
        rock = self.rock * (tone * (DRY + (WET - DRY) * wet))[:, None] * (1.0 + warm)
        film = (
            self.mirrors * smoothstep(-self.wetted, 0.0, y) * wet * (0.1 + 0.7 * smoothstep(0.8, 1.0, dot(normal, n)))
        )
        film = film * (0.25 + 0.75 * smoothstep(-0.1, 0.1, d[:, 1] - 2.0 * dot(d, level) * level[:, 1]))
        return Soil(normal, np.minimum(rock, 0.95), film, 0.02, glints=True), level


def norm_of(stone: Stone, x: Floats) -> Pair:
    """The norm of places (r, 3) in radii from a stone's middle, (r,), and its gradient (r, 3)."""
    dome = np.full_like(x, 1.0 / BOULDER_REACH)
    dome[:, 1] = np.where(x[:, 1] > 0.0, stone.radius / stone.dome, 0.0)
    planes, square = cuts(stone)[:-1], dot(dome * x, dome * x)
    over = np.maximum(x @ planes.T, 0.0)
    total = np.maximum(square**4 + (over**8).sum(axis=1), 1e-12)
    return total**0.125, total[:, None] ** -0.875 * (square[:, None] ** 3 * dome * dome * x + over**7 @ planes)


def _way(stone: Stone, o: Floats, d: Floats) -> Floats:
    """Way to a stone in radii, (r,), infinite where rays miss it, and the box in which it is."""
    safe, box = np.where(np.abs(d) < 1e-12, 1e-12, d), np.full(3, BOULDER_REACH)
    box[1] = stone.dome / stone.radius
    ends = np.sort(np.stack(((box * [-1.0, 0.0, -1.0] - [0.0, 1e5, 0.0] - o) / safe, (box - o) / safe)), axis=0)
    t, leave, norm = np.maximum(ends[0].max(axis=1), 0.0), ends[1].min(axis=1), np.full(len(d), np.inf)
    for _ in range(40):
        near = np.flatnonzero((t <= leave) & (norm > 1.0))
        norm[near], gradient = norm_of(stone, o[near] + t[near, None] * d[near])
        rate = np.minimum(dot(gradient, d[near]), 0.0)
        t[near] += np.maximum(norm[near] - 1.0, 0.0) / np.maximum(-rate, 1e-9)
    return np.where((t <= leave) & (norm <= 1.001), t, np.inf)
