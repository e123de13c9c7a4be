"""Groups of high waves with calmer water between them: their size and speed. docs/formulae.md, section 2."""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats, read_only
from seafoam.ocean.basics.dispersion import angular_frequency, wavenumber
from seafoam.ocean.basics.hash import chance
from seafoam.scene import ParametricWave, Scene, WaveGroups

CELLS_APART = 3.2
"""Mean distance of groups, cells of the noise."""
PERIOD = 64
"""Period of the noise along each axis, cells."""
_KEY = 23
"""Key of the hash of corners."""


def in_groups(scene: Scene) -> bool:
    """Return whether the scene's parametric waves travel in groups."""
    groups = scene.wave_groups
    return groups is not None and groups.contrast > 0.0 and _steepest(scene) is not None


def group_key(seed: int) -> int:
    """Return the state of the hash after key and seed, a signed number of 32 bits."""
    word = round(float(chance(_KEY, seed)) * 2.0**32 - 0.5)
    return word - 2**32 if word >= 2**31 else word


@lru_cache(maxsize=16)
def group_corners(seed: int) -> Floats:
    """Return the corners of the noise, (PERIOD, PERIOD) in [0, 1], rows along the second axis.

    A quarter of them are 0, a quarter are 1, the others even between.
    """
    i, j = np.meshgrid(np.arange(PERIOD), np.arange(PERIOD))
    return read_only(np.clip(2.0 * chance(_KEY, seed, i, j) - 0.5, 0.0, 1.0))


def group_cells(scene: Scene, groups: WaveGroups) -> tuple[float, float]:
    """Return the step of the noise along the way of the groups, (x, z) cells/m; the other step is at right angles."""
    wave = _steepest(scene)
    heading = 0.0 if wave is None else wave.direction
    step = CELLS_APART / groups.size
    return float(f"{step * math.cos(heading):.8g}"), float(f"{step * math.sin(heading):.8g}")


def group_velocity(scene: Scene) -> tuple[float, float]:
    """Return the velocity of the scene's groups, (x, z) m/s, rounded to 1 µm/s: that of its steepest wave.

    Every quality draws that wave. (0, 0) without waves.
    """
    wave = _steepest(scene)
    if wave is None:
        return 0.0, 0.0
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


def _steepest(scene: Scene) -> ParametricWave | None:
    raised = [wave for wave in scene.waves if wave.amplitude > 0.0]
    return max(raised, key=lambda wave: wave.amplitude / wave.wavelength, default=None)
