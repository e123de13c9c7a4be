"""Irradiances and optical depths of sun, moon, clouds and sky. docs/formulae.md, sections 6 and 9."""

import math
from functools import lru_cache
from statistics import NormalDist

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.scene.light import Light
from seafoam.scene.sky import Clouds, Direction, direction

Rgb = tuple[float, float, float]

RAYLEIGH: Rgb = (0.055, 0.108, 0.215)
"""Optical depth of molecules at the zenith: red, green, blue."""
SUN_POWER = 20.0
"""Irradiance of the sun above the atmosphere."""
MOON_POWER = 0.2
"""Irradiance of a full moon above the atmosphere: 1 % of the sun's, for a dark-adapted observer."""
MOON_TINT: Rgb = (0.75, 0.9, 1.2)
"""Colour of moonlight, which looks blue to a dark-adapted observer."""
MOON_RADIUS = 0.0045
"""Angular radius of the moon, rad."""
MOON_FACE = 2.5
"""Radiance of a full moon's disc over its irradiance, 1/sr: far below the physical 15 000, so that details show."""
NIGHT = 0.002
"""Irradiance of the air's light at night."""
ASYMMETRY = 0.76
"""Asymmetry parameter g of the haze's Henyey-Greenstein phase function."""
_NODES = 96
"""Steps of the sky's integral in elevation and azimuth."""


def smooth(low: float, high: float, x: float) -> float:
    """The smoothstep."""
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def mie_depth(light: Light) -> float:
    """Optical depth of haze at the zenith."""
    return 0.01 + 0.04 * (light.turbidity - 1.0)


def air_mass(height: float) -> float:
    """Air mass on the way down from a lamp at this sine of elevation; the zenith has about 1."""
    return 1.0 / (max(height, 0.0) + 0.03)


def path(light: Light, height: float) -> Rgb:
    """Optical depth of the air between sea level and a lamp at this sine of elevation."""
    mass = air_mass(height)
    red, green, blue = ((tau + mie_depth(light)) * mass for tau in RAYLEIGH)
    return red, green, blue


def sun(light: Light) -> Direction:
    """Unit vector toward the sun."""
    return direction(*light.sun)


def sun_power(light: Light) -> float:
    """Irradiance of the sunlight that the air scatters; fades after sunset."""
    return SUN_POWER * math.exp(12.0 * min(sun(light)[1], 0.0))


def moon(light: Light) -> Direction | None:
    """Unit vector toward the moon, if there is one."""
    if light.sky is None or light.sky.moon is None:
        return None
    return direction(light.sky.moon.azimuth, light.sky.moon.elevation)


def moon_phase(light: Light) -> float:
    """Light relative to a full moon: the square of the illuminated fraction of the disc."""
    toward = moon(light)
    if toward is None:
        return 0.0
    lit = 0.5 * (1.0 - sum(a * b for a, b in zip(sun(light), toward, strict=True)))
    return lit * lit


def moon_power(light: Light) -> Rgb:
    """Irradiance of moonlight above the atmosphere; 0 until the sine of the sun's elevation is -0.06."""
    toward = moon(light)
    if toward is None or light.sky is None or light.sky.moon is None:
        return 0.0, 0.0, 0.0
    dark = smooth(0.06, 0.12, -sun(light)[1])
    power = MOON_POWER * light.sky.moon.brightness * moon_phase(light) * dark * smooth(-0.02, 0.02, toward[1])
    red, green, blue = (power * tint for tint in MOON_TINT)
    return red, green, blue


def moon_is_lamp(light: Light) -> bool:
    """Whether the moon lights water, foam and clouds: if the sun is so low that it lights nothing."""
    return moon(light) is not None and sun(light)[1] < -0.06


def direct(light: Light) -> Rgb:
    """Irradiance of the lamp, sun or moon, on a surface that faces it, under a clear sky."""
    if moon_is_lamp(light):
        toward = moon(light)
        assert toward is not None
        red, green, blue = (
            power * math.exp(-tau) for power, tau in zip(moon_power(light), path(light, toward[1]), strict=True)
        )
    else:
        height = sun(light)[1]
        up = smooth(-0.02, 0.02, height)
        red, green, blue = (SUN_POWER * math.exp(-tau) * up for tau in path(light, height))
    return red, green, blue


