"""Section 9: the layered sky, with time of day, haze, clouds, moon and stars.

Colours are linear RGB along the last axis, directions unit vectors (x, y, z) along the last axis.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from statistics import NormalDist

import numpy as np

from seafoam.reference.noise import fractal, pcg, share
from seafoam.reference.types import Floats, dot, smoothstep, unit
from seafoam.reference.waves.parametric import reduced
from seafoam.scene.light import Light
from seafoam.scene.sky import Clouds, Day, Moon

RAYLEIGH = np.array([0.055, 0.108, 0.215])
MIE_LEAST, MIE_PER_TURBIDITY = 0.01, 0.04
FORWARD = 0.76
SUN_POWER = 20.0
MOON_POWER = 0.2 * np.array([0.75, 0.9, 1.2])
MOON_RADIUS = 0.0045
MOON_FACE = 2.5
NIGHT = 0.002
FLAT = 0.04
EARTH = 6.371e6
CELLS = 256
OCTAVES = 6
EYE, MIRROR = 1e-3, 0.012
"""Blur of clouds seen directly and reflected by water, rad."""
SUN_SOLID_ANGLE = 6.8e-5
DISC_MOST = 3000.0
STAR_CELLS = 64
NODES, TURNS = 192, 384


def sun_angles(day: Day) -> tuple[float, float]:
    """Azimuth and elevation of the sun, rad: its position on the celestial sphere, rotated by hour and latitude."""
    declination = math.radians(23.44) * math.sin(2.0 * math.pi * (284.0 + day.date) / 365.0)
    hour = 2.0 * math.pi * (day.hour - 12.0) / 24.0
    # In equatorial axes: toward the meridian, west, and the pole.
    meridian, west, pole = (
        math.cos(declination) * math.cos(hour),
        math.cos(declination) * math.sin(hour),
        math.sin(declination),
    )
    south = meridian * math.sin(day.latitude) - pole * math.cos(day.latitude)
    up = meridian * math.cos(day.latitude) + pole * math.sin(day.latitude)
    return day.north + math.atan2(-west, -south), math.asin(max(-1.0, min(1.0, up)))


def toward(azimuth: float, elevation: float) -> Floats:
    """(3,) unit vector toward azimuth and elevation, rad."""
    level = math.cos(elevation)
    return np.array([level * math.cos(azimuth), math.sin(elevation), level * math.sin(azimuth)])


def _step(low: float, high: float, x: float) -> float:
    return float(smoothstep(low, high, x))


@dataclass(frozen=True, eq=False)
class Lamp:
    """Sun or moon, as a light source for the air."""

    direction: Floats
    """(3,) unit vector toward it."""
    path: Floats
    """(3,) optical depth of the air along its light's path to the sea."""
    power: Floats
    """(3,) irradiance above the air."""
    least: float


