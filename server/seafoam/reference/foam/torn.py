"""Torn foam averaged over a footprint, as in the filtered look. docs/formulae.md, section 8."""

import numpy as np
from numpy.typing import ArrayLike

from seafoam.reference.types import Floats

Feet = tuple[Floats, Floats]
"""Both sides of the footprints, (r, 2) m each."""


def torn(parts: list[tuple[float, float, Floats]], feet: Feet) -> tuple[Floats, Floats]:
    """Mean of a sum of noises under footprints, and its variance there; (r,) each.

    Each noise: its share, the size of its cells (m), and its values in [0, 1].
    """
    x, y = feet
    mean, unresolved = np.full(x.shape[0], 0.5), np.zeros(x.shape[0])
    for share, cell, noise in parts:
        per = 3.23 / 12.0 / cell**2
        area = per * (x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0])
        kept = 1.0 / (1.0 + per * ((x**2).sum(axis=1) + (y**2).sum(axis=1)) + area**2)
        mean += share * np.sqrt(kept) * (noise - 0.5)
        unresolved += share**2 * 0.046 * (1.0 - kept)
    return mean, unresolved


def torn_step(low: ArrayLike, high: ArrayLike, x: Floats, variance: Floats) -> Floats:
    """Mean of smoothstep(low, high, x) where x has this variance; (r,)."""
    begin, end = np.asarray(low, np.float64), np.asarray(high, np.float64)
    reach = np.sqrt(0.25 * (end - begin) ** 2 + 5.0 * variance)
    q = np.clip((x - 0.5 * (begin + end) + reach) / (2.0 * reach), 0.0, 1.0)
    result: Floats = q * q * (3.0 - 2.0 * q)
    return result


def spread(gradient: tuple[Floats, Floats], feet: Feet) -> Floats:
    """Variance under footprints of a quantity with this gradient, per metre; (r,)."""
    result: Floats = np.zeros(feet[0].shape[0])
    for foot in feet:
        result = result + (gradient[0] * foot[:, 0] + gradient[1] * foot[:, 1]) ** 2 / 12.0
    return result
