"""Spectral measures of the halftone patterns a mask makes, after Ulichney (1993) and Mitsa and Parker.

A pattern b in {0, 1} of mean g on an M x M tile has the power ``P(f) = |DFT[b - g](f)|^2 / (M^2 g (1 - g))``, so that
white noise is 1 at every frequency. Rings of bins r = round(|f| M), each 1/M cycles per texel wide, without the mean,
give

* RAPS(r), the radially averaged power: the mean of P over the ring;
* anisotropy(r) = 10 log10(s2(r) / RAPS(r)^2) dB, with s2 the ring's sample variance: 0 dB for an isotropic random
  pattern.

One bin of each conjugate pair is used: its twin has the same power and would bias s2. Frequencies run to 0.7071
cycles per texel; rings beyond 0.5 are cut by the corners of the frequency plane. Ulichney averages the power over K
segments of a pattern; here K = 1: the whole tile, which is periodic, so nothing leaks from bin to bin.
"""

import math
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, BeforeValidator, PlainSerializer

from seafoam.masks.torus import Field, Ranks, Shape

GREY_LEVELS: tuple[float, ...] = (1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4)
SIGNIFICANT_DIGITS = 5
LEAST_BINS = 32
"""Rings of fewer bins say little: the variance of so few values, and its logarithm, which is biased low."""


def _significant(value: float) -> float | None:
    return float(f"{value:.{SIGNIFICANT_DIGITS}g}") if math.isfinite(value) else None


_Numbers = Annotated[
    NDArray[np.float64],
    BeforeValidator(lambda values: np.asarray(values, np.float64)),
    PlainSerializer(lambda values: [_significant(value) for value in values.tolist()]),
]
"""As JSON, numbers of :data:`SIGNIFICANT_DIGITS` digits; null for NaN."""
_Counts = Annotated[
    NDArray[np.intp],
    BeforeValidator(lambda values: np.asarray(values, np.intp)),
    PlainSerializer(lambda values: values.tolist()),
]


class GreySpectrum(BaseModel, frozen=True, arbitrary_types_allowed=True):
    """Spectrum of the pattern of one grey level. Index i of an array is ring i + 1."""

    grey: float
    principal_frequency: Annotated[float, PlainSerializer(_significant)]
    """Frequency (cycles per texel) at which ideally spread dots of this grey repeat (Ulichney)."""
    raps: _Numbers
    """Radially averaged power, white noise = 1; (rings,)."""
    anisotropy_db: _Numbers
    """NaN where a ring has one bin or no power; (rings,)."""


class MaskSpectrum(BaseModel, frozen=True, arbitrary_types_allowed=True):
    """Spectra of a mask's patterns at several grey levels."""

    frequency_unit: Literal["cycles per texel"] = "cycles per texel"
    frequency: _Numbers
    """Ring centres; (rings,)."""
    bins: _Counts
    """Bins in each ring, half plane; (rings,)."""
    greys: tuple[GreySpectrum, ...]


def measure_spectrum(ranks: Ranks, *, greys: tuple[float, ...] = GREY_LEVELS) -> MaskSpectrum:
    """Measure the patterns ``rank < g N`` of a mask.

    ranks: (rows, columns). greys: fractions in 0 < g < 1. The rings of a mask that is not square have the width of
    those of its shorter side. Raises ``ValueError`` for a grey that leaves the pattern empty or full.
    """
    ring, count = _rings(ranks.shape)
    spectra = []
    for grey in greys:
        ones = round(grey * ranks.size)
        if not 0 < ones < ranks.size:
            raise ValueError(f"grey {grey!r} gives an empty or full pattern on {ranks.size} texels")
        share = ones / ranks.size
        amplitude = np.fft.rfft2((ranks < ones) - share)
        power = (amplitude.real**2 + amplitude.imag**2) / (ranks.size * share * (1.0 - share))
        raps, anisotropy = _ring_statistics(power, ring, count)
        principal = math.sqrt(min(grey, 1.0 - grey))
        spectra.append(GreySpectrum(grey=grey, principal_frequency=principal, raps=raps, anisotropy_db=anisotropy))
    frequency = np.arange(1, count.size) / min(ranks.shape)
    return MaskSpectrum(frequency=frequency, bins=count[1:], greys=tuple(spectra))


def _rings(shape: Shape) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Ring of each ``rfft2`` bin, 0 for bins to leave out, and the bins in each ring from 0 on."""
    rows, columns = shape
    ky = np.rint(np.fft.fftfreq(rows) * rows)[:, None]
    kx = np.arange(columns // 2 + 1, dtype=np.float64)[None, :]
    ring = np.rint(np.hypot(ky * (min(shape) / rows), kx * (min(shape) / columns))).astype(np.intp)
    # The columns kx = 0 and kx = columns/2 hold both bins of their pairs.
    twin = (ky < 0) & ((kx == 0) | (2 * kx == columns)) & (-2 * ky != rows)
    ring[twin] = 0
    count = np.bincount(ring.ravel())
    count[0] = 0
    return ring, count


def _ring_statistics(power: Field, ring: NDArray[np.intp], count: NDArray[np.intp]) -> tuple[Field, Field]:
    rings = ring.ravel()
    total = np.bincount(rings, weights=power.ravel())[1:]
    number = count[1:]
    raps = total / number
    deviation = power.ravel() - np.concatenate(([0.0], raps))[rings]
    squares = np.bincount(rings, weights=deviation**2)[1:]
    anisotropy = np.full(raps.shape, np.nan)
    defined = (number > 1) & (raps > 0.0) & (squares > 0.0)
    variance = squares[defined] / (number[defined] - 1)
    anisotropy[defined] = 10.0 * np.log10(variance / raps[defined] ** 2)
    return raps, anisotropy
