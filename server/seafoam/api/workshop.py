"""CPU work of the web process (plans, masks, textures, plots): in threads, bounded, so the event loop never waits."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar

import anyio
import anyio.to_thread

from seafoam.api.errors import BusyError

P = ParamSpec("P")
T = TypeVar("T")

RETRY_SECONDS = 5


class Workshop:
    """Runs functions in threads, in order.

    threads: how many run at a time. queue: how many more may wait.
    """

    def __init__(self, threads: int, queue: int) -> None:
        self._limiter = anyio.CapacityLimiter(threads)
        self._queue = queue

    async def run(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Run ``function`` in a thread. Raises :class:`BusyError` when too much waits, and what the function raises."""
        waiting = self._limiter.statistics().tasks_waiting
        if waiting >= self._queue:
            raise BusyError(f"{waiting} requests of this kind are already waiting", RETRY_SECONDS)
        return await anyio.to_thread.run_sync(lambda: function(*args, **kwargs), limiter=self._limiter)
