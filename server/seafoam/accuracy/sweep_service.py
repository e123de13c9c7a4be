"""Background measurements for a server: one at a time, in a thread, started by the first request."""

import logging
from collections.abc import Callable
from dataclasses import dataclass

from seafoam.accuracy.cache import key_of
from seafoam.accuracy.model import Running, Sweep
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, find_sweep, make_sweep
from seafoam.accuracy.truth import SweepStoppedError, Truth, Watcher, find_truth, make_truth
from seafoam.reference import scene_sha256
from seafoam.render.service.frame_cache import DiskCache, LruCache
from seafoam.render.service.queues import BackgroundFullError, BackgroundQueue

log = logging.getLogger(__name__)

KEPT = 16
"""Number of finished measurements in memory."""
MOST_WAITING = 24


class FailedError(Exception):
    """A requested measurement failed; the next request starts it again."""


_FIRST_REPORT = Running(status="running", stage="float64 truth", progress=0.0)


@dataclass
class _SweepTask:
    """A task: the float64 picture of a subject only, or the whole sweep; and how far it is."""

    subject: Subject
    whole: bool
    report: Running = _FIRST_REPORT

    @property
    def key(self) -> str:
        return key_of(scene_sha256(self.subject.scene), self.subject.time, self.subject.size, self.whole)


class SweepService:
    """Runs requested measurements, one after the other. Its methods never wait for a measurement.

    ``rig`` returns the renderer when needed, and raises if there is none. Methods can read files and plan scenes,
    so an event loop calls them in a thread.
    """

    def __init__(self, store: DiskCache, settings: SweepSettings, rig: Callable[[], Rig]) -> None:
        self.settings = settings
        self._store = store
        self._rig = rig
        self._queue: BackgroundQueue[_SweepTask] = BackgroundQueue("accuracy", self._run)
        self._failed: dict[str, Exception] = {}
        self._sweeps: LruCache[str, Sweep] = LruCache(KEPT)

    def sweep(self, subject: Subject) -> Sweep | Running:
        """Return the sweep if it is finished, else its progress; the first call starts it.

        Raises :class:`BackgroundFullError`, what ``rig`` raises, and once the error of the last attempt.
        """
        rig = self._rig()
        key = key_of(_SweepTask(subject, True).key, rig.machine.model_dump())
        stored = self._sweeps.get(key) or find_sweep(self._store, subject, self.settings, rig.machine)
        if stored is None:
            return self._ask(_SweepTask(subject, True))
        self._sweeps.put(key, stored)
        return stored

    def truth(self, subject: Subject) -> Truth | Running:
        """Return the float64 picture or its progress; the first call starts it. Raises as :meth:`sweep` does."""
        picture = find_truth(self._store, subject.truth(self.settings))
        if picture is not None:
            return picture
        with self._queue.lock:
            if (running := self._queue.running_job(_SweepTask(subject, True).key)) is not None:
                return running.report
        return self._ask(_SweepTask(subject, False))

    @property
    def stopped(self) -> bool:
        return self._queue.stopped.is_set()

    def stop(self) -> None:
        """Cancel all measurements and wait until they have ended."""
        self._queue.stop()

    def _ask(self, task: _SweepTask) -> Running:
        with self._queue.lock:
            key, waiting = task.key, self._queue.waiting
            if (error := self._failed.pop(key, None)) is not None:
                raise FailedError(f"the measurement failed: {error}") from error
            if (running := self._queue.running_job(key)) is not None:
                return running.report
            if key not in waiting:
                if len(waiting) >= MOST_WAITING:
                    raise BackgroundFullError(f"{len(waiting)} measurements are already waiting")
                self._queue.add(key, task)
            ahead = list(waiting).index(key) + (self._queue.running is not None)
            return Running(status="queued", stage=f"{ahead} before it", progress=0.0)

    def _run(self, key: str, task: _SweepTask) -> None:
        def tell(stage: str, share: float, remaining: float | None) -> None:
            with self._queue.lock:
                task.report = Running(status="running", stage=stage, progress=round(share, 3), eta_s=remaining)

        watcher = Watcher(tell, self._queue.stopped.is_set)
        try:
            if task.whole:
                make_sweep(self._store, task.subject, self.settings, self._rig(), watcher)
            else:
                truth = task.subject.truth(self.settings)
                make_truth(self._store, truth, lambda job: self._rig().measure(job), watcher)
            if self._store.failures:
                raise OSError(f"{self._store.directory} cannot be written")
        except SweepStoppedError:
            pass
        except Exception as error:
            log.exception("A measurement of %s failed", task.subject.preset or "a scene")
            with self._queue.lock:
                if not self._queue.stopped.is_set():
                    self._failed[key] = error
