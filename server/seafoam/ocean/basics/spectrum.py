"""The spectrum of a wind sea.

JONSWAP (Hasselmann et al. 1973) with the fully developed limits of Pierson and Moskowitz (1964), the finite-depth
factor of Kitaigorodskii et al. (1975; TMA, Bouws et al. 1985), spreading cos^2s of half the angle (Longuet-Higgins
et al. 1963). docs/formulae.md, section 2.
"""

import math

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Sea

GAMMA = 3.3
"""Peak enhancement of JONSWAP."""
AROUND_STEP = 2.0 * math.pi / 720
AROUND: Floats = (np.arange(720, dtype=np.float64) + 0.5) * AROUND_STEP
"""Angles over which integrals over a turn are taken, rad, and the step from one to the next."""


def peak_frequency(wind: float, fetch: float) -> float:
    """Return the peak angular frequency of the spectrum, rad/s; wind in m/s above 0, fetch in m."""
    growing = 22.0 * math.pow(GRAVITY * GRAVITY / (wind * fetch), 1.0 / 3.0)
    return max(growing, 0.855 * GRAVITY / wind)


def frequency_spectrum(omega: Floats, wind: float, fetch: float) -> Floats:
    """Return JONSWAP S(ω) in deep water, m²·s/rad, at ω > 0 rad/s; 0 without wind."""
    if wind <= 0.0:
        return np.zeros_like(omega)
    peak = peak_frequency(wind, fetch)
    alpha = max(0.076 * (wind * wind / (fetch * GRAVITY)) ** 0.22, 0.0081)
    ratio = omega / peak
    width = np.where(ratio <= 1.0, 0.07, 0.09)
    enhanced = GAMMA ** np.exp(-((ratio - 1.0) ** 2) / (2.0 * width * width))
    # Below a third of the peak frequency exp underflows; the limit keeps powers of small ratios from overflowing.
    limited = np.maximum(ratio, 0.05)
    result: Floats = alpha * GRAVITY**2 * (limited * peak) ** -5.0 * np.exp(-1.25 * limited**-4.0) * enhanced
    return np.where(ratio < 0.05, 0.0, result)


def dispersion(k: Floats, depth: float | None) -> tuple[Floats, Floats, Floats]:
    """Return ω (rad/s), dω/dk (m/s) and the depth factor of the spectrum, at k > 0 rad/m; depth in m, absent: deep."""
    if depth is None:
        omega = np.sqrt(GRAVITY * k)
        return omega, 0.5 * omega / k, np.ones_like(k)
    kd = np.minimum(k * depth, 30.0)
    tanh = np.tanh(kd)
    omega = np.sqrt(GRAVITY * k * tanh)
    share = 0.5 * (1.0 + 2.0 * kd / np.sinh(2.0 * kd))
    return omega, share * omega / k, tanh * tanh / (2.0 * share)


def spreading(angle: Floats, exponent: float, against: float) -> Floats:
    """Return the energy fraction per radian at an angle to the wind (rad); ``against``: weight of waves
    that travel against it."""

    def shape(angles: Floats) -> Floats:
        weight = np.where(np.cos(angles) < 0.0, against, 1.0)
        return weight * np.abs(np.cos(0.5 * angles)) ** (2.0 * exponent)

    return shape(angle) / float(shape(AROUND).sum() * AROUND_STEP)


def wave_spectrum(kx: Floats, kz: Floats, sea: Sea, depth: float | None) -> Floats:
    """Return Ψ(k), m⁴: its integral over the plane of wavevectors (rad/m, not 0) is the mean square height."""
    k = np.hypot(kx, kz)
    omega, group, shallow = dispersion(k, depth)
    angle = np.arctan2(kz, kx) - sea.downwind
    energy = frequency_spectrum(omega, sea.wind_speed, sea.fetch) * shallow * group / k
    return energy * spreading(angle, sea.spread, sea.against)


def shallow_water_factor(omega: Floats, depth: float | None) -> Floats:
    """Return the finite-depth factor of the spectrum at ω (rad/s); depth in m, absent: deep."""
    if depth is None:
        return np.ones_like(omega)
    k = np.geomspace(1e-7, 1e3, 20001)
    of_k, _, factor = dispersion(k, depth)
    return np.interp(omega, of_k, factor)
