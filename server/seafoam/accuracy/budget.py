"""Selects the quality for a time budget."""

from collections.abc import Callable
from dataclasses import dataclass

from seafoam.accuracy.model import MeasuredPoint, Sweep
from seafoam.quality import Quality


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
    else:
        at, point = min(predicted, key=lambda pair: pair[0])
    size = f"{width} x {height}"
    if fitting:
        said = f"least error of {len(fitting)} within budget, of {len(predicted)} measured"
    else:
        said = f"none within budget, fastest of {len(predicted)} measured"
    why = (
        f"{said}; predicted {at:.3g} ms of {budget_ms:g} ms at {size}; RMSE {point.error.rmse:.2f}/255, "
        f"FLIP {point.error.flip:.3f}"
    )
    return Choice(point, at, bool(fitting), why)
