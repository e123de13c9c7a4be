"""Section 9: the layer of clouds. Colours are linear RGB along the last axis, directions unit vectors (x, y, z)."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy import special

from seafoam.reference.noise import GAIN, PERIOD, fractal, octaves
from seafoam.reference.types import Floats, Footprints, Pair, Vec3, dot, henyey_greenstein, smoothstep
from seafoam.reference.waves.parametric import noise_place, reduced
from seafoam.scene import Cirrus, Clouds

Spread = Pair
Depth = Callable[[Floats], Floats]
FORWARD = 0.76
EARTH = 6.371e6
OCTAVES = 6
WIDTH = 1.4
"""Width at which a cell of noise fades, over the standard deviation of the place at which it is read."""
SLICES = np.array([0.0, 0.4, 0.8])  # heights of the slices of clouds, of their depth
TAPER, STEP, CORE, DARK, RELIEF, OCTAVES_AHEAD = 0.9, 0.2, -1.2, 0.3, 0.3, 2
"""Rise of the edge's noise from foot to top; cells toward the lamp; noise over which a core deepens; darkness of what
diffuse light passes; shading by the rise toward the lamp; octaves of it."""
AHEAD = (0.712, 0.382, 0.589)
"""What noise toward the lamp has of the first octave here, of the finer ones, and of its own, by the correlation of
gradient noise."""
LATTICE, ROOT = 8192, 1.1347241384015194  # points of the means over noise, and the root of x⁶ = x + 1
SHADED = 0.85  # share of the air under an overcast sky that no lamp lights
STRETCH = 8.0
RAIN_SIZES = (2.0, 5.0, 10.0)
RAIN_SLANT, RAIN_SPREADS, RAIN_FADES, RAIN_LIGHT = (0.2, 0.1, -0.25), 0.06, 30000.0, 0.55
SHADOW_OCTAVES = 4
PENUMBRA = 0.00233  # standard deviation of directions over the sun's disc, rad
LEAST_PASSED = 1e-4  # least mean transmittance by which that of a column is divided
SPAN = 0.9  # the farthest that slices are parted, cells
EYE = (7e-4, 7e-4)
"""Standard deviation of the directions from which an eye mixes clouds, up and down, and aside, rad."""


@dataclass(frozen=True, eq=False)
class _Layer:
    """Clouds at one time over one camera position, under one lamp."""

    lit_by: Floats  # (3,) unit vector toward the lamp
    light: Floats  # (3,) its irradiance at the height of clouds
    sky: Floats  # (3,) radiance of their ambient light
    eye_y: float


@dataclass(frozen=True, eq=False)
class CloudLayer(_Layer):
    clouds: Clouds
    place: Vec3
    """The camera's position in the clouds' noise, cells."""

    @cached_property
    def taken(self) -> float:
        """Mean share of the light from above that clouds block: a column's opacity over the normal law of the noise."""
        if self.clouds.cover == 0.0 or self.clouds.thickness == 0.0:
            return 0.0
        nodes, shares = np.polynomial.legendre.leggauss(24)
        ends = np.linspace(-8.0, 8.0, 257)
        half = 0.5 * np.diff(ends)[:, None]
        at = (0.5 * (ends[1:] + ends[:-1])[:, None] + half * nodes).ravel()
        weights = (half * shares).ravel() * np.exp(-0.5 * at * at)
        return float(weights @ self._column(at)[0] / weights.sum())

    @cached_property
    def radiance(self) -> Floats:
        """Mean radiance of clouds; (3,)."""
        sunny, forward, grey = self.averages[0].mean(axis=0)
        result: Floats = (sunny + forward / (4.0 * math.pi)) * self.light + grey * self.sky
        return result

    @cached_property
    def averages(self) -> tuple[Floats, float]:
        """Means of :meth:`_column`'s radiance, weighted by the opacity, of slices above each other and of slices that
        share the finer octaves alone, (2, 3); and the mean opacity of the latter less the former's."""
        if self.taken == 0.0:
            return np.zeros((2, 3)), 0.0
        fine, lower, here, upper, else_ = _lattice()
        coarse = math.sqrt(1.0 - GAIN * GAIN)
        ahead = AHEAD[0] * here + AHEAD[1] * fine + AHEAD[2] * else_
        means, covers = [], []
        for slices in ((here, here, here), (lower, here, upper)):
            opaque, *shines = self._column(GAIN * fine + coarse * np.stack(slices), ahead)
            covers.append(float(opaque.mean()))
            means.append([float((opaque * one).sum() / opaque.sum()) for one in shines])
        return np.array(means), covers[1] - covers[0]

    @cached_property
    def edge(self) -> Vec3:
        """Mean and standard deviation of the noise over a slice's start, where its opacity rises, and :attr:`taken`
        less the opacity of edges there that are widened by the variance 1."""
        nodes, weights = np.polynomial.legendre.leggauss(64)
        t = 0.5 * (nodes + 1.0)
        rises = weights * t * (1.0 - t) * np.exp(-self.clouds.thickness / 3.0 * t * t * (3.0 - 2.0 * t))
        rises = rises / rises.sum()
        middle = float(rises @ t)
        deviation = self.clouds.softness * math.sqrt(float(rises @ (t - middle) ** 2))
        middle *= self.clouds.softness
        wide = self._start + middle
        wide = wide - wide * deviation / math.hypot(deviation, 1.0)
        return middle, deviation, self.taken - float(self._column(wide[:, None])[0][0])

    def toward(self, d: Floats, spread: Spread, depth: Depth) -> tuple[Floats, Floats, Floats]:
        """Radiance of clouds toward d (r, 3): (r, 3), and the share of the sky that they cover and hide (r,).

        ``spread``: standard deviations (r,) of the directions that are mixed, up and down, and aside, rad.
        ``depth``: optical depth (..., 3) of the air along directions of height (...,).
        """
        clouds = self.clouds
        under = 1.0 - float(smoothstep(0.5, 0.9, self.eye_y / clouds.height))
        seen = under * smoothstep(0.01, 0.08, d[:, 1])
        shaded = SHADED * self.taken
        light = (under - seen)[:, None] * shaded * self.radiance
        cover, hidden = (under - seen) * shaded, np.zeros(d.shape[0])
        at = np.flatnonzero(seen > 0.0)
        look = d[at]
        distance, slant = distance_to(look, clouds.height - self.eye_y)
        wide = np.maximum(spread[0][at] / slant, spread[1][at])
        width = WIDTH * wide * distance / clouds.size
        noise, ahead, lost, parted, parted_lost = self._noise(look, distance, slant, width)
        opaque, *shines = self._column(noise, ahead)
        # Blurred clouds shine as their mean does.
        (above, beside), apart = self.averages
        means = above[:, None] + (beside - above)[:, None] * parted
        sunny, forward, grey = np.stack(shines) + (means - np.stack(shines)) * np.sqrt(lost)
        sunny = sunny + forward * henyey_greenstein(FORWARD, dot(look, self.lit_by))
        hides = seen[at] * np.clip(opaque + self.edge[2] * lost**1.5 + apart * parted * parted_lost, 0.0, 1.0)
        covers = hides * np.exp(-0.8 * (1.0 - shaded) * np.minimum(depth(look[:, 1])[:, 0], 60.0))
        light[at] += (sunny[:, None] * self.light + grey[:, None] * self.sky) * covers[:, None]
        cover[at] += covers
        hidden[at] = hides
        return light, cover, hidden

    def in_rain(self, light: Floats, hidden: Floats, d: Floats, spread: Spread) -> Pair:
        """Light (r, 3) from behind the rain toward d (r, 3) with the rain's own, and the share (r,) that is hidden."""
        clouds = self.clouds
        high = clouds.height - self.eye_y
        at = np.flatnonzero(d[:, 1] > 0.0)
        if clouds.rain == 0.0 or high <= 0.0:
            return light, hidden
        level = np.maximum(np.hypot(d[at, 0], d[at, 2]), 1e-3)
        heading = d[at][:, [0, 2]] / level[:, None]
        depth = np.zeros(at.size)
        for sizes in RAIN_SIZES:
            far = sizes * clouds.size
            up = far * d[at, 1] / (level * high)
            slanted = np.column_stack((heading * sizes, np.zeros(at.size))) + (1.0 - up)[:, None] * np.array(RAIN_SLANT)
            width = WIDTH * spread[1][at] * sizes + RAIN_SPREADS * np.maximum(1.0 - up, 0.0)
            noise, _ = octaves(slanted + self.place, width, (0, 3), 64 * clouds.seed)
            falls = smoothstep(0.0, 2.0, noise - max(float(self._start[0]), -0.6))
            depth += np.where(up < 1.0, falls * (1.0 - smoothstep(0.2, 1.0, up)) * math.exp(-far / RAIN_FADES), 0.0)
        left = np.ones(d.shape[0])
        left[at] = np.exp(-clouds.rain * depth)
        mixed: Floats = light * left[:, None] + RAIN_LIGHT * self.radiance * (1.0 - left)[:, None]
        return mixed, 1.0 - (1.0 - hidden) * left

    def sunlight(self, place: Floats, footprints: Footprints) -> Floats:
        """Factor (r,) of the lamp's mean light at places (r, 3), m from under the camera; at least 0."""
        clouds = self.clouds
        toward = self.lit_by[None, :]
        distance, slant = (float(part[0]) for part in distance_to(toward, clouds.height))
        tall = clouds.depth / clouds.size
        level = distance / clouds.size + SLICES[1] * min(tall / slant, SPAN)
        left = np.maximum(1.0 - place[:, 1] / clouds.height, 0.0)
        across = place[:, [0, 2]] / clouds.size + (left * level)[:, None] * self.lit_by[[0, 2]]
        slice_place = np.insert(across, 2, SLICES[1] * tall, axis=1) + self.place
        side2 = np.maximum(dot(footprints[0], footprints[0]), dot(footprints[1], footprints[1])) / 12.0
        penumbra = PENUMBRA * distance / math.sqrt(slant)
        width = WIDTH * np.sqrt(side2 + penumbra**2) / clouds.size
        noise, lost = octaves(slice_place, width, (0, SHADOW_OCTAVES), 64 * clouds.seed)
        # A normal law by the noise, which lacks the variance ``lost``: its mean is one less ``taken``.
        middle, variance, thickest = self._gap
        fallen: Floats = special.ndtr((middle - noise) / np.sqrt(variance + np.maximum(lost, 0.0)))
        passed = thickest + (1.0 - thickest) * fallen
        under = 1.0 - float(smoothstep(0.5, 0.9, self.eye_y / clouds.height))
        return 1.0 + under * clouds.shadows * (passed / max(1.0 - self.taken, LEAST_PASSED) - 1.0)

    @cached_property
    def _gap(self) -> Vec3:
        """Middle and variance of the edge, where the transmittance falls, and that of the thickest clouds."""
        thickest = math.exp(-self.clouds.thickness)
        at = np.linspace(-8.0, 8.0, 20001)
        rise = np.gradient(self._column(at)[0])
        mean = float(rise @ at / rise.sum())
        variance = float(rise @ (at - mean) ** 2 / rise.sum())
        share = (1.0 - self.taken - thickest) / (1.0 - thickest)
        clear = float(special.ndtri(min(max(share, 1e-6), 1.0 - 1e-6)))
        return clear * math.sqrt(1.0 + variance), variance, thickest

    @property
    def _start(self) -> Floats:
        """Noise above which there is cloud, in each slice; (3,)."""
        covered = min(max(self.clouds.cover, 1e-4), 1.0 - 1e-4)
        return -float(special.ndtri(covered)) - 0.25 * self.clouds.softness + TAPER * SLICES

    def _noise(self, look: Floats, distance: Floats, slant: Floats, width: Floats) -> tuple[Floats, ...]:
        """Noise of the slices (3, r) and toward the lamp (r,), narrowed by the lost variance (r,); how far the slices
        are parted, and the share of their first octave that is lost, in [0, 1] (r,)."""
        clouds = self.clouds
        seed = 64 * clouds.seed
        tall = clouds.depth / clouds.size
        level = look[:, [0, 2]]
        foot = np.insert(level * (distance / clouds.size)[:, None], 2, 0.0, axis=1) + self.place
        climb = np.insert(level * np.minimum(tall / slant, 0.9)[:, None], 2, tall, axis=1)
        middle = foot + SLICES[1] * climb
        ahead = middle + STEP * self.lit_by[[0, 2, 1]]
        coarse = [octaves(foot + share * climb, width, (0, 1), seed)[0] for share in SLICES]
        lost = octaves(foot, width, (0, 1), seed)[1]
        kept = (1.0 - lost) / (1.0 - GAIN * GAIN)
        fine, less = octaves(middle, width, (1, OCTAVES), seed)
        noise = np.stack(coarse) + fine
        before = octaves(ahead, width, (0, OCTAVES_AHEAD), seed)[0]
        before = before + octaves(middle, width, (OCTAVES_AHEAD, OCTAVES), seed)[0]
        lost = np.maximum(lost + less - 1.0, 0.0)
        over, deviation, _ = self.edge
        narrow = deviation / np.sqrt(deviation * deviation + lost)
        mean = self._start[:, None] + over
        parted = smoothstep(0.0, 1.7, np.sqrt(dot(climb, climb)))
        return mean + (noise - mean) * narrow, mean[1] + (before - mean[1]) * narrow, lost, parted, 1.0 - kept

    def _column(self, noise: Floats, ahead: Floats | None = None) -> tuple[Floats, Floats, Floats, Floats]:
        """Opacity of a column of cloud, and its radiance per lamp, haze's scattering and sky; (r,). ``noise``: of the
        slices (3, r), or of all of them (r,). ``ahead``: toward the lamp (r,); absent: the same."""
        soft, thick, start = self.clouds.softness, self.clouds.thickness, self._start[:, None]
        noise = np.broadcast_to(noise, (3, noise.shape[-1]))
        toward = noise[1] if ahead is None else ahead
        density = smoothstep(0.0, 1.0, (noise - start) / soft)
        shade = smoothstep(0.0, 1.0, (toward - start - 0.2 * TAPER) / soft)
        core = np.maximum(noise - np.maximum(start + 0.5 * soft, CORE), 0.0)
        deep = thick / 3.0 * density
        above = thick * (np.array([[0.5], [0.33], [0.17]]) * density + 0.15 * core**2)
        above[0] += deep[1] + deep[2]
        above[1] += deep[2]
        relief = np.clip(1.0 + RELIEF * (noise[1] - toward), 0.35, 1.25)
        direct, diffuse = relief * np.exp(-0.5 * thick * shade), relief / (1.0 + DARK * above)
        through = np.exp(-deep.sum(axis=0))
        # A deck has as much less of a low lamp as it faces it less.
        faced = math.sqrt(max(float(self.lit_by[1]), 0.0) + 0.03)
        lit = 0.3 * (0.55 * direct + 0.45 * faced * diffuse)
        least = np.array([[0.6], [0.8], [1.0]])
        sky = (least + (1.0 - least) * direct) * (0.35 + 0.65 * diffuse)
        before = np.exp(-np.stack((np.zeros_like(through), deep[0], deep[0] + deep[1])))
        seen = before * (1.0 - np.exp(-deep))
        opaque = 1.0 - through
        whole = np.maximum(opaque, 1e-6)
        return opaque, (seen * lit).sum(axis=0) / whole, 0.3 * through, (seen * sky).sum(axis=0) / whole


