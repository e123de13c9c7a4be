"""Identical calls in flight share one run."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any, Generic, TypeVar

from seafoam.render.service.slots import Turn

T = TypeVar("T")


class _Run(Generic[T]):
    def __init__(self, turn: Turn, task: asyncio.Task[T]) -> None:
        self.turn = turn
        self.task = task
        self.waiting = 0


class Sharing(Generic[T]):
    """Runs of one kind by key, for one event loop."""

    def __init__(self) -> None:
        self._runs: dict[str, _Run[T]] = {}

    def in_flight(self, key: str) -> bool:
        """Whether a run with this key has not ended."""
        return key in self._runs

    async def run(self, key: str, start: Callable[[Turn], Coroutine[Any, Any, T]], *, background: bool) -> T:
        """Return the result of the run with this key, which is started if there is none.

        A visitor who joins a run that waits in the background moves it to the front. A run whose callers have all
        been cancelled is cancelled. Raises what the run raises.
        """
        run = self._runs.get(key)
        if run is None:
            turn = Turn(background)
            run = self._runs[key] = _Run(turn, asyncio.ensure_future(start(turn)))
            run.task.add_done_callback(lambda task: self._ended(key, task))
        run.turn.background &= background
        run.waiting += 1
        try:
            return await asyncio.shield(run.task)
        finally:
            run.waiting -= 1
            if run.waiting == 0 and not run.task.done():
                # Before the task has ended: who asks now must not join what is being cancelled.
                self._forget(key, run.task)
                run.task.cancel()

    def _ended(self, key: str, task: asyncio.Task[T]) -> None:
        self._forget(key, task)
        # Retrieves the exception, which asyncio would report if no caller waits any more.
        if not task.cancelled():
            task.exception()

    def _forget(self, key: str, task: asyncio.Task[T]) -> None:
        if key in self._runs and self._runs[key].task is task:
            del self._runs[key]
