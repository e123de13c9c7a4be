"""A tile of the sea as a sum of all its waves, with which the reference's grids are compared."""

import math

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.waves.cascades import BAND, Cascade
from seafoam.reference.waves.sea import TileSample, amplitudes


def summed(cascade: Cascade, time: float, x: NDArray[np.float64], z: NDArray[np.float64]) -> TileSample:
    """The field at every place (m, (r,)) at a time, s."""
    step = 2.0 * math.pi / cascade.size
    rows, columns = np.nonzero(cascade.h0)
    kx, kz = step * (columns - BAND), step * (rows - BAND)
    k = np.hypot(kx, kz)
    h = 2.0 * amplitudes(cascade, time)[rows, columns]
    parts: list[list[NDArray[np.float64]]] = []
    for start in range(0, x.size, 256):
        here = slice(start, start + 256)
        wave = np.exp(1j * (kx[:, None] * x[here] + kz[:, None] * z[here]))
        factors = (1.0, 1j * kx, 1j * kz, 1j * kx / k, 1j * kz / k, -kx * kx / k, -kx * kz / k, -kz * kz / k)
        parts.append([np.real((h * factor) @ wave) for factor in factors])
    return TileSample(*(np.concatenate(part) for part in zip(*parts, strict=True)))
