"""Who waits for the workers of a server: visitors before background work, and long jobs one after the other."""

import asyncio
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

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


J = TypeVar("J")


class BackgroundFullError(Exception):
    """As many jobs of this kind wait as may; retry after ``retry_after`` seconds."""

    retry_after = 30


class BackgroundQueue(Generic[J]):
    """Jobs by key, which ``run`` does in a thread that the first of them starts; ``run`` raises nothing.

    Whoever reads or changes jobs holds ``lock``.
    """

    def __init__(self, name: str, run: Callable[[str, J], None]) -> None:
        self.lock = threading.Condition()
        self.waiting: OrderedDict[str, J] = OrderedDict()
        self.running: tuple[str, J] | None = None
        self.stopped = threading.Event()
        self._name = name
        self._run = run
        self._thread: threading.Thread | None = None

    def add(self, key: str, job: J) -> None:
        """Let a job wait behind the others."""
        with self.lock:
            self.waiting[key] = job
            if self._thread is None and not self.stopped.is_set():
                self._thread = threading.Thread(target=self._work, name=self._name, daemon=True)
                self._thread.start()
            self.lock.notify_all()

    def running_job(self, key: str) -> J | None:
        """Return the job with this key if it is the one that is being done, else None."""
        return self.running[1] if self.running is not None and self.running[0] == key else None

    def stop(self) -> None:
        """Forget what waits, and wait until the running job has ended, which reads ``stopped`` now and then."""
        self.stopped.set()
        with self.lock:
            self.waiting.clear()
            self.lock.notify_all()
        if self._thread is not None:
            self._thread.join()

    def _work(self) -> None:
        while True:
            with self.lock:
                self.lock.wait_for(lambda: self.waiting or self.stopped.is_set())
                if self.stopped.is_set():
                    return
                self.running = self.waiting.popitem(last=False)
            self._run(*self.running)
            with self.lock:
                self.running = None
