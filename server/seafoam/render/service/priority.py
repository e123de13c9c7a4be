"""Places of render workers, given to visitors before background work."""

import asyncio
from dataclasses import dataclass

STREAMED = 8
"""Frames of streams for one of the background, which streams would else keep from ever being drawn."""


@dataclass(eq=False, slots=True)
class Ticket:
    """A caller's place in the queue. ``background``: only when no other caller waits; may change while it waits.

    ``stream``: one of many frames of a stream, after single frames and mostly before the background.
    """

    background: bool = False
    stream: bool = False

    @property
    def rank(self) -> int:
        """Callers of a lower rank go first."""
        return 2 if self.background else int(self.stream)


class PrioritySemaphore:
    """A counter of free workers, for one event loop. Those who wait are served by kind, then in order of arrival."""

    def __init__(self, count: int) -> None:
        self._free = count
        self._waiting: list[tuple[Ticket, asyncio.Future[None]]] = []
        self._streamed = 0
        """Frames of streams since one of the background that waits."""

    def locked(self) -> bool:
        """Whether every worker is taken."""
        return self._free == 0

    async def acquire(self, ticket: Ticket | None = None) -> None:
        """Take a worker, waiting for one if none is free; absent ticket: a visitor's."""
        if self._free > 0:
            self._free -= 1
            return
        entry = ticket or Ticket(), asyncio.get_running_loop().create_future()
        self._waiting.append(entry)
        try:
            await entry[1]
        except asyncio.CancelledError:
            if entry[1].cancelled():
                self._waiting.remove(entry)
            else:  # given and cancelled in the same turn of the loop: the next in line takes it
                self.release()
            raise

    def release(self) -> None:
        """Give a worker back, to the first of those who wait."""
        # A cancelled caller removes itself only when it runs again.
        waiting = [entry for entry in self._waiting if not entry[1].done()]
        if not waiting:
            self._free += 1
            return
        # min() keeps the order of arrival among equals.
        first = min(waiting, key=lambda entry: entry[0].rank)
        background = next((entry for entry in waiting if entry[0].background), None)
        if background is None:
            self._streamed = 0
        elif first[0].rank > 0:
            if self._streamed >= STREAMED:
                first = background
            self._streamed = 0 if first is background else self._streamed + 1
        self._waiting.remove(first)
        first[1].set_result(None)
