"""Groups of high waves with calmer water between them: the periodic field that both effect and reference use.

docs/formulae.md, section 2."""

import math
from functools import lru_cache

from seafoam.ocean.dispersion import angular_frequency, wavenumber
from seafoam.ocean.hash import chance
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave, WaveGroups

SIDE = 2.1
"""Side of the field's period over the mean distance of groups."""

WAVES = 8
"""Number of cosines of the field."""

AMPLITUDE = 0.75
"""Amplitude of each of them, rad."""

TEXELS = 128
"""Values of the field along a period, bilinear between them."""

_SEED = 23
_CHOICE = tuple(
    (ix, iz) for ix in range(4) for iz in range(-3, 4) if 4 <= ix * ix + iz * iz <= 9 and (ix > 0 or iz > 0)
)
"""Wavenumbers that a cosine may have, in waves along x and z of the period, one of each opposite pair."""


def group_side(groups: WaveGroups) -> float:
    """Return the period of the field along x and along z, m."""
    return float(f"{SIDE * groups.size:.6g}")


@lru_cache(maxsize=16)
def group_waves(seed: int) -> tuple[tuple[int, int, float], ...]:
    """Return (ix, iz, phase) of the cosines: waves along x and z of the period, and the phase at its corner, rad."""
    order = sorted(range(len(_CHOICE)), key=lambda i: float(chance(_SEED, seed, 0, i)))[:WAVES]
    return tuple((*_CHOICE[i], 2.0 * math.pi * float(chance(_SEED, seed, 1, i))) for i in sorted(order))


def group_velocity(scene: Scene) -> tuple[float, float]:
    """Return the velocity of the scene's groups, (x, z) m/s, rounded to 1 µm/s: that of its steepest wave.

    Every quality draws that wave. (0, 0) without waves.
    """
    raised = [wave for wave in scene.waves if wave.amplitude > 0.0]
    if not raised:
        return 0.0, 0.0
    wave = max(raised, key=lambda wave: wave.amplitude / wave.wavelength)
    speed = group_speed(wave, scene.water.depth)
    return round(speed * math.cos(wave.direction), 6), round(speed * math.sin(wave.direction), 6)


def group_speed(wave: ParametricWave, depth: float | None) -> float:
    """Return the speed of energy of a wave, m/s: ½ (1 + 2kd/sinh 2kd) ω/k; ``depth`` d in m, absent: deep water."""
    k = wavenumber(2.0 * math.pi / wave.wavelength, depth)
    share = 0.5
    if depth is not None:
        twice = 2.0 * k * depth
        share += 0.5 * twice / math.sinh(twice) if twice < 40.0 else 0.0
    return share * angular_frequency(wave) / k
