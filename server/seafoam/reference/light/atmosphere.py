"""Section 9: the layered sky, with time of day, haze, clouds, moon and stars.

Colours are linear RGB along the last axis, directions unit vectors (x, y, z) along the last axis.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seafoam.ocean.sky import skylight
from seafoam.reference.light import clouds
from seafoam.reference.light.clouds import EYE, FORWARD, CloudLayer, HighClouds, Spread
from seafoam.reference.noise import chained, fractal, number, share
from seafoam.reference.types import Floats, Pair, Vec2, Vec3, dot, henyey_greenstein, smoothstep, unit
from seafoam.scene import Day, Light, Moon, Sky

RAYLEIGH = np.array([0.055, 0.108, 0.215])
RAYLEIGH_HEIGHT, MIE_HEIGHT = 8000.0, 1200.0  # scale heights of molecules and of haze, m
MIE_LEAST, MIE_PER_TURBIDITY = 0.01, 0.04
CLOUD_POWER = 20.0
MOON_POWER = 0.2 * np.array([0.75, 0.9, 1.2])
MOON_RADIUS = 0.0045
MOON_FACE = 2.5
MOLECULES: Floats = np.array([6.54e-6, 1.405e-5, 3.16e-5])  # scattering by molecules at the sea, 1/m
HAZE_COLOUR: Floats = np.array([0.826, 1.0, 1.225])
CONTRAST = 3.912
DISC_MOST = 3000.0
STAR_CELLS = 64
NODES, TURNS = 192, 384
TAP_AIR, TAP_CLOUDS = 0.8, 1.15
"""Distance of a mirrored sky's two directions from their mean, and its clouds' deviation, over the spread."""


def mie_depth(light: Light) -> float:
    """Optical depth of the haze of a light's turbidity, at the zenith."""
    return MIE_LEAST + MIE_PER_TURBIDITY * (light.turbidity - 1.0)


def to_sun(light: Light) -> Floats:
    """(3,) unit vector toward the sun."""
    return toward(*((light.sun_azimuth, light.sun_elevation) if light.day is None else sun_angles(light.day)))


def sun_angles(day: Day) -> Vec2:
    """Azimuth and elevation of the sun, rad: its position on the celestial sphere, rotated by hour and latitude."""
    declination = math.radians(23.44) * math.sin(2.0 * math.pi * (284.0 + day.date) / 365.0)
    hour, level = 2.0 * math.pi * (day.hour - 12.0) / 24.0, math.cos(declination)
    # In equatorial axes: toward the meridian, west, and the pole.
    meridian, west, pole = level * math.cos(hour), level * math.sin(hour), math.sin(declination)
    south = meridian * math.sin(day.latitude) - pole * math.cos(day.latitude)
    up = meridian * math.cos(day.latitude) + pole * math.sin(day.latitude)
    return day.north + math.atan2(-west, -south), math.asin(max(-1.0, min(1.0, up)))


def toward(azimuth: float, elevation: float) -> Floats:
    """(3,) unit vector toward azimuth and elevation, rad."""
    level = math.cos(elevation)
    return np.array([level * math.cos(azimuth), math.sin(elevation), level * math.sin(azimuth)])


def _summed(
    series: skylight.Series, exponents: tuple[skylight.Exponents, skylight.Exponents], x: Floats, s: Floats
) -> Floats:
    """2 to the sum of c x^i s^j at (...,): of green, and of red and blue with what they add; (..., 3)."""
    powers = [np.ones_like(x), x, x * x, x**3, x**4, x**5], [np.ones_like(s), s, s * s, s**3]
    middle, others = (
        np.stack([powers[0][i] * powers[1][j] for i, j in terms], axis=-1) @ coefficients
        for terms, coefficients in zip(exponents, (series.green, series.tint), strict=True)
    )
    return np.exp2(np.stack((middle + others[..., 0], middle, middle + others[..., 1]), axis=-1))


@dataclass(frozen=True, eq=False)
class Lamp:
    """Sun or moon, as a light source for the air."""

    direction: Floats  # (3,) unit vector toward it
    path: Floats  # (3,) optical depth of the air along its light's path to the sea
    power: Floats  # (3,) irradiance above the air
    glow: skylight.Glow  # coefficients of the sky that it lights


