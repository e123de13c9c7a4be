"""Section 16: stones that stand over a current, in float64: where rays meet them, their look, shadow and mirror image.

A stone is the set N(x) ≤ 1 of a norm of the order 8, which is convex: along a ray N falls to a least value and rises
again, so Newton's method from outside comes to the entry from one side.
"""

import math

import numpy as np

from seafoam.ocean.coast.boulders import BOULDER_REACH, boulders, cuts, dome_height, wetted
from seafoam.reference.boats.boat import Hit
from seafoam.reference.light.light import Air, land
from seafoam.reference.noise import perlin
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.shore.soil import CRACKED, KEY, Soil
from seafoam.reference.types import Floats, Pair, Sunlight, dot, smoothstep, unit
from seafoam.scene import Scene, Shore, Stone

LIKE, SOFT, WET, DRY = 0.9, 0.12, 0.3, 1.25
"""Size of the ellipsoid that takes a stone's place in shadow and mirror, in the dome's, and half width of its edge;
reflectance of wet and of dry rock, in that of the land's."""
ROUGHNESS2 = 0.02  # mean square slope of the film on wet rock
SUN_BLUR = 0.005  # rad
CELL, FINER, STRENGTH = 1.9, 0.31, 5.233  # of the rock's octaves: first cells (m), the next in these, over deviation
OCTAVES = (0.62, 0.05), (0.52, 0.07), (0.44, 0.07), (0.38, 0.06)  # shares of the pattern; relief's height over cells
ITERATIONS = 40


class Boulders:
    """The stones of a scene that stand over the water, seen by a camera whose origin is that of places."""

    def __init__(self, scene: Scene, grid: SampleGrid) -> None:
        assert scene.current is not None
        self.stones, self.grid = boulders(scene.current), grid
        self.wetted, self.rock = wetted(scene.current), np.array((scene.shore or Shore()).rock)

    def _local(self, stone: Stone, place: Floats) -> Floats:
        """Places (r, 3) in radii from the stone's middle on still water."""
        x, z = stone.place
        local: Floats = (place + np.array([self.grid.origin[0] - x, 0.0, self.grid.origin[1] - z])) / stone.radius
        return local

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

    def veil(self, stone: Stone, place: Floats, d: Floats, blur: Floats | float) -> Floats:
        """Share (r,) of rays from places (r, 3) that the stone takes, spread by ``blur`` rad."""
        axes = LIKE * np.array([1.0, dome_height(stone) / stone.radius, 1.0])
        o, way = self._local(stone, place) / axes, d / axes
        square = dot(way, way)
        along = np.maximum(-dot(o, way), 0.0) / square
        edge = SOFT + blur * along / LIKE
        miss = np.sqrt(((o + along[:, None] * way) ** 2).sum(axis=1))
        q = np.clip((miss - 1.0 + edge) / (2.0 * edge), 0.0, 1.0)
        taken = (1.0 - q * q * (3.0 - 2.0 * q)) / np.maximum(edge**2, 1.0)
        shown: Floats = taken * smoothstep(0.0, 0.5, along * np.sqrt(square))
        return shown

    def sunlight(self, place: Floats, sun: Floats) -> Floats:
        """Share (r,) of the sunlight that stones leave to places (r, 3)."""
        d = np.broadcast_to(sun, place.shape)
        left: Floats = np.prod([1.0 - self.veil(stone, place, d, SUN_BLUR) for stone in self.stones], axis=0)
        return left

    def mirrored(self, air: Air, place: Floats, r: Floats, blur: Floats, seen: Floats) -> Floats:
        """What arrives from directions r at places on the water, (r, 3), where ``seen`` (r, 3) comes without stones."""
        facing = np.maximum(-(r[:, 0] * air.sun[0] + r[:, 2] * air.sun[2]), 0.0)[:, None]
        rock = WET / math.pi * self.rock * (0.5 * air.sky_irradiance + facing * air.sun_irradiance)
        for stone in self.stones:
            seen = seen + (rock - seen) * self.veil(stone, place, r, blur)[:, None]
        return seen

    def light(self, air: Air, open_sun: Sunlight, o: Floats, d: Floats, hit: Hit) -> Floats:
        """Radiance (r, 3) toward where rays that hit come from, before haze. ``open_sun``: what else leaves."""
        result, step = np.zeros_like(d), math.sqrt(dot(self.grid.steps[1], self.grid.steps[1]))
        for number, stone in enumerate(self.stones):
            rows = np.flatnonzero(hit.boat == number)
            place, way, n = o[rows] + hit.t[rows, None] * d[rows], d[rows], hit.normal[rows]
            depth = dot(place - np.array([0.0, self.grid.eye_y, 0.0]), self.grid.ray_z)
            width = depth * step / np.maximum(-dot(n, way), 0.3)
            soil, level = self._soil(stone, hit.place[rows], n, width, way)
            none = np.zeros((rows.size, 2))
            sun = np.where(dot(n, air.sun) > 0.0, open_sun(place, (none, none)), 0.0)
            result[rows] = land(air, soil, way, level, sun)
        return result

    def _soil(self, stone: Stone, x: Floats, n: Floats, width: Floats, d: Floats) -> tuple[Soil, Floats]:
        """The rock at places (r, 3) in radii under footprints so wide (r,), m; and normals (r, 3) of its film."""
        y, relief, bands, cracks, cell = stone.radius * x[:, 1], np.zeros_like(x), [], np.zeros(len(x)), CELL
        for k, (_, high) in enumerate(OCTAVES):
            kept = 1.0 - smoothstep(0.15, 0.6, width / cell)
            m, slope = (
                STRENGTH * part for part in perlin(x * stone.radius / cell + cuts(stone)[-1], KEY + k, sloped=True)
            )
            bands.append(kept * m)
            relief -= (high * kept * m / np.sqrt(m * m + 0.04))[:, None] * slope.T
            if k in (1, 2):
                cracks += CRACKED + kept * (np.maximum(1.0 - 5.0 * np.abs(m), 0.0) ** 2 - CRACKED)
            cell *= FINER
        relief -= dot(relief, n)[:, None] * n
        normal, level = unit(n - relief), unit(n - 0.6 * relief)
        pattern = sum(share * band for (share, _), band in zip(OCTAVES, bands, strict=True))
        tone = np.maximum(1.0 + 0.3 * pattern, 0.2) * (1.0 - 0.35 * np.minimum(cracks, 1.0))
        warm = np.clip(0.5 * (bands[0] + bands[1]), -1.0, 1.0)[:, None] * np.array([0.12, 0.0, -0.14])
        wet = 1.0 - smoothstep(1.0, 2.0, y / self.wetted - 0.3 * (bands[1] + bands[2] + bands[3]))
        rock = self.rock * (tone * (DRY + (WET - DRY) * wet))[:, None] * (1.0 + warm)
        film = smoothstep(-self.wetted, 0.0, y) * wet * (0.1 + 0.7 * smoothstep(0.8, 1.0, dot(normal, n)))
        rises = d[:, 1] - 2.0 * dot(d, level) * level[:, 1]
        film = film * (0.25 + 0.75 * smoothstep(-0.1, 0.1, rises))
        return Soil(normal, np.minimum(rock, 0.95), film, ROUGHNESS2, glints=True), level


