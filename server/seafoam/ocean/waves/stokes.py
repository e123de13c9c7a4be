"""Stokes drift: the mean drift of floating matter caused by waves (Stokes 1847). docs/formulae.md, section 14."""

import math

import numpy as np

from seafoam.ocean.basics.dispersion import angular_frequency, wavenumber
from seafoam.ocean.basics.spectrum import AROUND, AROUND_STEP, dispersion, frequency_spectrum, spreading
from seafoam.ocean.waves.cascades import SHORTEST
from seafoam.scene import FoamLife, ParametricWave, Scene, Sea

SHALLOW = 0.5
"""Minimum of k·depth in the finite-depth factor: linear theory diverges toward 0."""


def steady_drift(scene: Scene) -> tuple[float, float]:
    """Return the sum of current and Stokes drift, (x, z) m/s, which moves foam outside vortices."""
    drift = scene.drift
    if drift is None:
        return 0.0, 0.0
    x, z = waves_drift(scene)
    return drift.current[0] + drift.waves * x, drift.current[1] + drift.waves * z


def waves_drift(scene: Scene) -> tuple[float, float]:
    """Return the Stokes drift of parametric waves and open sea at the surface, (x, z) m/s."""
    x, z = 0.0, 0.0
    for wave in scene.waves:
        k = wavenumber(2.0 * math.pi / wave.wavelength, scene.water.depth)
        speed = first_harmonic(wave.amplitude, wave.exponent) ** 2 * angular_frequency(wave) * k
        speed *= _shallow(k, scene.water.depth)
        x, z = x + speed * math.cos(wave.direction), z + speed * math.sin(wave.direction)
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        speed = sea_drift(scene.sea, scene.water.depth)
        x += speed * math.cos(scene.sea.downwind)
        z += speed * math.sin(scene.sea.downwind)
    return x, z


def foam_life(scene: Scene) -> FoamLife | None:
    """Return the scene's foam life; None if the foam does not move, as in all looks but the filtered one."""
    return scene.foam.life if scene.foam is not None and scene.foam.look == "filtered" else None


def follows_orbits(scene: Scene) -> bool:
    """Return whether the waves' orbits move the foam."""
    life = foam_life(scene)
    return life is not None and life.carried


def foam_drift(scene: Scene) -> tuple[float, float]:
    """Return the drift of foam by waves and wind, (x, z) m/s, rounded to 1 µm/s; 0 with a shore."""
    life = foam_life(scene)
    if life is None or scene.shore is not None:
        return 0.0, 0.0
    x, z = waves_drift(scene) if life.carried else (0.0, 0.0)
    x += life.drift_speed * math.cos(life.downwind)
    z += life.drift_speed * math.sin(life.downwind)
    return round(x, 6), round(z, 6)


def orbit(wave: ParametricWave, depth: float | None) -> float:
    """Return the horizontal orbital amplitude of a wave at the surface, m: a coth(kh), first harmonic."""
    a = first_harmonic(wave.amplitude, wave.exponent)
    if depth is None:
        return a
    k = wavenumber(2.0 * math.pi / wave.wavelength, depth)
    return a / math.tanh(max(k * depth, SHALLOW))


def first_harmonic(amplitude: float, exponent: float) -> float:
    """Amplitude of the first harmonic of A((sin θ + 1)/2)^K, in the unit of A."""
    log = math.lgamma(2.0 * exponent + 1.0) - math.lgamma(exponent + 2.0) - math.lgamma(exponent)
    return amplitude * math.pow(2.0, 1.0 - 2.0 * exponent) * math.exp(log)


def sea_drift(sea: Sea, depth: float | None) -> float:
    """Return the Stokes drift 2∫ ω k S(ω) dω of the sea along the wind, m/s, down to the shortest drawn wave."""
    k = np.geomspace(1e-4, 2.0 * math.pi / SHORTEST, 4096)
    omega, group, shallow = dispersion(k, depth)
    energy = frequency_spectrum(omega, sea.wind_speed, sea.fetch) * shallow * group
    factor = np.array([_shallow(k_i, depth) for k_i in k])
    values = 2.0 * omega * k * energy * factor
    total = float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(k)))
    along = float((spreading(AROUND, sea.spread, sea.against) * np.cos(AROUND)).sum() * AROUND_STEP)
    return total * along


def _shallow(k: float, depth: float | None) -> float:
    """cosh(2kd)/(2 sinh²(kd)): finite-depth factor of the drift at the surface; 1 in deep water."""
    if depth is None or k * depth > 20.0:
        return 1.0
    sinh = math.sinh(max(k * depth, SHALLOW))
    return 1.0 + 0.5 / (sinh * sinh)