def cloud_mean(clouds: Clouds | None) -> float:
    """Mean fraction of the light from above that clouds absorb."""
    return 0.0 if clouds is None else clouds.cover * (1.0 - math.exp(-0.5 * clouds.thickness))


def cloud_start(clouds: Clouds) -> float:
    """Noise value above which there is cloud: the normal quantile of the cover, at mid-edge."""
    cover = min(max(clouds.cover, 1e-4), 1.0 - 1e-4)
    return -NormalDist().inv_cdf(cover) - 0.25 * clouds.softness


def cloud_light(light: Light) -> Rgb:
    """Irradiance of the lamp at the height of the clouds: through half the air, and until later after sunset."""
    if moon_is_lamp(light):
        toward = moon(light)
        assert toward is not None
        red, green, blue = (
            power * math.exp(-0.5 * tau) for power, tau in zip(moon_power(light), path(light, toward[1]), strict=True)
        )
    else:
        height = sun(light)[1]
        up = smooth(-0.06, 0.02, height)
        red, green, blue = (SUN_POWER * math.exp(-0.5 * tau) * up for tau in path(light, height))
    return red, green, blue


def _glow(light: Light, toward: Direction, power: Rgb | float, least: float, d: Floats) -> Floats:
    """Radiance (..., 3) that a clear sky scatters from one lamp, in directions ``d`` (..., 3)."""
    sky = light.sky
    assert sky is not None
    height = np.maximum(d[..., 1], 0.0)[..., None]
    gamma = (d @ np.array(toward))[..., None]
    rayleigh, mie, haze = np.array(RAYLEIGH), mie_depth(light), sky.haze * 0.02 / (height + 0.02)
    mass = 1.0 / (height + 0.09)
    depth = (rayleigh + mie) * mass + haze
    forward = (1.0 - ASYMMETRY**2) / (4.0 * math.pi * (1.0 + ASYMMETRY**2 - 2.0 * ASYMMETRY * gamma) ** 1.5)
    once = (rayleigh * mass * 3.0 / (16.0 * math.pi) * (1.0 + gamma**2) + (mie * mass + haze) * forward) / depth
    passed = np.array(path(light, toward[1]))
    full = np.asarray(power)
    here = full * np.exp(-passed * (0.08 + 0.7 * np.exp(-height / 0.12))) + least
    result: Floats = (here * once + (full * np.exp(-0.08 * passed) + least) * 0.04) * (1.0 - np.exp(-depth))
    return result


@lru_cache(maxsize=64)
def clear_irradiance(light: Light) -> Rgb:
    """Irradiance of the clear sky on level water, by the midpoint rule in sin² of the elevation (96 × 96)."""
    height = np.sqrt((np.arange(_NODES) + 0.5) / _NODES)
    level = np.sqrt(1.0 - height * height)
    turn = (np.arange(_NODES) + 0.5) * (2.0 * math.pi / _NODES)
    d = np.stack(
        (level[:, None] * np.cos(turn), np.repeat(height[:, None], _NODES, axis=1), level[:, None] * np.sin(turn)), -1
    )
    total = _glow(light, sun(light), sun_power(light), NIGHT, d)
    toward = moon(light)
    if toward is not None:
        total = total + _glow(light, toward, moon_power(light), 0.0, d)
    red, green, blue = (float(value) for value in math.pi * total.mean(axis=(0, 1)))
    return red, green, blue


def cloud_sky(light: Light) -> Rgb:
    """Radiance of the skylight on clouds, mean over all directions."""
    red, green, blue = (0.6 / math.pi * value for value in clear_irradiance(light))
    return red, green, blue


def irradiance(light: Light) -> Rgb:
    """Irradiance of sky and clouds on level water."""
    clear = clear_irradiance(light)
    clouds = light.sky.clouds if light.sky is not None else None
    if clouds is None:
        return clear
    cover = cloud_mean(clouds)
    lit = 0.3 * (0.15 + 0.85 * math.exp(-0.25 * clouds.thickness))
    red, green, blue = (
        (1.0 - cover) * blue_sky + cover * math.pi * (lit * sunny + 0.8 * grey)
        for blue_sky, sunny, grey in zip(clear, cloud_light(light), cloud_sky(light), strict=True)
    )
    return red, green, blue