class LayeredSky:
    """A light's layered sky at a time (s) over a camera position (m)."""

    def __init__(self, light: Light, sky: Sky, time: float, eye: Vec3) -> None:
        self.light, self.sky, self.time, self.eye, self.mie = light, sky, time, eye, mie_depth(light)
        sun = to_sun(light)
        low, power = float(sun[1]), np.array(skylight.SUN_POWER)
        self.lamps = [self._lamp(sun, power * skylight.adapted(low), skylight.NIGHT)]
        # The lamp that lights water and clouds, its irradiance at the sea under a clear sky, and above the air.
        self.lit_by = sun
        self.clear_direct: Floats = power * np.exp(-self.lamps[0].path) * skylight.disc_shown(low)
        self._above = np.full(3, CLOUD_POWER * smoothstep(-0.06, 0.02, low))
        if sky.moon is None:
            return
        to_moon = _axes(sky.moon)[0]
        lit = 0.5 - 0.5 * float(dot(sun, to_moon))
        shows = lit**2 * smoothstep(0.06, 0.12, -low) * smoothstep(-0.02, 0.02, float(to_moon[1]))
        self.lamps.append(self._lamp(to_moon, MOON_POWER * sky.moon.brightness * shows, skylight.DARK))
        if low < -0.06:
            self.lit_by, self._above = to_moon, self.lamps[1].power
            self.clear_direct = self._above * np.exp(-self.lamps[1].path)

    def _lamp(self, direction: Floats, power: Floats, least: skylight.Rgb) -> Lamp:
        height = float(direction[1])
        path = skylight.atmosphere(self.mie, self.sky.haze).depth(height)
        glow = skylight.glow(self.mie, self.sky.haze, height, tuple(power.tolist()), least)
        return Lamp(direction, path, power, glow)

    def _lit(self, altitude: float) -> tuple[Floats, Floats, Floats, float]:
        """The lamp, its light at an altitude (m), through the molecules and the haze above it, which thin with
        different heights, and the radiance of the skylight there, (3,) each; and the camera's height."""
        depth = RAYLEIGH * math.exp(-altitude / RAYLEIGH_HEIGHT) + self.mie * math.exp(-altitude / MIE_HEIGHT)
        light = self._above * np.exp(-depth / (max(float(self.lit_by[1]), 0.0) + 0.03))
        return self.lit_by, light, 0.6 / math.pi * self.clear_irradiance, self.eye[1]

    @cached_property
    def clouds(self) -> CloudLayer | None:
        """The layer of clouds, if there is one."""
        layer = self.sky.clouds
        if layer is None:
            return None
        return CloudLayer(*self._lit(layer.height), layer, clouds.place(layer, self.time, self.eye))

    @cached_property
    def high(self) -> HighClouds | None:
        """The high clouds, if there are any."""
        cirrus = self.sky.cirrus
        if cirrus is None:
            return None
        return HighClouds(*self._lit(cirrus.height), cirrus, clouds.streak_place(cirrus, self.time, self.eye))

    @property
    def taken(self) -> float:
        """Mean share of the light from above that clouds block."""
        return 0.0 if self.clouds is None else self.clouds.taken

    @property
    def direct(self) -> Floats:
        """Irradiance of the lamp on water that faces it; (3,)."""
        return (1.0 - self.taken) * self.clear_direct

    def depth(self, y: Floats) -> Floats:
        """Optical depth along unit directions of height y (...,); (..., 3)."""
        up = np.maximum(y, 0.0)[..., None]
        return (RAYLEIGH + self.mie) / (up + 0.09) + self.sky.haze * 0.02 / (up + 0.02)

    def clear(self, d: Floats, look: Floats | None = None) -> Floats:
        """Radiance of the cloudless air toward d; (..., 3). ``look``: toward which its haze scatters, if not d."""
        x = 0.1 / (np.maximum(d[..., 1], 0.0) + 0.1)
        total = np.zeros(d.shape)
        for lamp in self.lamps:
            level = math.hypot(lamp.direction[0], lamp.direction[2])
            s = (d[..., 0] * lamp.direction[0] + d[..., 2] * lamp.direction[2]) / max(level, 1e-12)
            forward = henyey_greenstein(FORWARD, dot(d if look is None else look, lamp.direction)[..., None])
            total += _summed(lamp.glow.even, (skylight.EVEN, skylight.EVEN_TINT), x, s)
            total += _summed(lamp.glow.haze, (skylight.HAZE, skylight.HAZE_TINT), x, s) * forward
        return total

    def passed(self, distance: Floats) -> Floats:
        """Share of light that passes through (r,) m of air near the sea; (r, 3)."""
        haze = max(CONTRAST / self.light.visibility - float(MOLECULES[1]), 0.0)
        return np.exp(-distance[:, None] * (haze * HAZE_COLOUR + MOLECULES))

    def behind_clouds(self, air: Floats, d: Floats, spread: Spread) -> Pair:
        """The light ``air`` (r, 3) of the sky toward d (r, 3) with clouds in front, and what share they hide (r,)."""
        hidden = np.zeros(d.shape[0])
        if self.high is not None:
            light, cover, hidden = self.high.toward(d, spread, self.depth)
            air = air * (1.0 - cover)[:, None] + light
        if self.clouds is None:
            return air, hidden
        light, cover, hides = self.clouds.toward(d, spread, self.depth)
        behind: Floats = air * (1.0 - cover)[:, None] + light
        return self.clouds.in_rain(behind, 1.0 - (1.0 - hidden) * (1.0 - hides), d, spread)

    def seen(self, d: Floats) -> Floats:
        """Radiance of air and clouds toward d (r, 3); (r, 3)."""
        return self.behind_clouds(self.clear(d), d, _eye(d))[0]

    def before(self, d: Floats) -> Floats:
        """Radiance of deep haze before the horizon, seen along d (r, 3); (r, 3)."""
        level = unit(d * np.array([1.0, 0.0, 1.0]))
        return self.behind_clouds(self.clear(level, d), level, _eye(level))[0]

    def mirrored(self, d: Floats, spread: Pair) -> Floats:
        """Radiance toward directions about d (r, 3), with standard deviations (r,) up and down, and aside, rad; (r, 3).

        Two directions stand for all in the air, whose light varies most along the horizon; clouds are filtered.
        """
        level = np.hypot(d[:, 0], d[:, 2])
        heading = d[:, [0, 2]] / np.maximum(level, 1e-6)[:, None]
        up = np.column_stack((-d[:, 1] * heading[:, 0], level, -d[:, 1] * heading[:, 1]))
        up *= TAP_AIR * np.minimum(spread[0], d[:, 1])[:, None]
        air = 0.5 * (self.clear(unit(d + up)) + self.clear(unit(d - up)))
        return self.behind_clouds(air, d, (TAP_CLOUDS * spread[0], spread[1]))[0]

    def whole(self, d: Floats, pixel: Floats) -> Floats:
        """Radiance toward d (r, 3) with sun, moon and stars, for samples ``pixel`` (r,) rad wide; (r, 3)."""
        light, hidden = self.behind_clouds(self.clear(d), d, _eye(d))
        face, inside = self.moon_disc(d)
        beyond = self.sun_disc(d) + face + self.stars(d, pixel) * (1.0 - inside)[:, None]
        return light + (1.0 - hidden)[:, None] * beyond

    def sun_disc(self, d: Floats) -> Floats:
        """Radiance of the sun's disc; (r, 3); 0 once the moon lights the water."""
        if len(self.lamps) > 1 and self.lit_by is self.lamps[1].direction:
            return np.zeros(d.shape)
        away = d - self.lamps[0].direction
        inside = 1.0 - smoothstep(0.0045**2, 0.0055**2, dot(away, away))
        passed = self.clear_direct / CLOUD_POWER
        return DISC_MOST * math.sqrt(float(passed.max())) * passed * inside[:, None]

    def moon_disc(self, d: Floats) -> Pair:
        """Radiance of the moon's face (r, 3), and its coverage (r,)."""
        moon = self.sky.moon
        colour, hides = np.zeros(d.shape), np.zeros(d.shape[0])
        if moon is None:
            return colour, hides
        to_moon, right, up = _axes(moon)
        radius = MOON_RADIUS * moon.size
        chord = (d - to_moon) / radius
        far = dot(chord, chord)
        near = np.flatnonzero(far < 1.2)
        a, b = dot(chord[near], right), dot(chord[near], up)
        sphere = a[:, None] * right + b[:, None] * up - np.sqrt(np.maximum(1.0 - far[near], 0.0))[:, None] * to_moon
        lit = np.sqrt(np.maximum(dot(sphere, self.lamps[0].direction), 0.0))
        noise = fractal(np.column_stack((1.7 * a + 3.1, 1.7 * b + 7.7)), np.zeros(near.size), 4, 77)
        dust = 1.0 - 0.55 * smoothstep(-0.2, 0.9, noise)
        hides[near] = 1.0 - smoothstep(0.8, 1.2, far[near])
        through = np.exp(-0.5 * self.lamps[1].path)
        colour[near] = MOON_FACE * moon.brightness * MOON_POWER * through * (dust * lit * hides[near])[:, None]
        return colour, hides

    def stars(self, d: Floats, pixel: Floats) -> Floats:
        """Radiance of the stars; (r, 3)."""
        bright = self.sky.stars * smoothstep(0.05, 0.2, -float(self.lamps[0].direction[1]))
        result = np.zeros(d.shape)
        if bright == 0.0:
            return result
        axis, rows = np.argmax(np.abs(d), axis=1), np.arange(d.shape[0])
        main = d[rows, axis]
        face = 2 * axis + (main <= 0.0)
        turned = np.stack((d[rows, (axis + 1) % 3], d[rows, (axis + 2) % 3], np.abs(main)), axis=-1)
        place = (0.5 + 0.5 * turned[:, :2] / turned[:, 2:]) * STAR_CELLS
        cell = np.clip(np.floor(place), 0, STAR_CELLS - 1)
        word = chained(0x5EA57A25, face, *cell.T)
        middle = (cell + 0.5) / STAR_CELLS * 2.0 - 1.0
        kept = np.flatnonzero(share(word) < 0.5 * (1.0 + dot(middle, middle)) ** -1.5)
        other = [number(word[kept], i) for i in range(1, 5)]
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

    @cached_property
    def clear_irradiance(self) -> Floats:
        """Irradiance of a clear sky on level water; (3,)."""
        return over_hemisphere(self.clear)

    @property
    def irradiance(self) -> Floats:
        """Irradiance of sky and clouds on level water; (3,)."""
        clouds = self.clouds
        if clouds is None:
            return self.clear_irradiance
        return self.clear_irradiance + clouds.taken * (math.pi * clouds.radiance - self.clear_irradiance)


