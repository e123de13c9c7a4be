"""Work beside the event loop: threads for plans and masks; sweeps and sequences on the render pool behind frames."""

import asyncio
import math
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future
from typing import ParamSpec, TypeVar

import anyio
import anyio.to_thread

from seafoam.accuracy.cache import Store
from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Rig, SweepSettings
from seafoam.accuracy.sweep_service import SweepService
from seafoam.accuracy.truth import finished
from seafoam.api.http.problems import BusyError
from seafoam.api.settings import Settings
from seafoam.render.service.errors import DeadlineError, RenderError, RendererUnavailableError, RenderQueueFullError
from seafoam.render.service.jobs import Drawn, FrameJob, MeasureJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.queues import Ticket
from seafoam.sequences.spec import DrawnFrames, SequenceError, Unit

LONGEST_WAIT = 15
"""Maximum delay between requests for a running measurement, s."""
_ATTEMPTS = 10
"""Of a frame whose deadline passes while it waits for visitors' frames."""


def _ready(pool: RenderPool) -> Mapping[str, str]:
    """Return the renderer's ``vendor``, ``renderer`` and ``version``. Raises RendererUnavailableError without one."""
    if pool.state != "ready":
        raise RendererUnavailableError(pool.remedy or "the renderer is not ready")
    return pool.info


def sweep_service(settings: Settings, pool: RenderPool, loop: asyncio.AbstractEventLoop) -> SweepService:
    """Return a service that measures on the pool; coroutines run on ``loop``."""

    def measure(job: MeasureJob) -> tuple[Drawn, ...]:
        return finished(asyncio.run_coroutine_threadsafe(pool.measure(job), loop), lambda: service.stopped)

    sizes = (settings.accuracy_width, settings.accuracy_height, settings.accuracy_samples, settings.accuracy_rounds)
    service = SweepService(
        Store(settings.cache), SweepSettings(*sizes), lambda: Rig(measure, _ready(pool), pool.threads)
    )
    return service


def retry_seconds(running: Running) -> int:
    """Return the delay before the next request, s."""
    return max(1, min(LONGEST_WAIT, math.ceil(running.eta_s or 2.0)))


class PoolWorkers:
    """Draws on the workers of a render pool, when no visitor's frame waits. It runs outside the pool's event loop."""

    def __init__(self, pool: RenderPool, loop: asyncio.AbstractEventLoop) -> None:
        self._pool = pool
        self._loop = loop

    @property
    def info(self) -> Mapping[str, str]:
        return _ready(self._pool)

    def draw(self, units: Iterable[Unit]) -> DrawnFrames:
        """Draw frames, as many at a time as there are workers."""
        running: deque[tuple[int, Future[bytes]]] = deque()
        try:
            for index, job in units:
                running.append((index, asyncio.run_coroutine_threadsafe(self._frame(job), self._loop)))
                if len(running) == self._pool.workers:
                    first, future = running.popleft()
                    yield first, future.result()
            while running:
                first, future = running.popleft()
                yield first, future.result()
        finally:
            for _, future in running:
                future.cancel()

    async def _frame(self, job: FrameJob) -> bytes:
        for attempt in range(1, _ATTEMPTS + 1):
            try:
                return (await self._pool.render(job, Ticket(background=True))).content
            except RenderError as error:
                if attempt == _ATTEMPTS or not isinstance(error, DeadlineError | RenderQueueFullError):
                    raise SequenceError(f"a frame could not be drawn: {error}") from error
        raise AssertionError("the last attempt returns or raises")


P = ParamSpec("P")
T = TypeVar("T")

RETRY_SECONDS = 5


class ThreadPool:
    """Runs functions in threads, in order.

    threads: number that run at a time. queue: number of further calls that can wait.
    """

    def __init__(self, threads: int, queue: int) -> None:
        self._limiter = anyio.CapacityLimiter(threads)
        self._queue = queue

    async def run(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Run ``function`` in a thread. Raises :class:`BusyError` if the queue is full, or what the function raises."""
        waiting = self._limiter.statistics().tasks_waiting
        if waiting >= self._queue:
            raise BusyError(f"{waiting} requests of this kind are already waiting", RETRY_SECONDS)
        return await anyio.to_thread.run_sync(lambda: function(*args, **kwargs), limiter=self._limiter)
