"""The clear sky under one lamp in closed form, fitted to the integral of :mod:`seafoam.ocean.sky.air`.

docs/formulae.md, section 9. With x = 0.1/(y + 0.1), y the height of a unit direction (at least 0), and s its component
toward the lamp's azimuth, the radiance of green is exp2 P(x, s) + exp2 Q(x, s)·F(γ): P and Q are polynomials, F the
phase function of haze. P holds the light of molecules and everything scattered more than once, Q the rest. For red and
blue, polynomials of lower order are added to both.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.sky.air import EARTH, EYE, Atmosphere
from seafoam.ocean.sky.air import disc_shown as shown_from

Rgb = tuple[float, ...]
"""Red, green and blue."""
Exponents = tuple[tuple[int, int], ...]
SCALE = 0.1
"""Height of a unit direction at which x is ½."""


def _exponents(most_x: int, most_s: int, most: int) -> Exponents:
    return tuple((i, j) for i in range(most_x + 1) for j in range(most_s + 1) if i + j <= most)


EVEN, EVEN_TINT = _exponents(5, 3, 5), _exponents(3, 2, 4)
"""Exponents of x and s in P, in the order of its coefficients, and in what red and blue add to it."""
HAZE, HAZE_TINT = _exponents(2, 2, 3), _exponents(1, 1, 1)
"""The same of Q."""
SUN_POWER: Rgb = (19.0, 20.0, 21.6)
"""Irradiance of the sun above the atmosphere: white balance for a sun about 35° above the horizon."""
NIGHT: Rgb = (0.002, 0.0034, 0.0075)
"""Radiance of the night sky."""
DEEP_NIGHT = -0.33
"""Sine of the sun's elevation below which the sky is within 1 % of that of the night."""
DARK: Rgb = (1e-6, 1e-6, 1e-6)
"""Least radiance of a lamp's sky, whose logarithm is fitted."""
ADAPTATION, LOWEST = (24.0, 120.0), 0.14
"""Exponent of the eye's adaptation to dusk, a polynomial of the sine of the sun's depression, and its end."""
_UPS, _TURNS = 22, 15


@dataclass(frozen=True, eq=False)
class Series:
    """Coefficients of the logarithm of a part of the light: of green, (n,), and of red and blue less green, (m, 2)."""

    green: Floats
    tint: Floats


@dataclass(frozen=True, eq=False)
class Glow:
    """Coefficients of P and Q."""

    even: Series
    haze: Series


atmosphere = lru_cache(maxsize=16)(Atmosphere)


def disc_shown(height: float) -> float:
    """Share of the sun's disc above the horizon of the eye, by the sine of its elevation."""
    return float(shown_from(np.array(EARTH + EYE), np.array(height)))


def adapted(height: float) -> float:
    """Factor on the light of the sky after sunset, by the sine of the sun's elevation.

    The light of the zenith falls by a factor of 5 in the first 3° and by 20 in the next, and the eye follows; with the
    factor it falls by 1.2 and by 2.5.
    """
    low = min(max(-height, 0.0), LOWEST)
    return math.exp(low * (ADAPTATION[0] + ADAPTATION[1] * low))


def _terms(exponents: Exponents, up: Floats, toward: Floats) -> Floats:
    powers = [[np.ones_like(up)], [np.ones_like(up)]]
    for of, base in zip(powers, (SCALE / (up + SCALE), toward), strict=True):
        for _ in range(5):
            of.append(of[-1] * base)
    return np.stack([powers[0][i] * powers[1][j] for i, j in exponents], -1)


@lru_cache(maxsize=64)
def glow(mie: float, haze: float, height: float, power: Rgb, least: Rgb = DARK) -> Glow:
    """Return the sky's glow from a lamp.

    ``mie``, ``haze``: as of an :class:`~seafoam.ocean.sky.air.Atmosphere`. ``height``: sine of the lamp's elevation.
    ``power``: its irradiance above the atmosphere. ``least``: radiance that the sky has without it.
    """
    up = np.repeat(np.linspace(0.0, 1.0, _UPS)[:, None] ** 2, _TURNS, axis=1)
    turn = np.cos(math.pi * (np.arange(_TURNS) + 0.5) / _TURNS)[None, :]
    toward = np.sqrt(1.0 - up * up) * turn
    gamma = toward * math.sqrt(1.0 - height * height) + up * height
    smooth, hazy = atmosphere(mie, haze).sky(up, gamma, height)
    smooth, hazy = np.array(power) * smooth + np.array(least), np.array(power) * hazy + np.array(DARK)
    # Bright parts count a little more: dark ones hold little light.
    weight = ((smooth.mean(axis=-1) / smooth.mean()) ** 0.15).reshape(-1, 1)

    def fitted(exponents: Exponents, values: Floats) -> Floats:
        terms = _terms(exponents, up, toward).reshape(up.size, -1)
        result: Floats = np.linalg.lstsq(terms * weight, values.reshape(up.size, -1) * weight, rcond=None)[0]
        # Last digits differ between processors.
        return np.round(result, 6)

    def series(green: Exponents, tint: Exponents, radiance: Floats) -> Series:
        log = np.log2(radiance)
        return Series(fitted(green, log[..., 1])[:, 0], fitted(tint, log[..., ::2] - log[..., 1:2]))

    return Glow(series(EVEN, EVEN_TINT, smooth), series(HAZE, HAZE_TINT, hazy))


def radiance(of: Glow, up: Floats, toward: Floats, gamma: Floats, asymmetry: float) -> Floats:
    """Radiance toward heights ``up`` (...,) and components ``toward`` the lamp's azimuth (...,); (..., 3).

    ``gamma`` (...,): cosine of the angle from the lamp. ``asymmetry``: parameter g of the haze's Henyey-Greenstein
    phase function.
    """
    apart = (1.0 + asymmetry**2 - 2.0 * asymmetry * gamma)[..., None]
    phase = (1.0 - asymmetry**2) / (4.0 * math.pi * apart**1.5)
    above = np.maximum(up, 0.0)

    def part(green: Exponents, tint: Exponents, of: Series) -> Floats:
        log = _terms(green, above, toward) @ of.green
        red, blue = np.moveaxis(_terms(tint, above, toward) @ of.tint, -1, 0)
        both: Floats = np.exp2(np.stack((log + red, log, log + blue), axis=-1))
        return both

    return part(EVEN, EVEN_TINT, of.even) + part(HAZE, HAZE_TINT, of.haze) * phase
