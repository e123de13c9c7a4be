"""Periodic tiles of a wind sea: the random waves that both effect and reference use. docs/formulae.md, section 2."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.arrays import Floats
from seafoam.ocean.basics import spectrum
from seafoam.ocean.basics.dispersion import wavenumber
from seafoam.ocean.basics.hash import chance
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Sea
from seafoam.sums import summed

BAND = 64
"""Upper bound of a tile's wavenumbers, in waves along its side."""
LOOP = 2048.0
"""Period of the sea, s: every angular frequency is an integer multiple of 2π/LOOP."""
RATIOS = (1.0, 5.23, 4.87, 4.61)
"""Ratios of the sides of successive tiles; not ratios of small integers, so that their common period is long."""
PEAKS = 8.0
"""Wavelengths of the spectral peak along the largest tile."""
SMALLEST_TILE = 24.0
"""Minimum side of the largest tile, m."""
SHORTEST = 0.1
"""Shortest wavelength, m; ripples (``Ripples``) represent shorter waves."""
RAISED = 2
"""Number of tiles, from the largest, that displace the surface; smaller ones only tilt its normal."""
GERSTNER_WAVES = 48
"""Number of waves of a Gerstner sea."""
GERSTNER_RATIO = 1.618
"""Ratio of the sides of the two tiles of Gerstner waves."""
CREST = 4.5
"""Limit of heights in standard deviations, which one point in 150 000 of a Gaussian sea exceeds."""
TILT = 0.24
"""Maximum of a tile's root mean square slope times choppiness: the Jacobian is then negative at 1 point in 60 000."""
LEAST_JACOBIAN = 0.3
"""Lower limit of the Jacobian in divisions: where it is negative the surface overturns, unlike a height field."""


