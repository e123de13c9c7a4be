"""Spectral measures of the halftone patterns a mask makes, after Ulichney (1993) and Mitsa and Parker.

A pattern b in {0, 1} of mean g on an M x M tile has the power ``P(f) = |DFT[b - g](f)|^2 / (M^2 g (1 - g))``,
averaged over K segments, so that white noise is 1 at every frequency. Rings of bins r = round(|f| M), each
1/M cycles per texel wide and without the mean, give

* RAPS(r), the radially averaged power: the mean of P over the ring;
* anisotropy(r) = 10 log10(s2(r) / RAPS(r)^2) dB, with s2 the ring's sample variance: -10 log10 K dB for an
  isotropic random pattern.

One bin of each conjugate pair is used: its twin has the same power and would bias s2. Frequencies run to 0.7071
cycles per texel; rings beyond 0.5 are cut by the corners of the frequency plane. With K = 1 the segment is the
whole tile, which is periodic, so nothing leaks from bin to bin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.torus import Field, Ranks, Shape

GREY_LEVELS: tuple[float, ...] = (1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4)
SIGNIFICANT_DIGITS = 5
LEAST_BINS = 32
"""Rings of fewer bins are left out of mean and maximal anisotropy: the variance of so few values says little, and
its logarithm is biased low."""


@dataclass(frozen=True, slots=True)
class GreySpectrum:
    """Spectrum of the pattern of one grey level. Index i of an array is ring i + 1."""

    grey: float
    raps: NDArray[np.float64]
    """Radially averaged power, white noise = 1; (rings,)."""
    anisotropy: NDArray[np.float64]
    """Decibels; NaN where a ring has one bin or no power; (rings,)."""

    @property
    def principal_frequency(self) -> float:
        """Frequency (cycles per texel) at which ideally spread dots of this grey repeat (Ulichney)."""
        return math.sqrt(min(self.grey, 1.0 - self.grey))


@dataclass(frozen=True, slots=True)
class MaskSpectrum:
    """Spectra of a mask's patterns at several grey levels."""

    segments: int
    """K, the number of segments averaged."""
    frequency: NDArray[np.float64]
    """Ring centres, cycles per texel; (rings,)."""
    bins: NDArray[np.intp]
    """Bins in each ring, half plane; (rings,)."""
    greys: tuple[GreySpectrum, ...]

    @property
    def isotropic_reference(self) -> float:
        """Anisotropy (dB) of a perfectly isotropic random pattern: -10 log10 K."""
        return -10.0 * math.log10(self.segments)

    def grey(self, level: float) -> GreySpectrum:
        """The spectrum at a grey level. Raises ``KeyError`` if it was not measured."""
        for entry in self.greys:
            if entry.grey == level:
                return entry
        raise KeyError(level)

    def mean_raps(self, level: float, low: float, high: float) -> float:
        """Mean of RAPS over rings with low < f <= high (cycles per texel)."""
        inside = (self.frequency > low) & (self.frequency <= high)
        return float(self.grey(level).raps[inside].mean())

    def mean_anisotropy(self, level: float) -> float:
        """Mean anisotropy (dB) over rings of at least :data:`LEAST_BINS` bins."""
        return float(np.nanmean(self.grey(level).anisotropy[self.bins >= LEAST_BINS]))

    def max_anisotropy(self, level: float) -> float:
        """Greatest anisotropy (dB) of a ring of at least :data:`LEAST_BINS` bins."""
        return float(np.nanmax(self.grey(level).anisotropy[self.bins >= LEAST_BINS]))

    def to_json(self) -> dict[str, object]:
        """Plain JSON values, :data:`SIGNIFICANT_DIGITS` digits; an anisotropy that is not defined is null."""
        return {
            "segments": self.segments,
            "isotropic_reference_db": self.isotropic_reference + 0.0,
            "frequency_unit": "cycles per texel",
            "frequency": _rounded(self.frequency),
            "bins": [int(count) for count in self.bins],
            "greys": [
                {
                    "grey": entry.grey,
                    "principal_frequency": _significant(entry.principal_frequency),
                    "raps": _rounded(entry.raps),
                    "anisotropy_db": _rounded(entry.anisotropy),
                }
                for entry in self.greys
            ],
        }


def measure_spectrum(ranks: Ranks, *, greys: tuple[float, ...] = GREY_LEVELS, segments_a_side: int = 1) -> MaskSpectrum:
    """Measure the patterns ``rank < g N`` of a mask.

    ranks: (rows, columns). greys: fractions in 0 < g < 1. segments_a_side: the tile is cut into its square, K. The
    rings of a mask that is not square have the width of those of its shorter side.

    Raises ``ValueError`` for a grey that leaves the pattern empty or full, or a
    number of segments that does not divide the tile into at least 8 x 8 texels.
    """
    if segments_a_side < 1 or any(side % segments_a_side or side // segments_a_side < 8 for side in ranks.shape):
        sides = " x ".join(map(str, ranks.shape))
        raise ValueError(f"{segments_a_side} segments per side do not divide {sides} texels into parts of 8 or more")
    shape = ranks.shape[0] // segments_a_side, ranks.shape[1] // segments_a_side
    ring, count = _rings(shape)
    spectra = []
    for grey in greys:
        ones = round(grey * ranks.size)
        if not 0 < ones < ranks.size:
            raise ValueError(f"grey {grey!r} gives an empty or full pattern on {ranks.size} texels")
        power = _power(ranks < ones, ones / ranks.size, shape)
        raps, anisotropy = _ring_statistics(power, ring, count)
        spectra.append(GreySpectrum(grey, raps, anisotropy))
    frequency = np.arange(1, count.size) / min(shape)
    return MaskSpectrum(segments_a_side**2, frequency, count[1:], tuple(spectra))


def spectrum_from_json(document: dict[str, object]) -> MaskSpectrum:
    """Inverse of :meth:`MaskSpectrum.to_json`. Raises ``KeyError`` or ``TypeError`` for another document."""
    greys = document["greys"]
    segments = document["segments"]
    if not isinstance(greys, list) or not isinstance(segments, int):
        raise TypeError("not a spectrum document")
    return MaskSpectrum(
        segments=segments,
        frequency=np.array(document["frequency"], np.float64),
        bins=np.array(document["bins"], np.intp),
        greys=tuple(
            GreySpectrum(
                grey=float(entry["grey"]),
                raps=np.array(entry["raps"], np.float64),
                anisotropy=np.array(entry["anisotropy_db"], np.float64),
            )
            for entry in greys
        ),
    )


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


def _power(pattern: NDArray[np.bool_], grey: float, shape: Shape) -> Field:
    """Power on ``rfft2`` bins, mean over the segments; (rows, columns//2+1)."""
    rows, columns = shape
    along = pattern.shape[0] // rows
    segments = (pattern - grey).reshape(along, rows, along, columns).swapaxes(1, 2)
    amplitude = np.fft.rfft2(segments)
    power: Field = (amplitude.real**2 + amplitude.imag**2).mean(axis=(0, 1))
    return power / (rows * columns * grey * (1.0 - grey))


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


def _significant(value: float) -> float | None:
    return float(f"{value:.{SIGNIFICANT_DIGITS}g}") if math.isfinite(value) else None


def _rounded(values: NDArray[np.float64]) -> list[float | None]:
    return [_significant(value) for value in values.tolist()]
