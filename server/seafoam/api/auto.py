"""``quality=auto``: the most exact quality that is predicted to be drawn in time, from what was measured here."""

from collections.abc import Mapping
from dataclasses import dataclass

from seafoam.accuracy.budget import choose
from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Subject
from seafoam.api.context import Context
from seafoam.api.errors import BadRequestError, FieldProblem, NotMeasuredError
from seafoam.api.parameters import TierOrAuto, knobs_of
from seafoam.api.routers.accuracy import measured, retry_seconds
from seafoam.quality import Quality


@dataclass(frozen=True, slots=True)
class Asked:
    """The quality of a frame as it was asked for. ``parameter``: in the query, else in a body."""

    quality: TierOrAuto | Quality
    budget_ms: float | None
    width: int
    height: int
    parameter: bool

    def _refused(self, detail: str) -> BadRequestError:
        return BadRequestError(
            FieldProblem(
                pointer=None if self.parameter else "/budget_ms",
                parameter="budget_ms" if self.parameter else None,
                detail=f"budget_ms: {detail}",
            )
        )

    def budget(self) -> float:
        """The budget of auto, ms. Raises :class:`BadRequestError` where there is none."""
        if self.budget_ms is None:
            raise self._refused("quality auto requires budget_ms, the frame time allowed in milliseconds")
        return self.budget_ms

    def no_budget(self) -> None:
        """Raises :class:`BadRequestError` where a budget was given."""
        if self.budget_ms is not None:
            raise self._refused("allowed only with quality auto")


async def resolve(asked: Asked, subject: Subject, context: Context) -> tuple[Quality, Mapping[str, str]]:
    """The quality to draw with, and the headers that say why; none where it was named.

    Auto goes by the subject's own camera and time, which the frame's may differ from. Raises
    :class:`NotMeasuredError` while the subject is being measured, which the first call starts.
    """
    if asked.quality != "auto":
        asked.no_budget()
        return knobs_of(asked.quality), {}
    budget = asked.budget()
    limits = context.settings.frame_limits
    limits.check(asked.width, asked.height, 1)
    found = await measured(context, subject)
    if isinstance(found, Running):
        what = f"preset {subject.preset}" if subject.preset else "this scene"
        state = "is queued for measurement" if found.status == "queued" else f"is {100 * found.progress:.0f} % measured"
        detail = f"cost of accuracy: {what} {state}; retry later, or name a tier"
        raise NotMeasuredError(detail, retry_seconds(found))
    choice = choose(
        found, asked.width, asked.height, budget, lambda q: limits.allows(asked.width, asked.height, q.samples_drawn)
    )
    return choice.point.quality, {"Seafoam-Quality": choice.point.id, "Seafoam-Quality-Why": choice.why}
