"""The mean height of the surface above its troughs."""

import math

from seafoam.ocean.cascades import RAISED, cascades
from seafoam.ocean.rings import calm_level
from seafoam.scene.models import ParametricWave, Scene


def wave_level(wave: ParametricWave) -> float:
    """Return the mean of A((sin θ + 1)/2)^K over a period, m: A Γ(K + ½)/(√π Γ(K + 1))."""
    return (
        wave.amplitude
        / math.sqrt(math.pi)
        * math.exp(math.lgamma(wave.exponent + 0.5) - math.lgamma(wave.exponent + 1.0))
    )


def mean_level(scene: Scene) -> float:
    """Return the mean height of waves, rings at rest and open sea above y = 0, m; without a shore."""
    level = sum(wave_level(wave) for wave in scene.waves) + calm_level(scene)
    if scene.sea is not None and scene.sea.wind > 0.0:
        level += sum(of.limit for of in cascades(scene.sea, scene.water.depth)[:RAISED])
    return level
