"""State that the request handlers of an application share."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends, Request

from seafoam.accuracy.sweep_service import SweepService
from seafoam.api.metrics import Metrics
from seafoam.api.settings import Settings
from seafoam.api.threads import ThreadPool
from seafoam.render.service.pool import RenderPool
from seafoam.sequences.service import SequenceService


@dataclass(frozen=True, slots=True)
class Context:
    """Settings, render pool, metrics, thread pools of the web process, services for sweeps and for sequences.

    ``plans`` and ``masks`` are separate, so that generating a mask, which takes seconds, does not delay plans.
    """

    settings: Settings
    pool: RenderPool
    metrics: Metrics
    plans: ThreadPool
    masks: ThreadPool
    sweeps: SweepService
    sequences: SequenceService


def _context(request: Request) -> Context:
    context: Context = request.app.state.context
    return context


InContext = Annotated[Context, Depends(_context)]
