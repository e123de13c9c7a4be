"""State that the request handlers of an application share."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from fastapi import Depends, Request

from seafoam.accuracy.sweep_service import SweepService
from seafoam.api.frames.plans import PlanIndex
from seafoam.api.frames.request_cache import RequestCache
from seafoam.api.frames.streams import Streams
from seafoam.api.http.thread_pool import ThreadPool
from seafoam.api.settings import Settings
from seafoam.api.watch.metrics import Metrics
from seafoam.render.service.frame_cache import FrameCache
from seafoam.render.service.pool import RenderPool
from seafoam.sequences.service import SequenceService

if TYPE_CHECKING:
    from seafoam.api.watch.traces import Traces


@dataclass(frozen=True, slots=True)
class Context:
    """Settings, render pool, metrics, thread pools of the web process, services for sweeps and sequences, streams.

    ``frames`` gives the pool's frames, and those that it has drawn before; ``plan_index``: the plans that have
    addresses; ``request_cache``: what earlier requests asked for; ``traces``: where spans go, if anywhere.
    ``plans`` and ``masks`` are separate, so that generating a mask, which takes seconds, does not delay plans;
    ``slow_masks``: those that take minutes.
    """

    settings: Settings
    pool: RenderPool
    frames: FrameCache
    plan_index: PlanIndex
    request_cache: RequestCache
    metrics: Metrics
    traces: "Traces | None"
    plans: ThreadPool
    masks: ThreadPool
    slow_masks: ThreadPool
    sweeps: SweepService
    sequences: SequenceService
    streams: Streams


def _context(request: Request) -> Context:
    context: Context = request.app.state.context
    return context


InContext = Annotated[Context, Depends(_context)]
