"""Measured times: their statistics, the front of time against error, and the best quality within a time budget."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median, quantiles

from seafoam.accuracy.model import MeasuredPoint, Sweep, TimeModel, TimeSpread
from seafoam.quality import Quality

TOLD = 1.02
"""Ratio below which two errors are reported as equal."""
FASTER = 1.1
"""Ratio below which two times of a round are reported as equal: of forty plans with the same cost, some differ by as
much on a shared machine."""


def spread_of(values: list[float]) -> TimeSpread:
    """Median and quartiles of the times of all rounds, ms."""
    low, middle, high = quantiles(values, n=4, method="inclusive")
    return TimeSpread(median_ms=middle, low_ms=low, high_ms=high, rounds_ms=tuple(round(value, 4) for value in values))


def time_model(large_ms: float, large: tuple[int, int], small_ms: float, small: tuple[int, int]) -> TimeModel:
    """The linear model through the times of two frame sizes (pixels): a constant, at least 0, and a time per pixel."""
    pixels, few = large[0] * large[1], small[0] * small[1]
    if pixels == few:
        return TimeModel(fixed_ms=0.0, ns_per_pixel=1e6 * large_ms / pixels)
    slope = max(0.0, (large_ms - small_ms) / (pixels - few))
    return TimeModel(fixed_ms=max(0.0, large_ms - slope * pixels), ns_per_pixel=1e6 * slope)


def median_model(models: list[TimeModel], size: tuple[int, int]) -> TimeModel:
    """The median constant, with a time per pixel that gives the median time at ``size``."""
    fixed = median(model.fixed_ms for model in models)
    left = max(0.0, median(model.at(*size) for model in models) - fixed)
    return TimeModel(fixed_ms=fixed, ns_per_pixel=1e6 * left / (size[0] * size[1]))


def front(found: Mapping[str, tuple[float, float]]) -> tuple[str, ...]:
    """Of (time, error) by name, return the names on the Pareto front, fastest first."""
    best: list[str] = []
    least = float("inf")
    for name, (_, error) in sorted(found.items(), key=lambda item: item[1]):
        if error < least:
            best.append(name)
            least = error
    return tuple(best)


def beating(found: Mapping[str, tuple[Sequence[float], float]]) -> dict[str, tuple[str, ...]]:
    """Of (times by round, error) by name, return the points with no greater error that are faster beyond the noise.

    Times of a round are compared with each other: the third quartile of their ratios is below 1 / :data:`FASTER`. The
    most exact first.
    """
    by_error = sorted(found, key=lambda name: found[name][1])

    def faster(other: str, name: str) -> bool:
        ratios = [a / b for a, b in zip(found[other][0], found[name][0], strict=True)]
        return quantiles(ratios, n=4, method="inclusive")[2] < 1.0 / FASTER

    return {
        name: tuple(other for other in by_error if found[other][1] <= error and other != name and faster(other, name))
        for name, (_, error) in found.items()
    }


@dataclass(frozen=True)
class Comparison:
    """Compares two points of the same rounds. ``measurable``: whether both quartiles of the ratios are on one side of
    1."""

    added_ms: float
    measurable: bool
    words: str


def compare(before: list[float], after: list[float], error_before: float, error_after: float) -> Comparison:
    ratios = [b / a for a, b in zip(before, after, strict=True)]
    low, _, high = quantiles(ratios, n=4, method="inclusive")
    measurable = low > 1.0 or high < 1.0
    factor = median(ratios)
    # A thousandth of a level is no error at all.
    error_factor = (error_before + 1e-3) / (error_after + 1e-3)
    slower, multiple = measurable and factor > 1.0, f"{factor:.0f}" if factor >= 9.95 else f"{factor:.2g}"
    time_words = f"{multiple}× the time" if measurable else "no measurable difference in time"
    if error_factor >= TOLD:
        words = f"{time_words} {'buys' if slower else 'and'} {_times(error_factor)} less error"
    elif error_factor <= 1.0 / TOLD:
        words = f"{time_words} and {_times(1.0 / error_factor)} more error"
    else:
        words = f"{time_words} {'buys nothing' if slower else 'and the same error'}"
    added = median(b - a for a, b in zip(before, after, strict=True))
    return Comparison(added, measurable, words)


def _times(factor: float) -> str:
    return f"{factor:.0f}×" if factor >= 9.95 else f"{factor:.1f}×" if factor >= 1.1 else f"{factor:.2f}×"


def told(best: list[MeasuredPoint]) -> list[MeasuredPoint]:
    """Return the points of the front whose error is less than that of the one before by what is worth telling."""
    worth = best[:1]
    for point in best[1:]:
        if point.error.rmse * TOLD <= worth[-1].error.rmse:
            worth.append(point)
    return worth


def sentences(best: list[MeasuredPoint], rounds: Mapping[str, list[float]]) -> tuple[str, ...]:
    """Describe the front, in steps that are worth a sentence."""
    return tuple(
        f"{before.id} → {after.id}: "
        + compare(rounds[before.id], rounds[after.id], before.error.rmse, after.error.rmse).words
        for before, after in pairwise(told(best))
    )


@dataclass(frozen=True)
class Choice:
    """The selected point, and why. ``fits``: its predicted time is within the budget."""

    point: MeasuredPoint
    predicted_ms: float
    fits: bool
    why: str


def choose(
    sweep: Sweep, width: int, height: int, budget_ms: float, allowed: Callable[[Quality], bool] = lambda quality: True
) -> Choice:
    """Return the point with the least RMSE whose predicted time at this size is within the budget.

    The prediction is each point's :class:`~seafoam.accuracy.model.TimeModel`. If none is within budget, the fastest.
    ``allowed`` tells which qualities can be rendered at this size; raises ``ValueError`` if none can.
    """
    predicted = [(point.model.at(width, height), point) for point in sweep.points if allowed(point.quality)]
    if not predicted:
        raise ValueError(f"no measured quality can be rendered at {width} x {height}")
    fitting = [pair for pair in predicted if pair[0] <= budget_ms]
    if fitting:
        at, point = min(fitting, key=lambda pair: (pair[1].error.rmse, pair[0]))
        said = f"least error of {len(fitting)} within budget, of {len(predicted)} measured"
    else:
        at, point = min(predicted, key=lambda pair: pair[0])
        said = f"none within budget, fastest of {len(predicted)} measured"
    why = (
        f"{said}; predicted {at:.3g} ms of {budget_ms:g} ms at {width} x {height}; RMSE {point.error.rmse:.2f}/255, "
        f"FLIP {point.error.flip:.3f}"
    )
    return Choice(point, at, bool(fitting), why)