def norm_of(stone: Stone, x: Floats) -> Pair:
    """The norm of places (r, 3) in radii from a stone's middle, (r,), and its gradient (r, 3)."""
    rise = np.where(x[:, 1] > 0.0, stone.radius / dome_height(stone), 0.0)
    dome = np.stack((np.full(len(x), 1.0 / BOULDER_REACH), rise, np.full(len(x), 1.0 / BOULDER_REACH)), axis=-1)
    planes = cuts(stone)[:-1]
    over = np.maximum(x @ planes.T, 0.0)
    round_part = np.sqrt(dot(dome * x, dome * x))
    total = round_part**8 + (over**8).sum(axis=1)
    gradient = (round_part**6)[:, None] * dome * dome * x + over**7 @ planes
    return total**0.125, np.maximum(total, 1e-12)[:, None] ** -0.875 * gradient


def _way(stone: Stone, o: Floats, d: Floats) -> Floats:
    """Way to a stone in radii, (r,), infinite where rays miss it."""
    top, safe = dome_height(stone) / stone.radius, np.where(np.abs(d) < 1e-12, 1e-12, d)
    low = np.array([-BOULDER_REACH, -1e5, -BOULDER_REACH])
    ends = np.sort(np.stack(((low - o) / safe, (np.array([BOULDER_REACH, top, BOULDER_REACH]) - o) / safe)), axis=0)
    t, leave = np.maximum(ends[0].max(axis=1), 0.0), ends[1].min(axis=1)
    for _ in range(ITERATIONS):
        norm, gradient = norm_of(stone, o + np.where(t <= leave, t, 0.0)[:, None] * d)
        rate = dot(gradient, d)
        step = np.where(rate < 0.0, (norm - 1.0) / np.where(rate < 0.0, -rate, 1.0), np.inf)
        t = np.where(norm > 1.0, t + step, t)
    norm, _ = norm_of(stone, o + np.where(t <= leave, t, 0.0)[:, None] * d)
    return np.where((t <= leave) & (norm <= 1.001), t, np.inf)
