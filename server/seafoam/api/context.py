"""What the handlers of one app share."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends, Request

from seafoam.accuracy.station import Station
from seafoam.api.metrics import Metrics
from seafoam.api.settings import Settings
from seafoam.api.workshop import Workshop
from seafoam.render.service.pool import RenderPool


@dataclass(frozen=True, slots=True)
class Context:
    """Settings, render pool, metrics, threads for the work of the web process, and the station that measures.

    ``plans`` and ``masks`` are apart so that a mask of some seconds does not hold up plans.
    """

    settings: Settings
    pool: RenderPool
    metrics: Metrics
    plans: Workshop
    masks: Workshop
    station: Station


def _context(request: Request) -> Context:
    context: Context = request.app.state.context
    return context


InContext = Annotated[Context, Depends(_context)]
