"""``quality=auto``: the most exact quality predicted to fit the time budget, from measurements on this server."""

from collections.abc import Mapping
from dataclasses import dataclass

from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Subject
from seafoam.accuracy.timing import choose
from seafoam.api.context import Context
from seafoam.api.http.parameters import TierOrAuto, quality_of
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotMeasuredError
from seafoam.api.jobs.sweeps import retry_seconds
from seafoam.quality import Quality


@dataclass(frozen=True, slots=True)
class RequestedQuality:
    """The requested quality of a frame. ``parameter``: it came from the query, else from the body."""

    quality: TierOrAuto | Quality
    budget_ms: float | None
    width: int
    height: int
    parameter: bool

    def refused(self, detail: str) -> BadRequestError:
        """Return the error of a budget that is missing or not allowed."""
        return BadRequestError(
            FieldProblem(
                pointer=None if self.parameter else "/budget_ms",
                parameter="budget_ms" if self.parameter else None,
                detail=f"budget_ms: {detail}",
            )
        )


async def choose_quality(
    asked: RequestedQuality, subject: Subject, context: Context
) -> tuple[Quality, Mapping[str, str]]:
    """Return the quality to render with, and headers that explain an automatic choice.

    The prediction holds for the subject's own camera and time, which can differ from the frame's. Raises
    :class:`NotMeasuredError` while the subject is being measured; the first call starts the measurement.
    """
    if asked.quality != "auto":
        if asked.budget_ms is not None:
            raise asked.refused("allowed only with quality auto")
        return quality_of(asked.quality), {}
    if asked.budget_ms is None:
        raise asked.refused("quality auto requires budget_ms, the frame time allowed in milliseconds")
    limits = context.settings.frame_limits
    limits.check(asked.width, asked.height, 1)
    sweep = await context.measured(subject)
    if isinstance(sweep, Running):
        what = f"preset {subject.preset}" if subject.preset else "this scene"
        state = "is queued for measurement" if sweep.status == "queued" else f"is {100 * sweep.progress:.0f} % measured"
        detail = f"cost of accuracy: {what} {state}; retry later, or name a tier"
        raise NotMeasuredError(detail, retry_seconds(sweep))
    choice = choose(
        sweep,
        asked.width,
        asked.height,
        asked.budget_ms,
        lambda q: limits.allows(asked.width, asked.height, q.samples_drawn),
    )
    return choice.point.quality, {"Seafoam-Quality": choice.point.id, "Seafoam-Quality-Why": choice.why}
