"""Section 8: a shore at one time, around one origin: its map, its waves, its land, its foam, its colours.

Distances come from SciPy's exact Euclidean transform, where the shaders use jump flooding; everything else follows the
page. Map, floor and profiles are grids of texels with quadratic splines between them, which is part of the model, so
the grids here are the same, those of the ``reference`` quality.
"""

import math
from functools import cached_property, lru_cache

import numpy as np
from scipy import ndimage

from seafoam.ocean.constants import WATER_INDEX
from seafoam.reference.light.light import Floor, plain_floor
from seafoam.reference.noise import filtered_step, footprint_variance, grain, patches
from seafoam.reference.shore import maps
from seafoam.reference.shore.soil import Soil, detailed, splashed
from seafoam.reference.types import Bounds, Floats, Footprints, Pair, ReliefPart, Sunlight, Vec2, dot, smoothstep, unit
from seafoam.reference.waves.parametric import reduced
from seafoam.scene import Shore, SurfSaturation

SHALLOW = (0.1, 0.6)
"""Depths of the floor at which the look of soaked land starts to give way to that of the plain ground, and has, m."""
FALL_LEAST = 0.25
REFRACTION_STEPS = 16
PLAIN_FILM_ROUGHNESS2 = 0.02  # mean square slope of the film of water on land without detail
DRYING = 4.0, 40.0  # times in which the film of water and the sand dry to 1/e, s
SAFE_STEPS = 20000
WEED = np.array([0.08, 0.085, 0.05])
EDGE = 1e-3, 0.15  # minimum and maximum of the change of depth over a footprint at the water's edge, m
PATCHES = (6.0, True), (1.7, False), (0.5, True)
"""Cells of the noise that tears the surf's foam, m, and whether they are turned."""
SHADOW_CELLS = 128  # cells along a side of the map of shadows
SHADOW_STEPS = 256  # steps toward the sun
SUN_RADIUS = 0.00465  # angular radius of the sun, rad
STEEPEST, LOWEST_RISE = 1.5, 1e-3  # greatest elevation of a rim (rad) and least slope of its sight
SHADOW_REACH = 1.5  # end of those steps, in sides of the square
SHADOW_SOFT = 0.25  # error of an edge's place that softens it, cells


def _swing(here: Floats, phase: Floats, turn: Floats) -> Floats:
    """Displacement of the surf's foam along the gradient of the phase (2, r), m; (2, r)."""
    result: Floats = 1.5 * here[:, 1] * np.sin(2.0 * math.pi * turn) / np.maximum(np.hypot(*phase), 1e-6) * phase
    return result


