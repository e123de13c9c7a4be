"""Frames from the fastest place that has them: memory, disk, a render in flight, or a render worker.

Why no library for the disk: docs/operations.md.
"""

import asyncio
import contextlib
import hashlib
import json
import logging
import os
import threading
from collections import Counter, OrderedDict
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, Generic, TypeVar

from seafoam import files
from seafoam.render.encode import ENCODERS
from seafoam.render.service.jobs import EncodedFrame, FrameJob, Origin
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.queues import Ticket

log = logging.getLogger(__name__)

_MAGIC = b"seafoam1"
_DIGEST = 32
_HEADER = len(_MAGIC) + _DIGEST
_KEPT_SHARE = 0.9
"""Share of the limit that eviction leaves, so that it does not run at every write."""


class DiskCache:
    """Files by key in a directory, at most ``limit`` bytes in all; the least recently read ones go first.

    Each file holds the SHA-256 of its content, and appears under its name complete or not at all. A file whose content
    does not match is removed and counts as absent. Nothing raises: a cache that cannot be read or written is empty.
    Several processes may share the directory. Thread-safe.
    """

    def __init__(self, directory: Path, limit: int) -> None:
        self.directory = directory
        self.limit = limit
        self.damaged = 0
        """Files that were removed because their content did not match."""
        self.failures = 0
        """Writes that failed."""
        self._lock = threading.Lock()
        self._total: int | None = None
        """Bytes on disk as far as known; None: not counted yet."""

    def get(self, key: str) -> bytes | None:
        """Return the content stored under a key (letters, digits, ``-``), or None."""
        path = self._path(key)
        try:
            stored = path.read_bytes()
        except OSError:
            return None
        content = stored[_HEADER:]
        if stored[:_HEADER] != _MAGIC + hashlib.sha256(content).digest():
            self.damaged += 1
            log.warning("A file of the cache was damaged, and is removed: %s", path)
            _remove(path)
            return None
        with contextlib.suppress(OSError):
            os.utime(path)  # the order of eviction
        return content

    def put(self, key: str, content: bytes) -> None:
        """Store content under a key, and evict what no longer fits."""
        path, size = self._path(key), _HEADER + len(content)
        if size > self.limit:
            return
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            # A loss of power may leave the name without the content, which its hash then tells.
            files.write_whole(path, _MAGIC + hashlib.sha256(content).digest() + content)
        except OSError as error:
            self.failures += 1
            log.warning("The cache in %s cannot be written: %s", self.directory, error)
            return
        with self._lock:
            self._total = None if self._total is None else self._total + size
            if self._total is None or self._total > self.limit:
                self._evict()

    def _path(self, key: str) -> Path:
        # Folders of a few hundred files: listing one folder of a million is slow on some file systems.
        return self.directory / key[:2] / key

    def _evict(self) -> None:
        """Count what is there, files of other processes and of killed ones too, and remove the oldest until it fits."""
        entries: list[tuple[float, int, Path]] = []
        for folder, _, names in os.walk(self.directory):
            for path in (Path(folder, name) for name in names):
                with contextlib.suppress(OSError):
                    stat = path.stat()
                    entries.append((stat.st_mtime, stat.st_size, path))
        total = sum(size for _, size, _ in entries)
        if total > self.limit:
            for _, size, path in sorted(entries):
                if total <= _KEPT_SHARE * self.limit:
                    break
                _remove(path)
                total -= size
        self._total = total


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()


K = TypeVar("K")
V = TypeVar("V")
T = TypeVar("T")

_PACKAGE = Path(__file__).resolve().parent.parent.parent
_DRAWING = ("framegraph", "render", "scene/camera.py", "textures")
"""Sources that frames depend on beside their plans: a changed checkout must not be answered by what it drew before."""


class LruCache(Generic[K, V]):
    """Values by key, whose weights sum up to ``limit`` at most; the least recently used go first. Thread-safe."""

    def __init__(self, limit: int, weigh: Callable[[V], int] = lambda value: 1) -> None:
        self.limit = limit
        self._weigh = weigh
        self._total = 0
        self._held: OrderedDict[K, V] = OrderedDict()
        self._lock = threading.Lock()

    def __contains__(self, key: K) -> bool:
        return key in self._held

    def get(self, key: K) -> V | None:
        """Return what is held under a key, or None."""
        with self._lock:
            if key not in self._held:
                return None
            self._held.move_to_end(key)
            return self._held[key]

    def put(self, key: K, value: V) -> None:
        """Hold a value under a key, unless it exceeds the limit alone."""
        weight = self._weigh(value)
        if weight > self.limit:
            return
        with self._lock:
            if key in self._held:
                self._total -= self._weigh(self._held.pop(key))
            self._held[key] = value
            self._total += weight
            while self._total > self.limit:
                self._total -= self._weigh(self._held.popitem(last=False)[1])