@dataclass(frozen=True, eq=False)
class HighClouds(_Layer):
    """Streaks of ice."""

    cirrus: Cirrus
    place: tuple[float, ...]
    """The camera's position in the noise of the streaks and of their patches, along and across, cells; (4,)."""

    def toward(self, d: Floats, spread: Spread, depth: Depth) -> tuple[Floats, Floats, Floats]:
        cirrus = self.cirrus
        light, cover, hidden = np.zeros_like(d), np.zeros(d.shape[0]), np.zeros(d.shape[0])
        above = float(smoothstep(0.5, 0.9, self.eye_y / cirrus.height))
        seen = smoothstep(0.01, 0.1, d[:, 1]) * (1.0 - above)
        at = np.flatnonzero(seen > 0.0)
        look = d[at]
        distance, slant = distance_to(look, cirrus.height - self.eye_y)
        width = WIDTH * np.maximum(spread[0][at] / slant, spread[1][at]) * distance / cirrus.size
        c, s = math.cos(cirrus.downwind), math.sin(cirrus.downwind)
        along, across = (distance / cirrus.size) * (look[:, [0, 2]] @ np.array([[c, -s], [s, c]])).T
        streak = np.column_stack((along / STRETCH, across)) + self.place[:2]
        patches = np.column_stack((0.125 * along, 0.25 * across)) + self.place[2:]
        broad = fractal(patches, 0.25 * width, 2, 64 * cirrus.seed)
        streak[:, 1] += 0.35 * broad
        fine = fractal(3.0 * streak, 3.0 * width, 5, 64 * cirrus.seed + 8)
        start = -special.ndtri(min(max(cirrus.cover, 1e-3), 1.0 - 1e-3)) - 1.2
        density = smoothstep(0.0, 2.4, broad - start) * smoothstep(-1.2, 2.4, fine + 0.5 * broad)
        hidden[at] = seen[at] * (1.0 - np.exp(-cirrus.thickness * density))
        cover[at] = hidden[at] * np.exp(-0.8 * np.minimum(depth(look[:, 1])[:, 0], 60.0))
        forward = henyey_greenstein(FORWARD, dot(look, self.lit_by))
        light[at] = ((0.2 + 0.3 * forward)[:, None] * self.light + self.sky) * cover[at, None]
        return light, cover, hidden


