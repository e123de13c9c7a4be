"""Long work of a server beside its frames: one job at a time, in a thread, in the order of arrival."""

import threading
from collections import OrderedDict
from collections.abc import Callable
from typing import Generic, TypeVar

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