@dataclass(frozen=True, eq=False)
class Sky:
    """A layered sky at one time over one camera position."""

    light: Light
    mie: float
    haze: float
    lamps: tuple[Lamp, ...]
    lit_by: Floats
    """(3,) unit vector toward the lamp that lights water and clouds."""
    clear_direct: Floats
    """(3,) its irradiance at the sea under a clear sky."""
    cloud_light: Floats
    """(3,) its irradiance at the height of clouds."""
    place: tuple[float, float, float]
    """The camera's position in the clouds' noise, cells."""
    eye_y: float

    @property
    def clouds(self) -> Clouds | None:
        return None if self.light.sky is None else self.light.sky.clouds

    @property
    def taken(self) -> float:
        """Mean share of the light from above that clouds block."""
        clouds = self.clouds
        return 0.0 if clouds is None else clouds.cover * (1.0 - math.exp(-0.5 * clouds.thickness))

    @property
    def direct(self) -> Floats:
        """Irradiance of the lamp on water that faces it; (3,)."""
        return (1.0 - self.taken) * self.clear_direct

    def depth(self, y: Floats) -> Floats:
        """Optical depth along unit directions of height y (...,); (..., 3)."""
        up = np.maximum(y, 0.0)[..., None]
        result: Floats = (RAYLEIGH + self.mie) / (up + 0.09) + self.haze * 0.02 / (up + 0.02)
        return result

    def clear(self, d: Floats) -> Floats:
        """Radiance of the cloudless air toward d; (..., 3)."""
        up = np.maximum(d[..., 1], 0.0)[..., None]
        depth = self.depth(d[..., 1])
        grey = self.mie / (up + 0.09) + self.haze * 0.02 / (up + 0.02)
        total = np.zeros(d.shape)
        for lamp in self.lamps:
            gamma = dot(d, lamp.direction)[..., None]
            rayleigh = 3.0 / (16.0 * math.pi) * (1.0 + gamma * gamma)
            forward = (1.0 - FORWARD**2) / (4.0 * math.pi * (1.0 + FORWARD**2 - 2.0 * FORWARD * gamma) ** 1.5)
            once = (RAYLEIGH / (up + 0.09) * rayleigh + grey * forward) / depth
            passed = 0.08 + 0.7 * np.exp(-up / 0.12)
            here = lamp.power * np.exp(-lamp.path * passed) + lamp.least
            above = lamp.power * np.exp(-0.08 * lamp.path) + lamp.least
            total += here * once + FLAT * above
        result: Floats = total * (1.0 - np.exp(-depth))
        return result

    def layer(self, d: Floats, blur: float) -> tuple[Floats, Floats, Floats]:
        """The clouds toward d (r, 3): their radiance (r, 3), and the share of the sky that they cover and hide (r,)."""
        clouds = self.clouds
        count = d.shape[0]
        light, cover, hidden = np.zeros((count, 3)), np.zeros(count), np.zeros(count)
        if clouds is None:
            return light, cover, hidden
        seen = smoothstep(0.01, 0.08, d[:, 1]) * (1.0 - _step(0.5, 0.9, self.eye_y / clouds.height))
        at = np.flatnonzero(seen > 0.0)
        if at.size == 0:
            return light, cover, hidden
        look = d[at]
        high = clouds.height - self.eye_y
        along = EARTH * look[:, 1]
        rest = 2.0 * EARTH * high + high * high
        way = rest / (along + np.sqrt(along * along + rest))
        width = blur * way / clouds.size * (EARTH + high) / (along + way)
        place = np.column_stack((look[:, [0, 2]] * (way / clouds.size)[:, None], np.zeros(at.size))) + self.place
        density = self._density(clouds, fractal(place, width, OCTAVES, 64 * clouds.seed))
        level = 0.18 / max(math.hypot(self.lit_by[0], self.lit_by[2]), 1e-6)
        shift = np.array([level * self.lit_by[0], level * self.lit_by[2], 0.0])
        before = self._density(clouds, fractal(place + shift, width, OCTAVES - 2, 64 * clouds.seed))
        unresolved = smoothstep(0.15, 0.6, width)
        through = np.exp(-clouds.thickness * density)
        hides = seen[at] * ((1.0 - through) * (1.0 - unresolved) + self.taken * unresolved)
        gamma = dot(look, self.lit_by)
        edge = (1.0 - FORWARD**2) / (4.0 * math.pi * (1.0 + FORWARD**2 - 2.0 * FORWARD * gamma) ** 1.5)
        lit = 0.3 * (0.15 + 0.85 * np.exp(-0.5 * clouds.thickness * before)) + 0.3 * edge * through
        bright = self.cloud_light * lit[:, None] + self.cloud_sky * (1.0 - 0.4 * density)[:, None]
        covers = hides * np.exp(-0.8 * self.depth(look[:, 1])[:, 0])
        light[at], cover[at], hidden[at] = bright * covers[:, None], covers, hides
        return light, cover, hidden

    @staticmethod
    def _density(clouds: Clouds, noise: Floats) -> Floats:
        share_covered = min(max(clouds.cover, 1e-4), 1.0 - 1e-4)
        start = -NormalDist().inv_cdf(share_covered) - 0.25 * clouds.softness
        return smoothstep(start, start + clouds.softness, noise)

    def seen(self, d: Floats, blur: float) -> Floats:
        """Radiance of air and clouds toward d (r, 3); (r, 3)."""
        light, cover, _ = self.layer(d, blur)
        result: Floats = self.clear(d) * (1.0 - cover)[:, None] + light
        return result

    def whole(self, d: Floats, pixel: Floats) -> Floats:
        """Radiance toward d (r, 3) with sun, moon and stars, for samples ``pixel`` (r,) rad wide; (r, 3)."""
        light, cover, hidden = self.layer(d, EYE)
        face, inside = self.moon_disc(d)
        beyond = self.sun_disc(d) + face + self.stars(d, pixel) * (1.0 - inside)[:, None]
        result: Floats = self.clear(d) * (1.0 - cover)[:, None] + light + (1.0 - hidden)[:, None] * beyond
        return result

    def sun_disc(self, d: Floats) -> Floats:
        """Radiance of the sun's disc; (r, 3); 0 once the moon lights the water."""
        if len(self.lamps) > 1 and self.lit_by is self.lamps[1].direction:
            return np.zeros(d.shape)
        away = d - self.lamps[0].direction
        inside = 1.0 - smoothstep(0.0045**2, 0.0055**2, dot(away, away))
        result: Floats = np.minimum(self.clear_direct / SUN_SOLID_ANGLE, DISC_MOST) * inside[:, None]
        return result

    def moon_disc(self, d: Floats) -> tuple[Floats, Floats]:
        """Radiance of the moon's face (r, 3), and its coverage (r,)."""
        moon = None if self.light.sky is None else self.light.sky.moon
        colour, hides = np.zeros(d.shape), np.zeros(d.shape[0])
        if moon is None:
            return colour, hides
        to_moon, right, up = _axes(moon)
        radius = MOON_RADIUS * moon.size
        chord = (d - to_moon) / radius
        far = dot(chord, chord)
        at = np.flatnonzero(far < 1.2)
        if at.size == 0:
            return colour, hides
        a, b = dot(chord[at], right), dot(chord[at], up)
        ball = a[:, None] * right + b[:, None] * up - np.sqrt(np.maximum(1.0 - far[at], 0.0))[:, None] * to_moon
        lit = np.sqrt(np.maximum(dot(ball, self.lamps[0].direction), 0.0))
        noise = fractal(np.column_stack((1.7 * a + 3.1, 1.7 * b + 7.7)), np.zeros(at.size), 4, 77)
        dust = 1.0 - 0.55 * smoothstep(-0.2, 0.9, noise)
        hides[at] = 1.0 - smoothstep(0.8, 1.2, far[at])
        through = np.exp(-0.5 * self.lamps[1].path)
        colour[at] = MOON_FACE * moon.brightness * MOON_POWER * through * (dust * lit * hides[at])[:, None]
        return colour, hides

    def stars(self, d: Floats, pixel: Floats) -> Floats:
        """Radiance of the stars; (r, 3)."""
        amount = 0.0 if self.light.sky is None else self.light.sky.stars
        bright = amount * _step(0.05, 0.2, -float(self.lamps[0].direction[1]))
        result = np.zeros(d.shape)
        if bright == 0.0:
            return result
        size = np.abs(d)
        axis = np.where(
            (size[:, 0] >= size[:, 1]) & (size[:, 0] >= size[:, 2]), 0, np.where(size[:, 1] >= size[:, 2], 1, 2)
        )
        rows = np.arange(d.shape[0])
        main = d[rows, axis]
        face = 2 * axis + (main <= 0.0)
        turned = np.stack((d[rows, (axis + 1) % 3], d[rows, (axis + 2) % 3], np.abs(main)), axis=-1)
        at = (0.5 + 0.5 * turned[:, :2] / turned[:, 2:]) * STAR_CELLS
        cell = np.clip(np.floor(at), 0, STAR_CELLS - 1)
        word = np.full(rows.shape, 0x5EA57A25, np.uint64) ^ face.astype(np.uint64)
        word = pcg(pcg(pcg(word) ^ cell[:, 0].astype(np.uint64)) ^ cell[:, 1].astype(np.uint64))
        middle = (cell + 0.5) / STAR_CELLS * 2.0 - 1.0
        kept = np.flatnonzero(share(word) < 0.5 * (1.0 + dot(middle, middle)) ** -1.5)
        if kept.size == 0:
            return result
        other = [share(pcg((word[kept] + np.uint64(i)) & np.uint64(0xFFFFFFFF))) for i in range(1, 5)]
        star = (cell[kept] + 0.25 + 0.5 * np.stack(other[:2], axis=-1)) / STAR_CELLS * 2.0 - 1.0
        chord = turned[kept] - unit(np.column_stack((star, np.ones(kept.size))))
        radius = np.clip(1.5 * pixel[kept], 7e-4, 3e-3)
        inside = np.maximum(1.0 - dot(chord, chord) / radius**2, 0.0)
        flux = 3e-8 / (other[2] ** 2 + 0.004)
        tint = np.array([1.0, 0.82, 0.62]) + other[3][:, None] * np.array([-0.28, 0.03, 0.38])
        shown = bright * flux * 3.0 / (math.pi * radius**2) * inside**2
        through = np.exp(-(RAYLEIGH + self.mie) / (np.maximum(d[kept, 1], 0.0) + 0.03)[:, None])
        result[kept] = tint * shown[:, None] * through
        return result

    @property
    def cloud_sky(self) -> Floats:
        """Radiance of the ambient light of clouds; (3,)."""
        return 0.6 / math.pi * self.clear_irradiance

    @property
    def clear_irradiance(self) -> Floats:
        """Irradiance of a clear sky on level water; (3,)."""
        return _integrated(self)

    @property
    def irradiance(self) -> Floats:
        """Irradiance of sky and clouds on level water; (3,)."""
        clouds = self.clouds
        if clouds is None:
            return self.clear_irradiance
        lit = 0.3 * (0.15 + 0.85 * math.exp(-0.25 * clouds.thickness))
        overcast = math.pi * (lit * self.cloud_light + 0.8 * self.cloud_sky)
        result: Floats = self.clear_irradiance + self.taken * (overcast - self.clear_irradiance)
        return result


