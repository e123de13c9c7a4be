"""Linear dispersion of gravity waves; still water under parametric ones, whose heights are measured from troughs."""

import math

from seafoam.ocean.constants import GRAVITY
from seafoam.scene import ParametricWave, Scene
from seafoam.sums import summed


def wavenumber(deep: float, depth: float | None) -> float:
    """Return k with k tanh(k·depth) = ``deep``, the wavenumber (rad/m) of the same frequency in deep water.

    ``depth`` in m, positive; absent or large: ``deep`` itself. Newton's method from Eckart's (1952) estimate, to the
    last digits of float64.
    """
    if depth is None or deep * depth > 20.0:
        return deep
    k = deep / math.sqrt(math.tanh(deep * depth))
    for _ in range(30):
        tanh = math.tanh(k * depth)
        step = (k * tanh - deep) / (tanh + k * depth * (1.0 - tanh * tanh))
        k -= step
        if abs(step) <= 1e-15 * k:
            break
    return k


def angular_frequency(wave: ParametricWave) -> float:
    """Return ω = 2πs/λ, rad/s, with the deep-water speed √(gλ/2π) if the wave gives none."""
    deep = 2.0 * math.pi / wave.wavelength
    return math.sqrt(GRAVITY * deep) if wave.speed is None else wave.speed * deep


def wavevector(wave: ParametricWave, depth: float | None) -> tuple[float, float]:
    """Return the wavevector k in the direction of travel, (x, z), rad/m; θ = ωt − k·x + phase."""
    k = wavenumber(2.0 * math.pi / wave.wavelength, depth)
    return k * math.cos(wave.direction), k * math.sin(wave.direction)


def wave_level(wave: ParametricWave) -> float:
    """Return the mean of A((sin θ + 1)/2)^K over a period, m: A Γ(K + ½)/(√π Γ(K + 1))."""
    log = math.lgamma(wave.exponent + 0.5) - math.lgamma(wave.exponent + 1.0)
    return wave.amplitude / math.sqrt(math.pi) * math.exp(log)


def paper_level(scene: Scene) -> float:
    """Return the height of still water above the troughs of all parametric waves, m: where H₀ is 0."""
    return summed(wave_level(wave) for wave in scene.waves)
