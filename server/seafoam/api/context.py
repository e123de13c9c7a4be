"""State that the request handlers of an application share, and its work beside the event loop.

Threads make plans and masks. Sweeps and sequences run on the render pool, sequences behind visitors' frames.
"""

import asyncio
import math
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from typing import Annotated, ParamSpec, TypeVar

import anyio
import anyio.to_thread
from fastapi import Depends, Request

from seafoam.accuracy.cache import cache_dir, stored
from seafoam.accuracy.model import Running, Sweep
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings
from seafoam.accuracy.sweep_service import SweepService
from seafoam.accuracy.truth import finished
from seafoam.api.frames.plans import REQUESTS_KEPT, CompiledPlan, PlanIndex, RequestCache, compile_scene
from seafoam.api.frames.streams import Streams
from seafoam.api.http.problems import BusyError
from seafoam.api.settings import Settings
from seafoam.api.watch.metrics import Metrics
from seafoam.extras import require
from seafoam.quality import Quality
from seafoam.render.service.errors import DeadlineError, RenderError, RendererUnavailableError, RenderQueueFullError
from seafoam.render.service.frame_cache import FrameCache
from seafoam.render.service.jobs import Drawn, FrameJob, MeasureJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.queues import Ticket
from seafoam.scene import Scene
from seafoam.sequences.service import SequenceService
from seafoam.sequences.spec import DrawnFrames, SequenceError, Units

LONGEST_WAIT = 15
"""Maximum delay between requests for a running measurement, s."""
_ATTEMPTS = 10
"""Of a frame whose deadline passes while it waits for visitors' frames."""


def _ready(pool: RenderPool) -> Mapping[str, str]:
    """Return the renderer's ``vendor``, ``renderer`` and ``version``. Raises RendererUnavailableError without one."""
    if pool.state != "ready":
        raise RendererUnavailableError(pool.remedy or "the renderer is not ready")
    return pool.info


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

    def draw(self, units: Units) -> DrawnFrames:
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


class Context:
    """What handlers share, for the running event loop, on which sweeps and sequences are drawn.

    frames: gives the pool's frames, and those that it has drawn before.
    """

    def __init__(self, settings: Settings, frames: FrameCache, metrics: Metrics) -> None:
        loop = asyncio.get_running_loop()
        self.settings = settings
        self.pool = frames.pool
        self.frames = frames
        self.plan_index = PlanIndex(frames.disk)
        """The plans that have addresses."""
        self.request_cache = RequestCache(REQUESTS_KEPT)
        self.metrics = metrics
        # Apart, so that a mask, which takes seconds, delays no plan, and one that takes minutes no other mask.
        self.plans, self.masks, self.slow_masks = ThreadPool(2, 64), ThreadPool(1, 8), ThreadPool(1, 2)

        def measure(job: MeasureJob) -> tuple[Drawn, ...]:
            return finished(asyncio.run_coroutine_threadsafe(self.pool.measure(job), loop), lambda: self.sweeps.stopped)

        sizes = (settings.accuracy_width, settings.accuracy_height, settings.accuracy_samples, settings.accuracy_rounds)
        self.sweeps = SweepService(
            stored(settings.cache), SweepSettings(*sizes), lambda: Rig(measure, _ready(self.pool), self.pool.threads)
        )
        workers, directory = PoolWorkers(self.pool, loop), (settings.cache or cache_dir()) / "sequences"
        bounds = {"waiting": settings.sequences_waiting, "kept": settings.sequences_kept}
        self.sequences = SequenceService(directory, lambda: workers, **bounds)
        self.streams = Streams(settings.streams)

    async def compiled(self, scene: Scene, quality: Quality) -> CompiledPlan:
        return await self.plans.run(compile_scene, scene, quality)

    async def addressed(self, scene: Scene, quality: Quality) -> CompiledPlan:
        """Compile a scene, and let its plan's hash be an address of its frames."""
        compiled = await self.compiled(scene, quality)
        if not self.plan_index.holds(compiled.sha256):
            await self.plans.run(self.plan_index.remember, compiled.sha256, scene, quality)
        return compiled

    async def measured(self, subject: Subject) -> Sweep | Running:
        """Return the sweep of a subject, or its progress. Raises the pool's errors if no renderer is available.

        Raises :class:`seafoam.extras.MissingExtraError` without the packages of the extra ``reports``.
        """
        require("reports")
        await self.pool.wait_until_settled()
        return await self.plans.run(self.sweeps.sweep, subject)


def _context(request: Request) -> Context:
    context: Context = request.app.state.context
    return context


InContext = Annotated[Context, Depends(_context)]
