"""Where still water lies among the paper's waves, which count from their troughs. y = 0 is still water everywhere."""

import math

from seafoam.scene.models import ParametricWave, Scene


def wave_level(wave: ParametricWave) -> float:
    """Mean of A((sin θ + 1)/2)^K over a period, m: A Γ(K + ½)/(√π Γ(K + 1))."""
    return (
        wave.amplitude
        / math.sqrt(math.pi)
        * math.exp(math.lgamma(wave.exponent + 0.5) - math.lgamma(wave.exponent + 1.0))
    )


def paper_level(scene: Scene) -> float:
    """Height of still water over the troughs of all parametric waves together, m: from there the paper's H₀ counts."""
    return sum(wave_level(wave) for wave in scene.waves)
