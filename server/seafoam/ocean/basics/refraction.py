"""Refraction of light at the surface of water. docs/formulae.md, sections 6 and 11."""

import math

from seafoam.ocean.constants import WATER_INDEX


def refracted_cosine(cosine: float, index: float = WATER_INDEX) -> float:
    """Cosine of the refracted ray to the normal from the cosine of incidence, 0 to 1: Snell's law."""
    return math.sqrt(1.0 - (1.0 - cosine * cosine) / index**2)