def distance_to(look: Floats, high: float) -> Pair:
    """Distance to a layer ``high`` m above the eye along (r, 3), m, and the sine of the slant there; (r,) each."""
    along = EARTH * look[:, 1]
    rest = 2.0 * EARTH * high + high * high
    distance = rest / (along + np.sqrt(along * along + rest))
    return distance, (along + distance) / (EARTH + high)


@lru_cache(maxsize=1)
def _lattice() -> Floats:
    """Normal numbers (5, n): points of the additive recurrence by powers of the root of x⁶ = x + 1 (Roberts 2018)."""
    shares = np.mod(0.5 + np.outer(ROOT ** -np.arange(1.0, 6.0), np.arange(1, LATTICE + 1)), 1.0)
    result: Floats = special.ndtri(np.clip(shares, 1e-9, 1.0 - 1e-9))
    return result


def place(clouds: Clouds, time: float, eye: Vec3) -> Vec3:
    """A camera position (m) in the clouds' noise at a time (s), cells."""
    velocity = clouds.wind_speed * math.cos(clouds.downwind), clouds.wind_speed * math.sin(clouds.downwind)
    return noise_place(clouds.size, clouds.change, velocity, time, (eye[0], eye[2]))


def streak_place(cirrus: Cirrus, time: float, eye: Vec3) -> tuple[float, ...]:
    """A camera position (m) in the noise of streaks and of their patches at a time (s), cells; (4,)."""
    c, s, cells, wind = (
        math.cos(cirrus.downwind),
        math.sin(cirrus.downwind),
        PERIOD / (2.0 * math.pi),
        cirrus.wind_speed,
    )
    turns = [2.0 * math.pi / (PERIOD * cirrus.size) * share for share in (1.0 / STRETCH, 1.0, 0.125, 0.25)]
    ways = zip(turns, ((c, s, wind), (-s, c, 0.0)) * 2, strict=True)
    return tuple(
        cells * reduced((turn * x, eye[0]), (turn * z, eye[2]), (-turn * drift, time)) for turn, (x, z, drift) in ways
    )
