"""Still-water level of parametric waves, whose heights are measured from their troughs; still water is at y = 0."""

import math

from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave
from seafoam.sums import summed


def wave_level(wave: ParametricWave) -> float:
    """Return the mean of A((sin θ + 1)/2)^K over a period, m: A Γ(K + ½)/(√π Γ(K + 1))."""
    log = math.lgamma(wave.exponent + 0.5) - math.lgamma(wave.exponent + 1.0)
    return wave.amplitude / math.sqrt(math.pi) * math.exp(log)


def paper_level(scene: Scene) -> float:
    """Return the height of still water above the troughs of all parametric waves, m: where H₀ is 0."""
    return summed(wave_level(wave) for wave in scene.waves)