@dataclass
class _Run(Generic[T]):
    ticket: Ticket
    task: asyncio.Task[T]
    waiting: int = 0


class InFlight(Generic[T]):
    """Runs by key, for one event loop: identical calls share one."""

    def __init__(self) -> None:
        self._runs: dict[str, _Run[T]] = {}

    def __contains__(self, key: str) -> bool:
        return key in self._runs

    async def run(self, key: str, start: Callable[[Ticket], Coroutine[Any, Any, T]], *, background: bool) -> T:
        """Return the result of the run with this key, which is started if there is none.

        A visitor who joins a run that waits in the background moves it to the front. A run whose callers have all
        been cancelled is cancelled. Raises what the run raises.
        """
        run = self._runs.get(key)
        if run is None:
            ticket = Ticket(background)
            run = self._runs[key] = _Run(ticket, asyncio.ensure_future(start(ticket)))
            run.task.add_done_callback(lambda _: self._forget(key, run))
        run.ticket.background &= background
        run.waiting += 1
        try:
            return await asyncio.shield(run.task)
        finally:
            run.waiting -= 1
            if run.waiting == 0 and not run.task.done():
                # Before the task has ended: who asks now must not join what is being cancelled.
                self._forget(key, run)
                run.task.cancel()

    def _forget(self, key: str, run: _Run[T]) -> None:
        if self._runs.get(key) is run:
            del self._runs[key]
        # Retrieves the exception, which asyncio would report if no caller waits any more.
        if run.task.done() and not run.task.cancelled():
            run.task.exception()


class FrameCache:
    """Frames for one event loop: each is drawn once while it is asked for, and again only when no cache has it.

    disk: absent: nothing is kept on disk. memory: bytes of frames kept in memory.
    """

    def __init__(self, pool: RenderPool, disk: DiskCache | None, memory: int) -> None:
        self.pool = pool
        self.disk = disk
        self.memory: LruCache[str, bytes] = LruCache(memory, len)
        self.origins: Counter[Origin] = Counter()
        """Frames by where they came from."""
        self._in_flight: InFlight[EncodedFrame] = InFlight()

    def key(self, job: FrameJob, plan: str) -> str:
        """Return the key of a frame: a hash of everything that its bytes depend on, 40 hexadecimal digits.

        The recipe says more than the plan does: also what the plan leaves out. plan: SHA-256 of the frame plan. The
        renderer must be known (:meth:`RenderPool.wait_until_settled`).
        """
        info = self.pool.info
        parts = (version("seafoam"), _drawing(), ENCODERS, plan, job.recipe(info, plan), info, job.format)
        text = json.dumps(parts, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()[:40]

    def at_hand(self, key: str) -> EncodedFrame | None:
        """Return a frame from memory, at once, or None."""
        if (content := self.memory.get(key)) is None:
            return None
        self.origins["memory"] += 1
        return EncodedFrame(content, {}, "memory")

    async def frame(self, job: FrameJob, key: str, *, background: bool = False) -> EncodedFrame:
        """Return a frame by its key. background: drawn only when no visitor's frame waits.

        Raises what :meth:`RenderPool.render` raises. If the call is cancelled and no other call wants the frame, it
        leaves the queue.
        """
        if (held := self.at_hand(key)) is not None:
            return held
        joined = key in self._in_flight
        frame = await self._in_flight.run(key, lambda ticket: self._make(job, key, ticket), background=background)
        if joined and frame.origin == "drawn":
            frame = replace(frame, origin="shared")
        self.origins[frame.origin] += 1
        return frame

    async def _make(self, job: FrameJob, key: str, ticket: Ticket) -> EncodedFrame:
        if self.disk is not None and (content := await asyncio.to_thread(self.disk.get, key)) is not None:
            self.memory.put(key, content)
            return EncodedFrame(content, {}, "disk")
        frame = await self.pool.render(job, ticket)
        self.memory.put(key, frame.content)
        if self.disk is not None:
            # Nobody waits for the disk, but asyncio for its threads before a loop ends.
            asyncio.get_running_loop().run_in_executor(None, self.disk.put, key, frame.content)
        return frame


@lru_cache(maxsize=1)
def _drawing() -> str:
    digest = hashlib.sha256()
    for part in _DRAWING:
        path = _PACKAGE / part
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            digest.update(file.relative_to(_PACKAGE).as_posix().encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()
