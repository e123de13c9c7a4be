"""Irradiances and optical depths of sun, moon and sky. docs/formulae.md, sections 6 and 9."""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats, read_only, smooth
from seafoam.ocean.sky import skylight
from seafoam.scene import Direction, Light, direction
from seafoam.sums import summed

RAYLEIGH = np.array([0.055, 0.108, 0.215])
"""Optical depth of molecules at the zenith: red, green, blue."""
SUN_POWER = 20.0
"""Irradiance of the sun above the atmosphere."""
MOON_POWER = 0.2
"""Irradiance of a full moon above the atmosphere: 1 % of the sun's, for a dark-adapted observer."""
MOON_TINT = np.array([0.75, 0.9, 1.2])
"""Colour of moonlight, which looks blue to a dark-adapted observer."""
MOON_RADIUS = 0.0045
"""Angular radius of the moon, rad."""
MOON_FACE = 2.5
"""Radiance of a full moon's disc over its irradiance, 1/sr: far below the physical 15 000, so that details show."""
NIGHT = 0.002
"""Irradiance of the air's light at night."""
ASYMMETRY = 0.76
"""Asymmetry parameter g of the haze's Henyey-Greenstein phase function."""
NODES = 96
"""Steps of the sky's integral in elevation and azimuth."""


def mie_depth(light: Light) -> float:
    """Optical depth of haze at the zenith."""
    return 0.01 + 0.04 * (light.turbidity - 1.0)


def air_mass(height: float) -> float:
    """Air mass on the way down from a lamp at this sine of elevation; the zenith has about 1."""
    return 1.0 / (max(height, 0.0) + 0.03)


def path(light: Light, height: float) -> Floats:
    """(3,) optical depth of the air between sea level and a lamp at this sine of elevation."""
    if light.sky is not None:
        return skylight.atmosphere(mie_depth(light), light.sky.haze).depth(height)
    return (RAYLEIGH + mie_depth(light)) * air_mass(height)


def sun(light: Light) -> Direction:
    return direction(*light.sun)


def moon(light: Light) -> Direction | None:
    if light.sky is None or light.sky.moon is None:
        return None
    return direction(light.sky.moon.azimuth, light.sky.moon.elevation)


def moon_phase(light: Light) -> float:
    """Light relative to a full moon: the square of the illuminated fraction of the disc."""
    toward = moon(light)
    if toward is None:
        return 0.0
    lit = 0.5 * (1.0 - summed(a * b for a, b in zip(sun(light), toward, strict=True)))
    return lit * lit


def moon_power(light: Light) -> Floats:
    """(3,) irradiance of moonlight above the atmosphere; 0 until the sine of the sun's elevation is -0.06."""
    toward = moon(light)
    if toward is None or light.sky is None or light.sky.moon is None:
        return np.zeros(3)
    dark = smooth(0.06, 0.12, -sun(light)[1])
    power = MOON_POWER * light.sky.moon.brightness * moon_phase(light) * dark * smooth(-0.02, 0.02, toward[1])
    return power * MOON_TINT


def moon_is_lamp(light: Light) -> bool:
    """Whether the moon lights water, foam and clouds: if the sun is so low that it lights nothing."""
    return moon(light) is not None and sun(light)[1] < -0.06


def lamp_angles(light: Light) -> tuple[float, float]:
    """Return azimuth and elevation of the lamp, rad: the sun, or the moon if the sun is well below the horizon."""
    if light.sky is not None and light.sky.moon is not None and moon_is_lamp(light):
        return light.sky.moon.azimuth, light.sky.moon.elevation
    return light.sun


def lamp(light: Light) -> Direction:
    return direction(*lamp_angles(light))


def direct(light: Light) -> Floats:
    """(3,) irradiance of the lamp, sun or moon, on a surface that faces it, under a clear sky."""
    height = lamp(light)[1]
    if moon_is_lamp(light):
        above = moon_power(light)
    elif light.sky is not None:
        above = np.array(skylight.SUN_POWER) * skylight.disc_shown(height)
    else:
        above = np.array(SUN_POWER * smooth(-0.02, 0.02, height))
    return above * np.exp(-path(light, height))


def glows(light: Light) -> dict[str, tuple[Direction, skylight.Glow]]:
    """Return direction and glow in a clear layered sky of each lamp that lights it: ``sun``, and ``moon``."""
    assert light.sky is not None
    haze = mie_depth(light), light.sky.haze
    toward = sun(light)
    # As an eye adapted to dusk sees it.
    power = skylight.adapted(toward[1]) * np.array(skylight.SUN_POWER)
    result = {"sun": (toward, skylight.glow(*haze, toward[1], tuple(power.tolist()), skylight.NIGHT))}
    other, power = moon(light), moon_power(light)
    if other is not None and min(power) > 0.0:
        result["moon"] = (other, skylight.glow(*haze, other[1], tuple(power.tolist())))
    return result


@lru_cache(maxsize=64)
def clear_irradiance(light: Light) -> Floats:
    """(3,) irradiance of the clear sky on level water, by the midpoint rule (96 × 96)."""
    # Equal steps in the root of the height: the sky changes fastest at the horizon.
    root = (np.arange(NODES) + 0.5) / NODES
    height = np.repeat((root * root)[:, None], NODES, axis=1)
    turn = np.cos((np.arange(NODES) + 0.5) * (math.pi / NODES))
    along = np.sqrt(1.0 - height * height) * turn
    total = np.zeros(3)
    for toward, glow in glows(light).values():
        gamma = along * math.hypot(toward[0], toward[2]) + height * toward[1]
        rings = skylight.radiance(glow, height, along, gamma, ASYMMETRY).mean(axis=1)
        total += root**3 @ rings * (4.0 * math.pi / NODES)
    return read_only(total)