class Coast:
    """The shore of a scene at a time, x and z from an origin (m); its sea, with all waves, is a part of the surface."""

    def __init__(self, shore: Shore, time: float, origin: Vec2, open_sea: ReliefPart, *, splash: float = 0.0) -> None:
        self.shore = shore
        self.splash = splash
        self.open_sea = open_sea
        self.offset = tuple(math.remainder(a - b, maps.PERIOD) for a, b in zip(origin, shore.place, strict=True))
        self.floor = maps.floor_spline(shore)
        self.field = maps.QuadraticSpline(maps.shore_map(shore, time), shore.size)
        self.profiles = maps.profiles(shore.surf.skew, shore.surf.sharpness)
        self.time = reduced((-2.0 * math.pi / shore.surf.period, time)) / (2.0 * math.pi)
        self.land = Land(self)

    def _change(self, values: Floats) -> Floats:
        """Greatest derivative of a map's channel around each texel, per metre: an upper bound of its spline's."""
        texel = self.shore.size / maps.MAP
        steps = (np.abs(np.diff(values, axis=axis, append=values.take([-1], axis))) for axis in (0, 1))
        result: Floats = np.hypot(*(ndimage.maximum_filter(step, 5) for step in steps)) / texel
        return result

    @cached_property
    def bounds(self) -> Bounds:
        sea, table = self.open_sea.bounds, self.profiles.table
        phase, rise, skew, share = (self._change(part) for part in np.moveaxis(self.field.texels, -1, 0))
        tall = ndimage.maximum_filter(self.field.texels[..., 1], 5)
        turn = float(np.abs(np.diff(table, axis=1, append=table[:, :1])).max()) * maps.NODES
        rows = float(np.abs(np.diff(table, axis=0)).max()) * (table.shape[0] - 1)
        own = tall * (turn * phase + rows * skew) + rise
        swing = max(sea.top, -sea.trough)
        shared = swing * float(share.max()) if swing > 0.0 else 0.0
        bend = float(np.abs(np.diff(table, 2, axis=1)).max()) * maps.NODES * maps.NODES
        steps = phase[tall > 0.0]
        return Bounds(
            sea.top + self.shore.surf.height,
            sea.trough,
            sea.slope + shared + 1.01 * float(own.max()),
            sea.curvature + 1.3 * float((tall * bend * phase**2).max()),
            min(sea.shape, 0.1 / float(steps.max())) if steps.size else sea.shape,
        )

    def place(self, x: Floats, z: Floats) -> Pair:
        """(x, z) relative to the centre of the square, m."""
        return x + self.offset[0], z + self.offset[1]

    def within(self, d: Floats, x: Floats | float = 0.0, z: Floats | float = 0.0) -> Pair:
        """Distances at which unit rays d (r, 3) from (x, z) enter and leave the square, m; (r,), entry > exit for a
        miss."""
        low, high = np.zeros(d.shape[0]), np.full(d.shape[0], np.inf)
        for axis, offset, start in zip((0, 2), self.offset, (x, z), strict=True):
            along = np.where(np.abs(d[:, axis]) < 1e-12, 1e-12, d[:, axis])
            ends = np.sort([(side * self.shore.size - offset - start) / along for side in (-0.5, 0.5)], axis=0)
            low, high = np.maximum(low, ends[0]), np.minimum(high, ends[1])
        return low, high

    def turn(self, phase: Floats) -> Floats:
        """Phase of a place in its wave, in periods: 0 on the crest, increasing toward the shore."""
        turns = self.time - phase
        return turns - np.floor(turns)

    def height(self, x: Floats, z: Floats) -> Floats:
        total, (q_x, q_z) = self.open_sea.height(x, z), self.place(x, z)
        # At the square's edge the shore's waves have height 0 and the sea's have their full height.
        inside = np.flatnonzero((np.abs(q_x) <= 0.5 * self.shore.size) & (np.abs(q_z) <= 0.5 * self.shore.size))
        here, own = self.field.value(q_x[inside], q_z[inside]), np.zeros(inside.size)
        up = np.flatnonzero(here[:, 1] > 0.0)
        profile, _, _ = self.profiles(self.turn(here[up, 0]), here[up, 2])
        own[up] = here[up, 1] * profile
        total[inside] = total[inside] * here[:, 3] + own
        return total

    def gradient(self, x: Floats, z: Floats) -> Floats:
        H, along, (q_x, q_z) = self.open_sea.height(x, z), self.open_sea.gradient(x, z), self.place(x, z)
        beyond = (np.abs(q_x) > 0.5 * self.shore.size) | (np.abs(q_z) > 0.5 * self.shore.size)
        here, change = self.field.all(q_x, q_z)
        profile, turned, skewed = self.profiles(self.turn(here[:, 0]), here[:, 2])
        own = change[..., 1] * profile + here[:, 1] * (skewed * change[..., 2] - turned * change[..., 0])
        joined = along * here[:, 3] + H * change[..., 3] + np.where(here[:, 1] > 0.0, own, 0.0)
        return np.where(beyond, along, joined)

    def to_rest(self, sea: Floats, x: Floats, z: Floats) -> Floats:
        """Displacement from (x, z) to the rest position of the water there, m; (2, r). ``sea``: the open sea's."""
        here, change = self.field.all(*self.place(x, z))
        return here[:, 3] * sea + _swing(here, change[..., 0], self.turn(here[:, 0]))

    def foam(self, source: SurfSaturation, x: Floats, z: Floats, H: Floats, footprints: Footprints | None) -> Floats:
        """Saturation of the surf's foam at (x, z), where the sea has height H, averaged over footprints; (r,)."""
        q_x, q_z = self.place(x, z)
        here, change = self.field.all(q_x, q_z)
        phase, turn = change[..., 0], self.turn(here[:, 0])
        turns = np.minimum(footprint_variance(phase, footprints), 0.04)
        front = filtered_step(0.8, 1.0, turn, turns) - filtered_step(1.01, 1.09, turn, turns)
        front += filtered_step(0.8, 1.0, turn + 1.0, turns) - filtered_step(1.01, 1.09, turn + 1.0, turns)
        age, even = np.exp((turn - 1.0) / source.life), source.life * (1.0 - math.exp(-1.0 / source.life))
        age = age + smoothstep(0.0, 0.04, turns) * (even - age)
        scale = max(self.shore.surf.height, 1e-6)
        breaking = smoothstep(0.45, 0.9, here[:, 2]) * smoothstep(0.12, 0.4, here[:, 1] / scale)
        swing_x, swing_z = _swing(here, phase, turn)
        torn = patches(q_x + swing_x, q_z + swing_z, PATCHES, footprints)
        ground, g_x, g_z, _ = self.ground(q_x, q_z)
        film = 1.0 - smoothstep(0.0, 0.15, H - ground)
        at_front, behind = front * (0.65 + 0.55 * torn), age * (0.3 + 0.9 * torn)
        left = source.amount * np.maximum(at_front, behind) * (1.0 + film)
        result: Floats = breaking * (left + 2.0 * source.veil * torn)
        if footprints is None:
            return result
        h_x, h_z = self.gradient(x, z)
        deepens = sum(np.abs((h_x - g_x) * foot[:, 0] + (h_z - g_z) * foot[:, 1]) for foot in footprints)
        share = np.clip(2.0 * (H - ground) / np.clip(deepens, *EDGE), 0.0, 1.0)
        swept = self._swept(source, here, phase, ground, torn, footprints)
        result = swept + share * (np.minimum(result, 1.0) - swept)
        return result

    def swash_foam(
        self, source: SurfSaturation, x: Floats, z: Floats, ground: Floats, footprints: Footprints | None
    ) -> Floats:
        """Saturation of the foam that the swash leaves at (x, z) on ground of that height (r,) m; (r,)."""
        q_x, q_z = self.place(x, z)
        here, change = self.field.all(q_x, q_z)
        torn = patches(q_x, q_z, PATCHES, None)
        return self._swept(source, here, change[..., 0], ground, torn, footprints)

    def _swept(
        self,
        source: SurfSaturation,
        here: Floats,
        phase: Floats,
        ground: Floats,
        torn: Floats,
        footprints: Footprints | None,
    ) -> Floats:
        """The same with given map, gradient of its phase and patches; at most 1 when averaged over footprints."""
        reach = ground / np.maximum(here[:, 1], 1e-3)
        since = self.turn(here[:, 0]) - 1.0
        ran_up = smoothstep(0.02, 0.1, here[:, 1] / max(self.shore.surf.height, 1e-6))
        swept = 1.0 - smoothstep(0.85, 1.0, reach)
        turned = smoothstep(0.55, 0.9, reach) * (1.0 - smoothstep(0.95, 1.05, reach))

        def after(since: Floats) -> Floats:
            both = swept * np.exp(since / source.life) + turned * np.exp(since / (3.0 * source.life))
            return source.line * ran_up * (0.3 + 0.9 * torn) * both

        if footprints is None:
            return after(since)
        width = np.clip(sum(np.abs(phase[0] * foot[:, 0] + phase[1] * foot[:, 1]) for foot in footprints), 1e-5, 1.0)
        late = since < -0.5
        share = np.maximum(0.5 - np.where(late, since + 1.0, -since) / width, 0.0)
        own, beyond = np.minimum(after(since), 1.0), np.minimum(after(np.where(late, 0.0, -1.0)), 1.0)
        result: Floats = own + share * (beyond - own)
        return result

    def ground(self, q_x: Floats, q_z: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Height of the ground (m), its gradient and its tint; (r,) each. Arguments: m from the square's centre."""
        here, (along_x, along_z) = self.floor.all(q_x, q_z)
        return here[:, 0], along_x[:, 0], along_z[:, 0], here[:, 1]

    def crossing(self, x: Floats, y: Floats, z: Floats, d: Floats, farthest: float) -> Floats:
        """Distance along rays d (r, 3) from (x, y, z) to the ground, m; (r,), ``farthest`` for a miss."""
        far = np.zeros_like(x)
        result = np.full_like(x, farthest)
        left = np.arange(x.size)
        steepest = _steepest(self.floor.texels[..., 0], self.shore.size)
        closing = np.maximum(steepest * np.hypot(d[:, 0], d[:, 2]) - d[:, 1], 1e-9)
        for _ in range(SAFE_STEPS):
            s, ray = far[left], d[left]
            here = self.ground(*self.place(x[left] + s * ray[:, 0], z[left] + s * ray[:, 2]))[0]
            gap = y[left] + s * ray[:, 1] - here
            met = gap <= 1e-9 * (1.0 + s)
            result[left[met]] = s[met]
            gone = (s > farthest) | ((ray[:, 1] > 0.0) & (y[left] + s * ray[:, 1] > self.land.bounds.top))
            far[left] = s + gap / closing[left]
            left = left[~met & ~gone]
            if left.size == 0:
                return result
        result[left] = far[left]
        return np.minimum(result, farthest)

    def seen(self, x: Floats, z: Floats, H: Floats, d: Floats, n: Floats, footprints: Footprints) -> Floor:
        """The floor along rays d (r, 3) refracted at (x, z), where the water has height H and unit normals n (r, 3)."""
        q_x, q_z = self.place(x, z)
        c = dot(n, d)
        root = np.sqrt(1.0 - (1.0 - c * c) / WATER_INDEX**2)
        r = d / WATER_INDEX - (c / WATER_INDEX + root)[:, None] * n
        fall = np.maximum(-r[:, 1], FALL_LEAST)
        at_x, at_z = q_x, q_z
        under = np.maximum(H - self.floor.value(q_x, q_z)[:, 0], 0.0)
        for _ in range(REFRACTION_STEPS):
            at_x, at_z = q_x + r[:, 0] * under / fall, q_z + r[:, 2] * under / fall
            under = np.maximum(H - self.floor.value(at_x, at_z)[:, 0], 0.0)
        colour = self.albedo(at_x, at_z, footprints)
        deep = smoothstep(*SHALLOW, -self.floor.value(at_x, at_z)[:, 0])
        near = np.flatnonzero(deep < 1.0)
        if self.shore.detail > 0.0:
            soaked, place = np.ones(near.size), (at_x[near], at_z[near])
            sides = footprints[0][near], footprints[1][near]
            soil = detailed(self.shore, place, self.ground(*place), sides, (soaked, soaked), floor=True)
            colour[near] = soil.albedo + deep[near, None] * (colour[near] - soil.albedo)
        return plain_floor(under * (1.0 + 1.0 / fall), colour)

    def albedo(self, q_x: Floats, q_z: Floats, footprints: Footprints) -> Floats:
        """Reflectance of the ground; (r, 3)."""
        shore = self.shore
        height, g_x, g_z, tint = self.ground(q_x, q_z)
        fine = grain(q_x, q_z, footprints)
        rocky = smoothstep(0.35, 0.6, np.hypot(g_x, g_z) + 0.25 * (fine - 0.5))
        above = height + 4.0 * (tint - 0.5) + 1.5 * (fine - 0.5)
        grown = smoothstep(shore.plants_from, 1.25 * shore.plants_from + 0.5, above)
        reef = shore.reef * smoothstep(0.52, 0.6, tint + 0.12 * (fine - 0.5)) * smoothstep(0.4, 2.0, -height)
        colour = np.array(shore.sand) * (0.8 + 0.4 * fine)[:, None]
        for share, other in (
            (reef, WEED * (0.5 + fine)[:, None]),
            (grown, np.array(shore.plants) * (0.4 + 1.2 * fine)[:, None]),
            (rocky, np.array(shore.rock) * (0.5 + fine)[:, None]),
        ):
            colour = colour + share[:, None] * (other - colour)
        return colour * (1.0 - 0.45 * self.wet(height))[:, None]

    def soil(self, q_x: Floats, q_z: Floats, footprints: Footprints, *, still: bool) -> Soil:
        """What land looks like; ``still``: as wet as by its height alone."""
        ground = self.ground(q_x, q_z)
        height, g_x, g_z, _ = ground
        by_height = self.wet(height), 0.6 * self.wet(height)
        if self.shore.detail > 0.0:
            wet = by_height if still else self.wetness(q_x, q_z, height)
            dry = detailed(self.shore, (q_x, q_z), ground, footprints, wet)
            return dry if self.splash == 0.0 else splashed(dry, self.splash, ground, wet[0])
        normal = unit(np.stack((-g_x, np.ones_like(g_x), -g_z), axis=-1))
        return Soil(normal, self.albedo(q_x, q_z, footprints), by_height[1], PLAIN_FILM_ROUGHNESS2, glints=False)

    def wetness(self, q_x: Floats, q_z: Floats, height: Floats) -> Pair:
        """How dark the swash left the ground, and how much of it mirrors; (r,) each."""
        surf, dark = self.shore.surf, self.wet(height)
        if surf.height <= 0.0:
            return dark, 0.6 * dark
        swash = maps.SWASH * surf.height
        film = 1.0 - smoothstep(0.1 * swash, 0.6 * swash + 0.03, height)
        here = self.field.value(q_x, q_z)
        swept = 1.0 - smoothstep(0.8, 1.05, height / np.maximum(here[:, 1], 1e-3))
        since = (self.turn(here[:, 0]) - 1.0) * surf.period
        near = height <= 1.3 * swash + 0.2
        after = [np.where(near, swept * np.exp(since / drying), 0.0) for drying in DRYING]
        return np.maximum(dark, after[1]), np.maximum(film, after[0])

    def wet(self, height: Floats) -> Floats:
        """Wetness of ground of a height (m): 1 where every wave reaches it; of the shape of ``height``."""
        reach = maps.SWASH * self.shore.surf.height
        return 1.0 - smoothstep(0.5 * reach, 1.1 * reach + 0.05, height)


class Land:
    """The land above y = 0, as a part of the surface."""

    def __init__(self, coast: Coast) -> None:
        self.coast = coast
        heights = coast.floor.texels[..., 0]
        step = coast.shore.size / maps.FLOOR
        dry = np.maximum(heights, 0.0)
        bends = [float(np.abs(np.diff(heights[1:-1, 1:-1], 2, axis=axis)).max()) for axis in (0, 1)]
        slope = _steepest(dry, coast.shore.size)
        self.bounds = Bounds(float(dry.max()), 0.0, slope, 3.0 * max(bends) / step**2, 2.0 * step)

    def height(self, x: Floats, z: Floats) -> Floats:
        return np.maximum(self.coast.floor.value(*self.coast.place(x, z))[:, 0], 0.0)

    def gradient(self, x: Floats, z: Floats) -> Floats:
        height, *slope, _ = self.coast.ground(*self.coast.place(x, z))
        return np.where(height > 0.0, slope, 0.0)


def _steepest(heights: Floats, size: float) -> float:
    """Upper bound of the slope of a map of heights (n, n) of a square of this side, m."""
    steps = (float(np.abs(np.diff(heights, axis=axis)).max()) for axis in (0, 1))
    return 1.01 * math.hypot(*steps) * len(heights) / size


def land_shadow(coast: Coast, sun: Floats) -> Sunlight:
    """The share of the sunlight that a coast's land leaves under a sun (3,)."""
    x, y, z = (float(part) for part in sun)
    elevation, level = math.atan2(y, math.hypot(x, z)), max(math.hypot(x, z), 1e-6)
    toward, size = (x / level, z / level), coast.shore.size
    rises = tuple(
        max(math.tan(min(elevation + side * SUN_RADIUS, most)), LOWEST_RISE)
        for side, most in ((1.0, STEEPEST), (-1.0, STEEPEST - 0.01))
    )
    seen_from = maps.QuadraticSpline(_shadow_heights(coast.shore.ground, toward, rises), size)

    def sunlight(place: Floats, footprints: Footprints) -> Floats:
        q = coast.place(place[:, 0], place[:, 2])
        enters = [
            np.maximum(-0.5 * size - math.copysign(1.0, u) * part, 0.0) / max(abs(u), 1e-6)
            for u, part in zip(toward, q, strict=True)
        ]
        far = np.maximum(enters[0], enters[1])
        here, change = seen_from.all(q[0] + far * toward[0], q[1] + far * toward[1])
        slope = change[..., 1].T
        soft = 0.5 * sum(np.abs(dot(slope, side)) for side in footprints) + SHADOW_SOFT * rises[1] * size / SHADOW_CELLS
        low, high = (here[:, i] - far * rise for i, rise in enumerate(rises))
        return smoothstep(0.0, 1.0, (place[:, 1] - low + soft) / (high - low + 2.0 * soft))

    return sunlight


@lru_cache(maxsize=8)
def _shadow_heights(shore: Shore, toward: Vec2, rises: tuple[float, ...]) -> Floats:
    """Heights from which the sun's upper and lower rim are seen over the land, (n, n, 2), rows along z, m."""
    floor = maps.floor_spline(shore)
    side = shore.size / SHADOW_CELLS
    centres = (np.arange(SHADOW_CELLS) + 0.5) * side - 0.5 * shore.size
    x, z = (part.ravel() for part in np.meshgrid(centres, centres, indexing="xy"))
    highest = np.full((x.size, 2), -np.inf)
    for s in np.linspace(0.0, 1.0, SHADOW_STEPS):
        far = side + (SHADOW_REACH * shore.size - side) * s * (0.25 + 0.75 * s)
        ground = floor.value(x + far * toward[0], z + far * toward[1])[:, 0]
        highest = np.maximum(highest, ground[:, None] - far * np.array(rises))
    return highest.reshape(SHADOW_CELLS, SHADOW_CELLS, 2)
