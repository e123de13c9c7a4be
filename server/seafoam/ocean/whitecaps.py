"""Whitecaps of a wind sea: thresholds of the fold that cover as much as the wind makes. docs/formulae.md, section 4."""

import math
from dataclasses import dataclass

import numpy as np

from seafoam.ocean.cascades import BAND, RAISED, cascades
from seafoam.scene.models import FoldSaturation, Sea

AGE_STEPS = 8
"""Earlier times at which folds are looked for."""

AGE_STEP = 0.35
"""Seconds between them."""

OLD_STEPS = 16
"""Still earlier times at which folds of the largest tile alone are looked for, where foam lasts."""

OLD_STEP = 0.5
"""Seconds between them."""

OLD_TEXELS = 2 * BAND
"""Texels along that tile then: as few as hold its waves."""


@dataclass(frozen=True)
class Fold:
    """Foam of a sea: f = min(Σ_j a_j clamp((threshold − F_j)/width, 0, 1), 1), a_j the share left after j steps."""

    now: tuple[float, float]
    """Threshold and width for the fold of the moment."""
    earlier: tuple[float, float]
    """The same for earlier ones."""
    shares: tuple[float, ...]
    variance: tuple[float, float]
    """Mean square of the fold as it is drawn, now and earlier."""
    clamped: float
    """Share of the sum that is left where sums are held at 1."""
    old: tuple[float, float]
    """Threshold and width for the folds of the largest tile long ago."""
    old_shares: tuple[float, ...]
    """What is left of those, times of :func:`old_times`; empty where foam does not last."""


def old_times(steps: int, step: float) -> list[float]:
    """How long ago they were, s, behind ``steps`` of ``step`` seconds."""
    return [steps * step + (j + 1) * OLD_STEP for j in range(OLD_STEPS)]


def whitecaps(wind: float) -> float:
    """Share of the sea under whitecaps, W = 3.84·10⁻⁶ U^3.41 (Monahan and O'Muircheartaigh 1980), at most 0.6."""
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
"""Wind (m/s), and wanted over drawn coverage: the closed form loses where foam of several times adds up to more than
1. By ``docs/make_whitecaps.py --derive``."""

LASTING_CLAMPED: tuple[tuple[float, float], ...] = (
    (5.0, 1.331),
    (7.5, 1.207),
    (10.0, 1.212),
    (12.5, 1.238),
    (15.0, 1.241),
    (17.5, 1.284),
    (20.0, 1.294),
)
"""The same where foam lasts."""


def fold(sea: Sea, foam: FoldSaturation, depth: float | None, steps: int, step: float, texels: int) -> Fold | None:
    """Thresholds of the fold that give a sea its whitecaps, on tiles of ``texels``²; None where it has none.

    Where water rests, the fold of a Gaussian sea is normal about 0; over the surface, which is pressed together where
    it folds, about its variance. So mean foam has a closed form, which is solved for the threshold in standard
    deviations; what the form leaves out is in ``CLAMPED``.
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
