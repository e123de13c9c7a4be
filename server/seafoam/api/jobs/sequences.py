"""The service that makes sequences for an application, on its render pool, behind visitors' frames."""

import asyncio
from collections import deque
from collections.abc import Iterable, Mapping
from concurrent.futures import Future

from seafoam.accuracy.cache import cache_dir
from seafoam.api.settings import Settings
from seafoam.render.service.errors import DeadlineError, RenderError, RendererUnavailableError, RenderQueueFullError
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.priority import Ticket
from seafoam.sequences.errors import SequenceError
from seafoam.sequences.service import SequenceService
from seafoam.sequences.workers import Drawn, Unit

_ATTEMPTS = 10
"""Of a frame whose deadline passes while it waits for visitors' frames."""
_SUBFOLDER = "sequences"


class PoolWorkers:
    """Draws on the workers of a render pool, when no visitor's frame waits. It runs outside the pool's event loop."""

    def __init__(self, pool: RenderPool, loop: asyncio.AbstractEventLoop) -> None:
        self._pool = pool
        self._loop = loop

    @property
    def info(self) -> Mapping[str, str]:
        """The renderer's ``vendor``, ``renderer`` and ``version``. Raises RendererUnavailableError without one."""
        if self._pool.state != "ready":
            raise RendererUnavailableError(self._pool.remedy or "the renderer is not ready")
        return self._pool.info

    def draw(self, units: Iterable[Unit]) -> Drawn:
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
            except (DeadlineError, RenderQueueFullError) as error:
                if attempt == _ATTEMPTS:
                    raise SequenceError(f"a frame could not be drawn: {error}") from error
            except RenderError as error:
                raise SequenceError(f"a frame could not be drawn: {error}") from error
        raise AssertionError("the last attempt returns or raises")


def sequence_service(settings: Settings, pool: RenderPool, loop: asyncio.AbstractEventLoop) -> SequenceService:
    """Return a service that draws on the pool; coroutines run on ``loop``."""
    directory = (cache_dir() if settings.cache is None else settings.cache) / _SUBFOLDER
    workers = PoolWorkers(pool, loop)
    return SequenceService(directory, lambda: workers, waiting=settings.sequences_waiting, kept=settings.sequences_kept)
