"""The open sea: its wave spectrum, and the random components that both the effect and the reference use.

JONSWAP (Hasselmann et al. 1973) with the fully developed limits of Pierson and Moskowitz (1964), the finite-depth
factor of Kitaigorodskii et al. (1975; TMA, Bouws et al. 1985), directional spreading cos^2s(θ/2) (Longuet-Higgins
et al. 1963). docs/formulae.md, section 2.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.scene.chance import chance
from seafoam.scene.models import GRAVITY, FoldSaturation, Sea

BAND = 64
"""Bound of a tile's wavenumbers, in waves along its side."""
LOOP = 2048.0
"""Period of the sea, s: every angular frequency is an integer multiple of 2π/LOOP."""
RATIOS = (1.0, 5.23, 4.87, 4.61)
"""Ratio of the sides of successive tiles; no ratio of small integers, so that the tiles never align again."""
PEAKS = 8.0
"""Waves of the spectral peak along the largest tile."""
SMALLEST_TILE = 24.0
"""Minimum side of the largest tile, m."""
SHORTEST = 0.1
"""Shortest wavelength, m; ripples (``Chop``) represent shorter waves."""
RAISED = 2
"""Number of tiles, the largest first, that displace the surface; smaller ones only tilt its normal."""
GERSTNER_WAVES = 48
GERSTNER_RATIO = 1.618
"""Ratio of the sides of the two tiles of Gerstner waves."""
CREST = 4.5
"""Heights are clamped to this many standard deviations: one point in 150 000 of a Gaussian sea is higher."""
TILT = 0.24
"""Maximum of a tile's root mean square slope times choppiness: one point in 60 000 of a Gaussian sea folds then."""
GAMMA = 3.3
"""Peak enhancement of JONSWAP."""
LEAST_JACOBIAN = 0.3
"""Lower bound of the Jacobian in divisions: at a fold the sea turns over, which a height field cannot."""
AGE_STEPS = 8
"""Number of earlier times at which folds are evaluated."""
AGE_STEP = 0.35
"""Interval between them, s."""

OLD_STEPS = 16
"""Number of still earlier times at which folds of the largest tile are evaluated, if foam lasts."""
OLD_STEP = 0.5
"""Interval between them, s."""
OLD_TEXELS = 2 * BAND
"""Texels along that tile then: the minimum that resolves its waves."""

