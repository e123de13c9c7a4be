"""Sequences in the background of a server: one at a time, in a thread, kept on disk until others take their place."""

import hashlib
import json
import logging
import re
import shutil
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, Field

from seafoam.files import write_whole
from seafoam.render.service.queues import BackgroundFullError, BackgroundQueue
from seafoam.sequences.formats import Codec
from seafoam.sequences.making import Kind, Output, Stage, check_output, make_sequence
from seafoam.sequences.spec import SequenceError, SequenceSpec, SequenceStoppedError, Workers

log = logging.getLogger(__name__)

STATUS = "status.json"
_FILE_SHARE = 0.1
"""Share of the progress that writing the file has."""

_NAME = re.compile("[0-9a-f]{32}")

State = Literal["queued", "running", "done", "failed", "cancelled"]
FINISHED: tuple[State, ...] = ("done", "failed", "cancelled")


class SequenceStatus(BaseModel):
    """How far a sequence is."""

    id: str = Field(description="Name of the sequence: a hash of all that it depends on")
    status: State
    stage: Stage | None = Field(default=None, description="Frames are drawn, or the file is written")
    frames: int = Field(description="Number of frames")
    drawn: int = Field(default=0, description="Number of frames that are finished")
    progress: float = Field(default=0.0, description="Progress, 0 to 1")
    eta_s: float | None = Field(default=None, description="Estimated remaining time of the stage, s")
    bytes: int | None = Field(default=None, description="Size of the file, if it is finished")
    detail: str | None = Field(default=None, description="Why it failed")


class UnknownSequenceError(Exception):
    """There is no sequence of this name, or no longer."""

    def __init__(self, name: str) -> None:
        super().__init__(f"sequence {name!r} was not found; finished ones are kept for a while")


class NotFinishedError(Exception):
    """The file of a sequence is not there: it is not finished, or has failed."""


@dataclass
class _SequenceTask:
    spec: SequenceSpec
    output: Output
    status: SequenceStatus
    cancelled: threading.Event = field(default_factory=threading.Event)

    def update(self, **changes: Any) -> None:
        self.status = self.status.model_copy(update=changes)