@lru_cache(maxsize=8)
def _integrated(of: Sky) -> Floats:
    """∫ clear cos over the upper hemisphere: Gauss–Legendre in the root of the height, equal steps in azimuth."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    root, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    y = root * root
    around = np.arange(TURNS) * (2.0 * math.pi / TURNS)
    level = np.sqrt(1.0 - y * y)
    d = np.stack(
        (level[:, None] * np.cos(around), np.repeat(y[:, None], TURNS, axis=1), level[:, None] * np.sin(around)), -1
    )
    rings = of.clear(d).sum(axis=1) * (2.0 * math.pi / TURNS)
    result: Floats = ((2.0 * root * y * weights)[:, None] * rings).sum(axis=0)
    return result


def _axes(moon: Moon) -> tuple[Floats, Floats, Floats]:
    """Direction toward the moon, and its right and up; (3,) unit vectors."""
    to_moon = toward(moon.azimuth, moon.elevation)
    return to_moon, toward(moon.azimuth + 0.5 * math.pi, 0.0), toward(moon.azimuth, moon.elevation + 0.5 * math.pi)


def layered_sky(light: Light, time: float, eye: tuple[float, float, float]) -> Sky | None:
    """The layered sky of a light at a time (s) over a camera position (m); None if the scene has the plain sky."""
    sky = light.sky
    if sky is None:
        return None
    azimuth, elevation = (light.sun_azimuth, light.sun_elevation) if light.day is None else sun_angles(light.day)
    mie = MIE_LEAST + MIE_PER_TURBIDITY * (light.turbidity - 1.0)

    def path(height: float) -> Floats:
        result: Floats = (RAYLEIGH + mie) / (max(height, 0.0) + 0.03)
        return result

    to_sun = toward(azimuth, elevation)
    low = float(to_sun[1])
    lamps = [Lamp(to_sun, path(low), np.full(3, SUN_POWER * math.exp(12.0 * min(low, 0.0))), NIGHT)]
    by_moon = False
    if sky.moon is not None:
        to_moon = _axes(sky.moon)[0]
        lit = 0.5 - 0.5 * float(dot(to_sun, to_moon))
        shows = lit**2 * _step(0.06, 0.12, -low) * _step(-0.02, 0.02, float(to_moon[1]))
        lamps.append(Lamp(to_moon, path(float(to_moon[1])), MOON_POWER * sky.moon.brightness * shows, 0.0))
        by_moon = low < -0.06
    if by_moon:
        lit_by = lamps[1].direction
        direct = lamps[1].power * np.exp(-lamps[1].path)
        up_there = lamps[1].power * np.exp(-0.5 * lamps[1].path)
    else:
        lit_by = to_sun
        direct = SUN_POWER * np.exp(-lamps[0].path) * _step(-0.02, 0.02, low)
        up_there = SUN_POWER * np.exp(-0.5 * lamps[0].path) * _step(-0.06, 0.02, low)
    place = (0.0, 0.0, 0.0)
    if sky.clouds is not None:
        of = sky.clouds
        turn = 2.0 * math.pi / (CELLS * of.size)
        drift = (of.wind * math.cos(of.wind_direction), of.wind * math.sin(of.wind_direction))
        cells = CELLS / (2.0 * math.pi)
        place = (
            cells * reduced((turn, eye[0]), (-turn * drift[0], time)),
            cells * reduced((turn, eye[2]), (-turn * drift[1], time)),
            cells * reduced((2.0 * math.pi / (CELLS * of.change), time)),
        )
    return Sky(light, mie, sky.haze, tuple(lamps), lit_by, direct, up_there, place, eye[1])