Floats = NDArray[np.float64]


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
        i = np.arange(-BAND, BAND)
        result: Floats = 2.0 * math.pi / self.size * np.hypot(i[None, :], i[:, None])
        return result

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
        """Heights are clamped to ± this, m."""
        return min(CREST * math.sqrt(self.variance), 2.0 * float(np.abs(self.h0).sum()))

    @property
    def steepest(self) -> float:
        """Upper bound of the slope of the drawn height."""
        return slope_limit(math.sqrt(self.mean_square_slope))

    def grain(self, texels: int) -> float:
        """How far the tile's height, read bilinearly between ``texels``² texels, stands over what its slopes and its
        curvature say, m. Its unit is second derivative times texel²; the factor is measured, with a tenth to spare."""
        deviation = math.sqrt(float(2.0 * (np.abs(self.k**2 * self.h0) ** 2).sum()))
        return 0.085 * deviation * (self.size / texels) ** 2

    def choppiness(self, wanted: float) -> float:
        """Return ``wanted``, reduced if the tile would fold too often."""
        slope = math.sqrt(self.mean_square_slope)
        return wanted if wanted * slope <= TILT else TILT / slope

    def fold_variance(self, wanted: float, texels: int, read: Literal["spline", "bilinear", "halves"]) -> float:
        """Mean square of the fold F = λ div D on ``texels``² texels, read by B-spline, bilinearly or at halves alone.

        ``halves``: bilinearly at the texels and half way between them.
        """
        i = np.arange(-BAND, BAND)
        cosine = np.cos(2.0 * math.pi * i / texels)
        # The spline of the texels themselves weakens a wave by its response; bilinear ones its mean square.
        response = {
            "spline": ((2.0 + cosine) / 3.0) ** 2,
            "bilinear": (2.0 + cosine) / 3.0,
            "halves": (3.0 + cosine) / 4.0,
        }
        power = response[read] * (np.abs(i) < min(BAND, texels // 2))
        square = np.abs(self.k * self.h0) ** 2 * power[:, None] * power[None, :]
        return self.choppiness(wanted) ** 2 * float(2.0 * square.sum())

    @property
    def waves(self) -> list[tuple[int, int]]:
        """Row and column indices (iz, ix) of the non-zero waves."""
        rows, columns = np.nonzero(self.h0)
        return list(zip(rows.tolist(), columns.tolist(), strict=True))


@dataclass(frozen=True)
class Fold:
    """Foam of a sea: f = min(Σ_j a_j clamp((threshold − F_j)/width, 0, 1), 1), a_j the fraction left after j steps."""

    now: tuple[float, float]
    """Threshold and width for the present fold."""
    earlier: tuple[float, float]
    """The same for earlier folds."""
    shares: tuple[float, ...]
    variance: tuple[float, float]
    """Mean square of the drawn fold, now and earlier."""
    clamped: float
    """Fraction of the sum that is left after sums are clamped to 1."""
    old: tuple[float, float]
    """Threshold and width for the early folds of the largest tile."""
    old_shares: tuple[float, ...]
    """Fractions left of these folds, at :func:`old_times`; empty if foam does not last."""


def old_times(steps: int, step: float) -> list[float]:
    """Return how long ago they were, s, after ``steps`` of ``step`` seconds."""
    return [steps * step + (j + 1) * OLD_STEP for j in range(OLD_STEPS)]


def whitecaps(wind: float) -> float:
    """Return the whitecap coverage W = 3.84·10⁻⁶ U^3.41 (Monahan and O'Muircheartaigh 1980), at most 0.6."""
    return min(3.84e-6 * math.pow(wind, 3.41), 0.6)


CLAMPED: tuple[tuple[float, float], ...] = (
    (5.0, 1.466),
    (7.5, 1.429),
    (10.0, 1.4),
    (12.5, 1.463),
    (15.0, 1.478),
    (17.5, 1.512),
    (20.0, 1.511),
)
"""Wind speed (m/s), and wanted over drawn coverage, which corrects the closed form where foam of several times exceeds
1. Generated by ``docs/make_whitecaps.py --derive``."""
LASTING_CLAMPED: tuple[tuple[float, float], ...] = (
    (5.0, 1.331),
    (7.5, 1.207),
    (10.0, 1.212),
    (12.5, 1.238),
    (15.0, 1.241),
    (17.5, 1.284),
    (20.0, 1.294),
)
"""The same if foam lasts."""


def fold(sea: Sea, foam: FoldSaturation, depth: float | None, steps: int, step: float, texels: int) -> Fold | None:
    """Return the fold thresholds that give a sea its whitecap coverage, on tiles of ``texels``²; None without foam.

    In material coordinates the fold of a Gaussian sea is normal about 0; on the surface, which is compressed where it
    folds, about its variance. So mean foam has a closed form, which is solved for the threshold in standard
    deviations; ``CLAMPED`` corrects what the form leaves out.
    """
    raised = cascades(sea, depth)[:RAISED]
    now = sum(c.fold_variance(sea.choppiness, texels, "spline") for c in raised)
    earlier = sum(c.fold_variance(sea.choppiness, texels // 2, "bilinear") for c in raised)
    wanted = foam.coverage * whitecaps(sea.wind)
    if min(now, earlier) < 1e-8 or wanted <= 0.0:
        return None
    shares = tuple(math.exp(-j * step / foam.decay) for j in range(steps + 1))
    lasting = foam.lasting and steps > 0
    long_ago = raised[0].fold_variance(sea.choppiness, OLD_TEXELS, "halves")
    old_shares: tuple[float, ...] = ()
    if lasting:
        times = old_times(steps, step)
        # Foam that a second adds is the same whatever the steps; the last quarter of the window fades.
        window = times[-1] + OLD_STEP
        ends = (min(max((4.0 * t / window - 3.0), 0.0), 1.0) for t in times)
        old_shares = tuple(
            OLD_STEP / step * math.exp(-t / foam.decay) * (1.0 - e * e * (3.0 - 2.0 * e))
            for t, e in zip(times, ends, strict=True)
        )
    factors = LASTING_CLAMPED if lasting else CLAMPED
    lost = float(np.interp(sea.wind, [entry[0] for entry in factors], [entry[1] for entry in factors]))
    wanted *= lost
    total = sum(shares) + sum(old_shares)

    def mean(z: float) -> float:
        return total * (_above(-z) - _above(-z - foam.softness)) / foam.softness

    low, high = -6.0, 12.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean(middle) > wanted else (low, middle)
    z, soft = 0.5 * (low + high), foam.softness
    deviations = math.sqrt(now), math.sqrt(earlier), math.sqrt(long_ago)
    return Fold(
        (now - z * deviations[0], soft * deviations[0]),
        (-z * deviations[1], soft * deviations[1]),
        shares,
        (now, earlier),
        1.0 / lost,
        (-z * deviations[2], soft * deviations[2]),
        old_shares,
    )


def _above(t: float) -> float:
    """Mean of max(t − n, 0) over a standard normal n."""
    density = math.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)
    return density + t * 0.5 * math.erfc(-t / math.sqrt(2.0))


def slope_limit(root_mean_square: float) -> float:
    """Return the slope that one in ten thousand texel pairs of a tile of this root mean square slope exceeds."""
    return min(5.0 * root_mean_square, 3.0)


def peak_frequency(wind: float, fetch: float) -> float:
    """Return the peak angular frequency of the spectrum, rad/s; wind in m/s above 0, fetch in m."""
    growing = 22.0 * math.pow(GRAVITY * GRAVITY / (wind * fetch), 1.0 / 3.0)
    return max(growing, 0.855 * GRAVITY / wind)


def frequency_spectrum(omega: Floats, wind: float, fetch: float) -> Floats:
    """Return JONSWAP S(ω) in deep water, m²·s/rad, at ω > 0 rad/s; 0 without wind."""
    if wind <= 0.0:
        return np.zeros_like(omega)
    peak = peak_frequency(wind, fetch)
    alpha = max(0.076 * (wind * wind / (fetch * GRAVITY)) ** 0.22, 0.0081)
    ratio = omega / peak
    width = np.where(ratio <= 1.0, 0.07, 0.09)
    enhanced = GAMMA ** np.exp(-((ratio - 1.0) ** 2) / (2.0 * width * width))
    # Under a third of the peak exp underflows anyway, and the powers of a tiny ratio must not overflow.
    held = np.maximum(ratio, 0.05)
    result: Floats = alpha * GRAVITY**2 * (held * peak) ** -5.0 * np.exp(-1.25 * held**-4.0) * enhanced
    return np.where(ratio < 0.05, 0.0, result)


def dispersion(k: Floats, depth: float | None) -> tuple[Floats, Floats, Floats]:
    """Return ω (rad/s), dω/dk (m/s) and the depth factor of the spectrum, at k > 0 rad/m; depth in m, absent: deep."""
    if depth is None:
        omega = np.sqrt(GRAVITY * k)
        return omega, 0.5 * omega / k, np.ones_like(k)
    kd = np.minimum(k * depth, 30.0)
    tanh = np.tanh(kd)
    omega = np.sqrt(GRAVITY * k * tanh)
    share = 0.5 * (1.0 + 2.0 * kd / np.sinh(2.0 * kd))
    return omega, share * omega / k, tanh * tanh / (2.0 * share)


def spreading(angle: Floats, exponent: float, against: float) -> Floats:
    """Return the energy fraction per radian at an angle to the wind (rad); ``against`` weights waves against it."""

    def shape(angles: Floats) -> Floats:
        weight = np.where(np.cos(angles) < 0.0, against, 1.0)
        result: Floats = weight * np.abs(np.cos(0.5 * angles)) ** (2.0 * exponent)
        return result

    around: Floats = (np.arange(720, dtype=np.float64) + 0.5) * (2.0 * math.pi / 720)
    result: Floats = shape(angle) / float(shape(around).sum() * (2.0 * math.pi / 720))
    return result


def largest_tile(sea: Sea, depth: float | None) -> float:
    """Return the side of the largest tile, m."""
    if sea.wind <= 0.0:
        return SMALLEST_TILE
    omega = peak_frequency(sea.wind, sea.fetch)
    k = omega * omega / GRAVITY
    if depth is not None:
        # k tanh(kd) = ω²/g by Newton from Eckart's estimate; a tile's side needs no more than some digits.
        deep = k
        k = deep / math.sqrt(math.tanh(min(deep * depth, 30.0)))
        for _ in range(20):
            tanh = math.tanh(min(k * depth, 30.0))
            k -= (k * tanh - deep) / (tanh + k * depth * (1.0 - tanh * tanh))
    return max(float(f"{PEAKS * 2.0 * math.pi / k:.6g}"), SMALLEST_TILE)


def wave_spectrum(kx: Floats, kz: Floats, sea: Sea, depth: float | None) -> Floats:
    """Return Ψ(k), m⁴: its integral over the plane of wavevectors (rad/m, not 0) is the mean square height."""
    k = np.hypot(kx, kz)
    omega, group, shallow = dispersion(k, depth)
    angle = np.arctan2(kz, kx) - sea.wind_direction
    energy = frequency_spectrum(omega, sea.wind, sea.fetch) * shallow * group / k
    result: Floats = energy * spreading(angle, sea.spread, sea.against)
    return result


@lru_cache(maxsize=32)
def cascades(sea: Sea, depth: float | None) -> tuple[Cascade, ...]:
    """Return the tiles of a sea at a depth (m; absent: deep), the largest first: four, or two for ``gerstner``."""
    sea = sea.model_copy(update={"choppiness": 0.0})
    largest = largest_tile(sea, depth)
    if sea.model == "gerstner":
        return _gerstner(sea, depth, (largest, float(f"{largest / GERSTNER_RATIO:.6g}")))
    made = []
    size, low = largest, 0.0
    for number, ratio in enumerate(RATIOS):
        size = float(f"{size / ratio:.6g}")
        made.append(_fft(sea, depth, number, size, low))
        low = BAND * 2.0 * math.pi / size
    return tuple(made)


def _wavevectors(size: float) -> tuple[NDArray[np.int64], NDArray[np.int64], Floats]:
    i = np.arange(-BAND, BAND)
    ix, iz = np.meshgrid(i, i)
    k: Floats = 2.0 * math.pi / size * np.hypot(ix, iz)
    return ix, iz, k


def _turns(k: Floats, depth: float | None) -> NDArray[np.int64]:
    omega, _, _ = dispersion(np.maximum(k, 1e-9), depth)
    result: NDArray[np.int64] = np.round(omega * (LOOP / (2.0 * math.pi))).astype(np.int64)
    return result


def _shallow(omega: Floats, depth: float | None) -> Floats:
    """Return the depth factor by frequency."""
    if depth is None:
        return np.ones_like(omega)
    k = np.geomspace(1e-7, 1e3, 20001)
    of_k, _, factor = dispersion(k, depth)
    result: Floats = np.interp(omega, of_k, factor)
    return result


def _fft(sea: Sea, depth: float | None, number: int, size: float, low: float) -> Cascade:
    ix, iz, k = _wavevectors(size)
    there = (k >= low) & (k < min(BAND * 2.0 * math.pi / size, 2.0 * math.pi / SHORTEST)) & (k > 0.0)
    h0 = np.zeros(k.shape, np.complex128)
    step = 2.0 * math.pi / size
    if sea.wind > 0.0 and there.any():
        kx, kz = step * ix[there].astype(np.float64), step * iz[there].astype(np.float64)
        energy = wave_spectrum(kx, kz, sea, depth) * step * step
        phase = 2.0 * math.pi * chance(sea.seed, number, ix[there] + BAND, iz[there] + BAND)
        # Phases are random and amplitudes are the spectrum's, so that every seed has the sea's exact height.
        h0[there] = np.sqrt(0.5 * energy) * np.exp(1j * phase)
    return Cascade(size, h0, np.where(there, _turns(k, depth), 0))


def _gerstner(sea: Sea, depth: float | None, sizes: tuple[float, float]) -> tuple[Cascade, Cascade]:
    """Return waves on the tiles' integer wavevectors, one per equal step of log k, with that step's energy.

    They lie on the two tiles in turn: the tiles have no common period, so no pattern of waves repeats.
    """
    tiles = [np.zeros((2 * BAND, 2 * BAND), np.complex128) for _ in sizes]
    steps = [2.0 * math.pi / size for size in sizes]
    if sea.wind > 0.0:
        edges = np.geomspace(0.6 * PEAKS, 0.98 * BAND, GERSTNER_WAVES + 1) * steps[0]
        around: Floats = (np.arange(720, dtype=np.float64) + 0.5) * (2.0 * math.pi / 720) - math.pi
        share = np.cumsum(spreading(around, sea.spread, sea.against)) * (2.0 * math.pi / 720)
        for wave in range(GERSTNER_WAVES):
            inner = np.linspace(edges[wave], edges[wave + 1], 33)
            omega, group, shallow = dispersion(inner, depth)
            density = frequency_spectrum(omega, sea.wind, sea.fetch) * shallow * group
            energy = float(np.trapezoid(density, inner))
            draws = [float(chance(sea.seed, 7 + n, wave + BAND, BAND)) for n in range(3)]
            # Headings by the golden ratio: even over the spread whatever the seed.
            angle = sea.wind_direction + float(np.interp((draws[0] + 0.618034 * wave) % 1.0, share, around))
            h0, step = tiles[wave % 2], steps[wave % 2]
            middle = math.sqrt(edges[wave] * edges[wave + 1]) / step
            ix, iz = round(middle * math.cos(angle)), round(middle * math.sin(angle))
            if sea.against == 0.0 and ix * math.cos(sea.wind_direction) + iz * math.sin(sea.wind_direction) < 0.0:
                continue
            if energy > 0.0 and (ix, iz) != (0, 0):
                h0[iz + BAND, ix + BAND] += math.sqrt(0.5 * energy) * np.exp(2j * math.pi * draws[1])
        drawn = 2.0 * sum(float((np.abs(h0) ** 2).sum()) for h0 in tiles)
        omega = np.geomspace(0.3, 60.0, 4001) * peak_frequency(sea.wind, sea.fetch)
        total = float(np.trapezoid(frequency_spectrum(omega, sea.wind, sea.fetch) * _shallow(omega, depth), omega))
        # The few waves have the height of all.
        tiles = [h0 * (math.sqrt(total / drawn) if drawn > 0.0 else 0.0) for h0 in tiles]
    first, second = (
        Cascade(size, h0, np.where(h0 != 0.0, _turns(_wavevectors(size)[2], depth), 0))
        for size, h0 in zip(sizes, tiles, strict=True)
    )
    return first, second
