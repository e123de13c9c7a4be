"""Background measurements for a server: one at a time, in a thread, started by the first request."""

import logging
import math
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from seafoam.accuracy.cache import Store, key_of
from seafoam.accuracy.model import Running, Sweep
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, Watcher, find_sweep, make_sweep
from seafoam.accuracy.truth import SweepStoppedError, Truth, find_truth, make_truth
from seafoam.reference import scene_sha256

log = logging.getLogger(__name__)

KEPT = 16
"""Number of finished measurements in memory."""
MOST_WAITING = 24


class SweepQueueFullError(Exception):
    """The queue of measurements is full."""


class FailedError(Exception):
    """A requested measurement failed; the next request starts it again."""


@dataclass(frozen=True)
class _SweepTask:
    """A task: the float64 picture of a subject only, or the whole sweep."""

    subject: Subject
    whole: bool

    @property
    def key(self) -> str:
        return key_of(scene_sha256(self.subject.scene), self.subject.time, self.subject.size, self.whole)


class SweepService:
    """Runs requested measurements, one after the other. Its methods never wait for a measurement.

    ``rig`` returns the renderer when needed, and raises if there is none. Methods can read files and plan scenes,
    so an event loop calls them in a thread.
    """

    def __init__(self, store: Store, settings: SweepSettings, rig: Callable[[], Rig]) -> None:
        self.settings = settings
        self._store = store
        self._rig = rig
        self._waiting: OrderedDict[str, _SweepTask] = OrderedDict()
        self._running: tuple[str, Running, float] | None = None
        self._failed: dict[str, Exception] = {}
        self._sweeps: OrderedDict[str, Sweep] = OrderedDict()
        self._change = threading.Condition()
        self._stopped = threading.Event()
        self._thread: threading.Thread | None = None

    def sweep(self, subject: Subject) -> Sweep | Running:
        """Return the sweep if it is finished, else its progress; the first call starts it.

        Raises :class:`SweepQueueFullError`, what ``rig`` raises, and once the error of the last attempt.
        """
        rig = self._rig()
        key = key_of(_SweepTask(subject, True).key, rig.machine.model_dump())
        with self._change:
            stored = self._sweeps.get(key)
        if stored is None:
            stored = find_sweep(self._store, subject, self.settings, rig.machine)
        if stored is None:
            return self._ask(_SweepTask(subject, True))
        with self._change:
            self._sweeps[key] = stored
            while len(self._sweeps) > KEPT:
                self._sweeps.popitem(last=False)
        return stored

    def truth(self, subject: Subject) -> Truth | Running:
        """Return the float64 picture or its progress; the first call starts it. Raises as :meth:`sweep` does."""
        settings = self.settings
        at = (settings.width, settings.height, settings.samples_along)
        picture = find_truth(self._store, subject.scene, subject.time, *at)
        if picture is not None:
            return picture
        with self._change:
            if self._running is not None and self._running[0] == _SweepTask(subject, True).key:
                return self._now(self._running)
        return self._ask(_SweepTask(subject, False))

    @property
    def stopped(self) -> bool:
        """Whether all measurements were cancelled."""
        return self._stopped.is_set()

    def stop(self) -> None:
        """Cancel all measurements and wait until they have ended."""
        self._stopped.set()
        with self._change:
            self._waiting.clear()
            self._change.notify_all()
        if self._thread is not None:
            self._thread.join()

    def _ask(self, task: _SweepTask) -> Running:
        with self._change:
            key = task.key
            if (error := self._failed.pop(key, None)) is not None:
                raise FailedError(f"the measurement failed: {error}") from error
            if self._running is not None and self._running[0] == key:
                return self._now(self._running)
            if key not in self._waiting:
                if len(self._waiting) >= MOST_WAITING:
                    raise SweepQueueFullError(f"{len(self._waiting)} measurements are already waiting")
                self._waiting[key] = task
                self._change.notify_all()
            if self._thread is None and not self._stopped.is_set():
                self._thread = threading.Thread(target=self._work, name="accuracy", daemon=True)
                self._thread.start()
            ahead = list(self._waiting).index(key) + (self._running is not None)
            return Running(status="queued", stage=f"{ahead} before it", progress=0.0)

    @staticmethod
    def _now(running: tuple[str, Running, float]) -> Running:
        _, report, reported = running
        if report.eta_s is None:
            return report
        return report.model_copy(update={"eta_s": math.ceil(max(report.eta_s - (time.monotonic() - reported), 1.0))})

    def _work(self) -> None:
        while True:
            with self._change:
                while not self._waiting and not self._stopped.is_set():
                    self._change.wait()
                if self._stopped.is_set():
                    return
                key, task = self._waiting.popitem(last=False)
                first = Running(status="running", stage="float64 truth", progress=0.0)
                self._running = (key, first, time.monotonic())
            failed: Exception | None = None
            try:
                self._measure(key, task)
            except SweepStoppedError:
                pass
            except Exception as error:
                log.exception("A measurement of %s failed", task.subject.preset or "a scene")
                failed = error
            with self._change:
                self._running = None
                if failed is not None and not self._stopped.is_set():
                    self._failed[key] = failed

    def _measure(self, key: str, task: _SweepTask) -> None:
        watcher = Watcher(lambda *report: self._report(key, *report), self._stopped.is_set)
        if task.whole:
            make_sweep(self._store, task.subject, self.settings, self._rig(), watcher)
            return
        settings = self.settings
        make_truth(
            self._store,
            task.subject.scene,
            task.subject.time,
            settings.width,
            settings.height,
            settings.samples_along,
            progress=lambda share, remaining: watcher.progress("float64 truth", share, remaining),
            stopped=watcher.stopped,
        )

    def _report(self, key: str, stage: str, share: float, remaining: float | None) -> None:
        report = Running(status="running", stage=stage, progress=round(share, 3), eta_s=remaining)
        with self._change:
            self._running = (key, report, time.monotonic())
