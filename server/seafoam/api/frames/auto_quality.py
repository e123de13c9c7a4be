"""``quality=auto``: the most exact quality predicted to fit the time budget, from measurements on this server."""

from collections.abc import Mapping
from dataclasses import replace

from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Subject
from seafoam.accuracy.timing import choose
from seafoam.api.context import Context
from seafoam.api.http.parameters import FrameParameters, FrameRequest
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotMeasuredError
from seafoam.api.jobs import retry_seconds
from seafoam.render.service.jobs import FrameJob


async def with_quality(
    job: FrameJob, asked: FrameParameters | FrameRequest, subject: Subject, context: Context
) -> tuple[FrameJob, Mapping[str, str]]:
    """Return a job with the quality that was asked for, and headers that explain an automatic choice.

    The prediction holds for the subject's own camera and time, which can differ from the frame's. Raises
    :class:`NotMeasuredError` while the subject is being measured; the first call starts the measurement.
    """
    if asked.quality != "auto":
        if asked.budget_ms is not None:
            raise _refused(asked, "allowed only with quality auto")
        return job, {}
    # A scene that cannot be planned is refused before it is measured.
    await context.compiled(job.scene, job.quality)
    if asked.budget_ms is None:
        raise _refused(asked, "quality auto requires budget_ms, the frame time allowed in milliseconds")
    limits = context.settings.frame_limits
    size = job.width, job.height
    limits.check(*size, 1)
    sweep = await context.measured(subject)
    if isinstance(sweep, Running):
        what = f"preset {subject.preset}" if subject.preset else "this scene"
        state = "is queued for measurement" if sweep.status == "queued" else f"is {100 * sweep.progress:.0f} % measured"
        detail = f"cost of accuracy: {what} {state}; retry later, or name a tier"
        raise NotMeasuredError(detail, retry_seconds(sweep))
    choice = choose(sweep, *size, asked.budget_ms, lambda quality: limits.allows(*size, quality.samples_drawn))
    headers = {"Seafoam-Quality": choice.point.id, "Seafoam-Quality-Why": choice.why}
    return replace(job, quality=choice.point.quality), headers


def _refused(asked: FrameParameters | FrameRequest, detail: str) -> BadRequestError:
    """Return the error of a budget that is missing or not allowed."""
    detail = f"budget_ms: {detail}"
    if isinstance(asked, FrameParameters):
        return BadRequestError(FieldProblem(parameter="budget_ms", detail=detail))
    return BadRequestError(FieldProblem(pointer="/budget_ms", detail=detail))