def over_hemisphere(radiance: Callable[[Floats], Floats]) -> Floats:
    """∫ radiance cos over the upper hemisphere: Gauss–Legendre in height, equal steps in azimuth, where it is periodic.

    ``radiance``: (..., 3) toward unit vectors (..., 3). Nodes are squares of heights, because the sky varies fastest at
    the horizon.
    """
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    root, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    y = root * root
    around = np.arange(TURNS) * (2.0 * math.pi / TURNS)
    level = np.sqrt(1.0 - y * y)
    d = np.stack(
        (level[:, None] * np.cos(around), np.repeat(y[:, None], TURNS, axis=1), level[:, None] * np.sin(around)), -1
    )
    rings = radiance(d).sum(axis=1) * (2.0 * math.pi / TURNS)
    result: Floats = ((2.0 * root * y * weights)[:, None] * rings).sum(axis=0)
    return result


def _eye(d: Floats) -> Pair:
    return np.full(d.shape[0], EYE[0]), np.full(d.shape[0], EYE[1])


def _axes(moon: Moon) -> tuple[Floats, Floats, Floats]:
    """Direction toward the moon, and its right and up; (3,) unit vectors."""
    to_moon = toward(moon.azimuth, moon.elevation)
    return to_moon, toward(moon.azimuth + 0.5 * math.pi, 0.0), toward(moon.azimuth, moon.elevation + 0.5 * math.pi)