@dataclass(frozen=True, eq=False)
class Cascade:
    """A square tile of sea: h(x, t) = Σ 2 Re(h₀ e^{i(k·x − ωt)}) over the wavevectors.

    Arrays are (2·BAND, 2·BAND), row iz + BAND, column ix + BAND, for −BAND … BAND − 1 waves along z and x.
    """

    size: float
    """Side, m."""
    h0: NDArray[np.complex128]
    """Complex amplitude of the wave that travels along +k, m: half its real amplitude, with its phase."""
    turns: NDArray[np.int64]
    """Number of periods in LOOP seconds."""

    @cached_property
    def k(self) -> Floats:
        """Wavenumbers, rad/m."""
        return _wavevectors(self.size)[2]

    @cached_property
    def variance(self) -> float:
        """Mean square height, m²."""
        return float(2.0 * (np.abs(self.h0) ** 2).sum())

    @cached_property
    def mean_square_slope(self) -> float:
        """Mean square slope, both directions together."""
        return float(2.0 * (np.abs(self.k * self.h0) ** 2).sum())

    @cached_property
    def limit(self) -> float:
        """Limit of the absolute height, m."""
        return min(CREST * math.sqrt(self.variance), 2.0 * float(np.abs(self.h0).sum()))

    @property
    def max_slope(self) -> float:
        """Upper bound of the slope of the drawn height."""
        return slope_limit(math.sqrt(self.mean_square_slope))

    def map_error(self, texels: int) -> float:
        """Upper bound of the error of bilinear interpolation between ``texels``² texels, m.

        Proportional to the second derivative times texel²; the factor is the most of eight seas at 128 to 512 texels,
        plus a tenth.
        """
        deviation = math.sqrt(float(2.0 * (np.abs(self.k**2 * self.h0) ** 2).sum()))
        return 0.155 * deviation * (self.size / texels) ** 2

    def choppiness(self, requested: float) -> float:
        """Return ``requested``, reduced if the Jacobian would be negative too often."""
        slope = math.sqrt(self.mean_square_slope)
        return requested if requested * slope <= TILT else TILT / slope

    def divergence_variance(
        self, choppiness: float, texels: int, read: Literal["spline", "bilinear", "halves"]
    ) -> float:
        """Mean square of F = λ div D, the divergence of the horizontal displacement, on ``texels``² texels.

        ``read``: by B-spline, bilinearly, or bilinearly at the texels and the points half way between them.
        """
        i = np.arange(-BAND, BAND)
        cosine = np.cos(2.0 * math.pi * i / texels)
        # A B-spline through the texels' values attenuates amplitudes, bilinear interpolation the mean square.
        bilinear = (2.0 + cosine) / 3.0
        response = {"spline": bilinear**2, "bilinear": bilinear, "halves": (3.0 + cosine) / 4.0}
        power = response[read] * (np.abs(i) < min(BAND, texels // 2))
        square = np.abs(self.k * self.h0) ** 2 * power[:, None] * power[None, :]
        return self.choppiness(choppiness) ** 2 * float(2.0 * square.sum())

    @property
    def waves(self) -> list[tuple[int, int]]:
        """Row and column indices (iz, ix) of the non-zero waves."""
        rows, columns = np.nonzero(self.h0)
        return list(zip(rows.tolist(), columns.tolist(), strict=True))


def slope_heading(tiles: Sequence[Cascade]) -> tuple[float, float]:
    """Return (a − b)/(a + b)·(cos 2φ, sin 2φ), a and b the greatest and the least slope variance along any heading.

    φ is the heading of the greatest. The length is below 1; 0 without waves.
    """
    along, total = 0j, 0.0
    for tile in tiles:
        i = np.arange(-BAND, BAND)
        power = np.abs(tile.h0) ** 2
        # (kx + i kz)² is k² at twice its heading.
        step = 2.0 * math.pi / tile.size
        along += complex((power * (step * (i[None, :] + 1j * i[:, None])) ** 2).sum())
        total += 0.5 * tile.mean_square_slope
    return (along.real / total, along.imag / total) if total > 0.0 else (0.0, 0.0)


def slope_limit(root_mean_square: float) -> float:
    """Return the slope that 1 pair of texels in 10 000 exceeds, for a tile of this root mean square slope."""
    return min(5.0 * root_mean_square, 3.0)


def largest_tile(sea: Sea, depth: float | None) -> float:
    """Return the side of the largest tile, m."""
    if sea.wind_speed <= 0.0:
        return SMALLEST_TILE
    k = wavenumber(spectrum.peak_frequency(sea.wind_speed, sea.fetch) ** 2 / GRAVITY, depth)
    return max(float(f"{PEAKS * 2.0 * math.pi / k:.6g}"), SMALLEST_TILE)


@lru_cache(maxsize=32)
def cascades(sea: Sea, depth: float | None) -> tuple[Cascade, ...]:
    """Return the tiles of a sea at a depth (m; absent: deep), the largest first: four, or two for ``gerstner``."""
    sea = sea.model_copy(update={"choppiness": 0.0})
    largest = largest_tile(sea, depth)
    if sea.model == "gerstner":
        return _gerstner(sea, depth, (largest, float(f"{largest / GERSTNER_RATIO:.6g}")))
    tiles = []
    size, low = largest, 0.0
    for number, ratio in enumerate(RATIOS):
        size = float(f"{size / ratio:.6g}")
        tiles.append(_fft(sea, depth, number, size, low))
        low = BAND * 2.0 * math.pi / size
    return tuple(tiles)


def _wavevectors(size: float) -> tuple[NDArray[np.int64], NDArray[np.int64], Floats]:
    i = np.arange(-BAND, BAND)
    ix, iz = np.meshgrid(i, i)
    k: Floats = 2.0 * math.pi / size * np.hypot(ix, iz)
    return ix, iz, k


def _turns(k: Floats, depth: float | None) -> NDArray[np.int64]:
    omega, _, _ = spectrum.dispersion(np.maximum(k, 1e-9), depth)
    return np.round(omega * (LOOP / (2.0 * math.pi))).astype(np.int64)


def _fft(sea: Sea, depth: float | None, number: int, size: float, low: float) -> Cascade:
    ix, iz, k = _wavevectors(size)
    covered = (k >= low) & (k < min(BAND * 2.0 * math.pi / size, 2.0 * math.pi / SHORTEST)) & (k > 0.0)
    h0 = np.zeros(k.shape, np.complex128)
    step = 2.0 * math.pi / size
    if sea.wind_speed > 0.0 and covered.any():
        kx, kz = step * ix[covered].astype(np.float64), step * iz[covered].astype(np.float64)
        energy = spectrum.wave_spectrum(kx, kz, sea, depth) * step * step
        phase = 2.0 * math.pi * chance(sea.seed, number, ix[covered] + BAND, iz[covered] + BAND)
        # Only phases are random: amplitudes are the spectrum's, so that the significant height is exact for every seed.
        h0[covered] = np.sqrt(0.5 * energy) * np.exp(1j * phase)
    return Cascade(size, h0, np.where(covered, _turns(k, depth), 0))


def _gerstner(sea: Sea, depth: float | None, sizes: tuple[float, float]) -> tuple[Cascade, ...]:
    """Return waves on the tiles' integer wavevectors, one per equal step of log k, with that step's energy.

    They alternate between the two tiles, which have no common period, so that no pattern repeats.
    """
    tiles = [np.zeros((2 * BAND, 2 * BAND), np.complex128) for _ in sizes]
    steps = [2.0 * math.pi / size for size in sizes]
    if sea.wind_speed > 0.0:
        edges = np.geomspace(0.6 * PEAKS, 0.98 * BAND, GERSTNER_WAVES + 1) * steps[0]
        around = spectrum.AROUND - math.pi
        share = np.cumsum(spectrum.spreading(around, sea.spread, sea.against)) * spectrum.AROUND_STEP
        for wave in range(GERSTNER_WAVES):
            inner = np.linspace(edges[wave], edges[wave + 1], 33)
            omega, group, shallow = spectrum.dispersion(inner, depth)
            density = spectrum.frequency_spectrum(omega, sea.wind_speed, sea.fetch) * shallow * group
            energy = float(np.trapezoid(density, inner))
            draws = [float(chance(sea.seed, 7 + n, wave + BAND, BAND)) for n in range(3)]
            # Golden-ratio sequence of directions: evenly distributed over the spread for every seed.
            angle = sea.downwind + float(np.interp((draws[0] + 0.618034 * wave) % 1.0, share, around))
            h0, step = tiles[wave % 2], steps[wave % 2]
            middle = math.sqrt(edges[wave] * edges[wave + 1]) / step
            ix, iz = round(middle * math.cos(angle)), round(middle * math.sin(angle))
            if sea.against == 0.0 and ix * math.cos(sea.downwind) + iz * math.sin(sea.downwind) < 0.0:
                continue
            if energy > 0.0 and (ix, iz) != (0, 0):
                h0[iz + BAND, ix + BAND] += math.sqrt(0.5 * energy) * np.exp(2j * math.pi * draws[1])
        drawn = 2.0 * summed(float((np.abs(h0) ** 2).sum()) for h0 in tiles)
        omega = np.geomspace(0.3, 60.0, 4001) * spectrum.peak_frequency(sea.wind_speed, sea.fetch)
        density = spectrum.frequency_spectrum(omega, sea.wind_speed, sea.fetch) * spectrum.shallow_water_factor(
            omega, depth
        )
        total = float(np.trapezoid(density, omega))
        # The waves are scaled to the significant height of the whole spectrum.
        tiles = [h0 * (math.sqrt(total / drawn) if drawn > 0.0 else 0.0) for h0 in tiles]
    turns = (
        np.where(h0 != 0.0, _turns(_wavevectors(size)[2], depth), 0) for size, h0 in zip(sizes, tiles, strict=True)
    )
    return tuple(map(Cascade, sizes, tiles, turns))
