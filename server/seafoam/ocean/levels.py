"""Still water among the paper's waves, whose heights count from their troughs; y = 0 is still water everywhere."""

import math

from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave


def wave_level(wave: ParametricWave) -> float:
    """Return the mean of A((sin θ + 1)/2)^K over a period, m: A Γ(K + ½)/(√π Γ(K + 1))."""
    return (
        wave.amplitude
        / math.sqrt(math.pi)
        * math.exp(math.lgamma(wave.exponent + 0.5) - math.lgamma(wave.exponent + 1.0))
    )


def paper_level(scene: Scene) -> float:
    """Return the height of still water above the troughs of all parametric waves, m: the zero of the paper's H₀."""
    return sum(wave_level(wave) for wave in scene.waves)