class SequenceService:
    """Makes sequences one after the other. Its methods read and write files, so an event loop calls them in a thread.

    directory: has a folder for each sequence. workers: returns who draws, and raises if nobody can. waiting: greatest
    number of unfinished sequences. kept: greatest number of finished ones, whose files are then removed, the oldest
    first.

    A sequence is named by all that it depends on: who asks for the same gets the same one. An unfinished one goes on
    when it is asked for again, also after a restart.
    """

    def __init__(self, directory: Path, workers: Callable[[], Workers], *, waiting: int, kept: int) -> None:
        self._directory = directory
        self._workers = workers
        self._most_waiting = waiting
        self._kept = kept
        self._tasks: dict[str, _SequenceTask] = {}
        """Those that are not finished, have failed or were cancelled."""
        self._queue: BackgroundQueue[_SequenceTask] = BackgroundQueue("sequences", self._run)

    def submit(self, spec: SequenceSpec, kind: Kind, codec: Codec = "h264") -> SequenceStatus:
        """Ask for a sequence, and return at once how far it is.

        Raises :class:`BackgroundFullError`, :class:`seafoam.sequences.spec.OutputError`, what ``workers`` raises,
        and :class:`seafoam.planner.PlanError`.
        """
        parts = (spec.identity(self._workers().info), spec.count, kind, codec if kind == "mp4" else "")
        name = hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:32]
        output = Output(self._directory / name / f"seafoam.{kind}", kind, codec)
        check_output(spec, output)
        with self._queue.lock:
            if (known := self._known(name)) is not None and known.status not in ("failed", "cancelled"):
                return known
            if name in self._tasks and self._tasks[name].cancelled.is_set():
                raise BackgroundFullError("the same sequence is still being cancelled")
            if (unfinished := len(self._unfinished())) >= self._most_waiting:
                raise BackgroundFullError(f"{unfinished} sequences are already waiting")
            status = SequenceStatus(id=name, status="queued", frames=spec.count)
            self._tasks[name] = _SequenceTask(spec, output, status)
            self._queue.add(name, self._tasks[name])
            return status

    def status(self, name: str) -> SequenceStatus:
        """Return how far a sequence is. Raises :class:`UnknownSequenceError`."""
        with self._queue.lock:
            if (known := self._known(name)) is None:
                raise UnknownSequenceError(name)
            return known

    def file(self, name: str) -> Path:
        """Return the file of a finished sequence. Raises :class:`UnknownSequenceError`, :class:`NotFinishedError`."""
        status = self.status(name)
        if status.status != "done":
            why = f": {status.detail}" if status.detail else f", {100 * status.progress:.0f} % done"
            raise NotFinishedError(f"the sequence is {status.status}{why}")
        (path,) = self._directory.joinpath(name).glob("seafoam.*")
        return path

    def cancel(self, name: str) -> None:
        """Cancel a sequence, or forget a finished one, and remove its files. Raises :class:`UnknownSequenceError`."""
        with self._queue.lock:
            if self._known(name) is None:
                raise UnknownSequenceError(name)
            task = self._tasks.get(name)
            if task is None or task.status.status in FINISHED or self._queue.running_job(name) is None:
                self._queue.waiting.pop(name, None)
                self._remove(name)
                return
            task.cancelled.set()
            task.update(status="cancelled", eta_s=None)

    def stop(self) -> None:
        """Stop the sequence that is being made, and wait until it has; its frames stay for the next start."""
        self._queue.stop()

    def _known(self, name: str) -> SequenceStatus | None:
        if name in self._tasks:
            return self._tasks[name].status
        try:
            return SequenceStatus.model_validate_json((self._directory / name / STATUS).read_bytes())
        except (OSError, ValueError):
            return None

    def _run(self, name: str, task: _SequenceTask) -> None:
        with self._queue.lock:
            if not task.cancelled.is_set():
                task.update(status="running", stage="frames")
        try:
            task.output.path.parent.mkdir(parents=True, exist_ok=True)

            def stopped() -> bool:
                return task.cancelled.is_set() or self._queue.stopped.is_set()

            make_sequence(task.spec, task.output, self._workers(), tell=partial(self._tell, task), stopped=stopped)
            end: dict[str, Any] = {"status": "done", "progress": 1.0, "bytes": task.output.path.stat().st_size}
        except SequenceStoppedError:
            end = {"status": "cancelled"}
        except Exception as error:
            log.exception("A sequence failed")
            end = {"status": "failed", "detail": _reason(error)}
        with self._queue.lock:
            if task.cancelled.is_set():
                self._remove(name)
                return
            task.update(eta_s=None, **end)
            if task.status.status == "done":
                write_whole(task.output.path.with_name(STATUS), task.status.model_dump_json(indent=1).encode())
                self._tasks.pop(name)
            self._forget_oldest()

    def _tell(self, task: _SequenceTask, stage: Stage, done: int, total: int, eta_s: float | None) -> None:
        frames = stage == "frames"
        whole = (1.0 - _FILE_SHARE) * done / total if frames else 1.0 - _FILE_SHARE * (1.0 - done / total)
        left = None if eta_s is None else round(eta_s, 1)
        with self._queue.lock:
            if not task.cancelled.is_set():
                drawn = done if frames else task.status.drawn
                task.update(stage=stage, progress=round(whole, 4), eta_s=left, drawn=drawn)

    def _forget_oldest(self) -> None:
        """Keep the latest of what no unfinished sequence needs: files, and frames of what failed or was interrupted."""
        folders = [path for path in self._directory.iterdir() if _NAME.fullmatch(path.name)]
        unneeded = [path for path in folders if path.name not in self._unfinished()]
        unneeded.sort(key=lambda path: path.stat().st_mtime_ns)
        for path in unneeded[: max(0, len(unneeded) - self._kept)]:
            self._remove(path.name)

    def _unfinished(self) -> set[str]:
        return {name for name, task in self._tasks.items() if task.status.status not in FINISHED}

    def _remove(self, name: str) -> None:
        self._tasks.pop(name, None)
        shutil.rmtree(self._directory / name, ignore_errors=True)


def _reason(error: Exception) -> str:
    """Return what a client may know: our own words, not the inside of a library."""
    if isinstance(error, SequenceError):
        return str(error)
    if isinstance(error, OSError):
        return f"a file could not be written: {error.strerror}"
    return "internal error; the server log has the details"
