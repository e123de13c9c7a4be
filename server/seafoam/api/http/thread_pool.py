"""Thread pools for CPU work of the web process (plans, masks, textures, plots), so that the event loop never blocks."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar

import anyio
import anyio.to_thread

from seafoam.api.http.problems import BusyError

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
