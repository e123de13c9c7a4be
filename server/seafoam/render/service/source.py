"""Where frames come from: memory, disk, a run in flight, or a render worker."""

import asyncio
import hashlib
import json
from collections import Counter, OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal

from seafoam.render.encode import ENCODERS
from seafoam.render.service.disk import DiskCache
from seafoam.render.service.errors import DeadlineError
from seafoam.render.service.jobs import EncodedFrame, FrameJob
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.recipe import recipe_of
from seafoam.render.service.sharing import Sharing
from seafoam.render.service.slots import Turn

Origin = Literal["memory", "disk", "shared", "drawn"]

_PACKAGE = Path(__file__).resolve().parent.parent.parent
_DRAWING = ("framegraph", "render", "scene/camera.py", "textures")
"""Sources that frames depend on beside their plans: a changed checkout must not be answered by what it drew before."""


@dataclass(frozen=True, slots=True)
class Found:
    """A frame, and where it came from; ``shared``: drawn once for several requests."""

    frame: EncodedFrame
    origin: Origin


class Memory:
    """Bytes by key, at most ``limit`` of them in all; the least recently used go first."""

    def __init__(self, limit: int) -> None:
        self.limit = limit
        self.total = 0
        self._held: OrderedDict[str, bytes] = OrderedDict()

    def get(self, key: str) -> bytes | None:
        """Return what is held under a key, or None."""
        if key not in self._held:
            return None
        self._held.move_to_end(key)
        return self._held[key]

    def put(self, key: str, content: bytes) -> None:
        """Hold content under a key, unless it exceeds the limit alone."""
        if len(content) > self.limit:
            return
        self.total += len(content) - len(self._held.pop(key, b""))
        self._held[key] = content
        while self.total > self.limit:
            self.total -= len(self._held.popitem(last=False)[1])


class FrameSource:
    """Frames for one event loop: each is drawn once while it is asked for, and again only when no cache has it.

    disk: absent: nothing is kept on disk. memory: bytes of frames kept in memory.
    """

    def __init__(self, pool: RenderPool, disk: DiskCache | None, memory: int) -> None:
        self.pool = pool
        self.disk = disk
        self.memory = Memory(memory)
        self.origins: Counter[Origin] = Counter()
        """Frames by where they came from."""
        self._sharing: Sharing[Found] = Sharing()
        self._writing: set[asyncio.Task[Any]] = set()

    def key(self, job: FrameJob, plan: str) -> str:
        """Return the key of a frame: a hash of everything that its bytes depend on. plan: SHA-256 of its frame plan.

        The renderer must be known (:meth:`RenderPool.wait_until_settled`).
        """
        return frame_key(job, plan, self.pool.info)

    def at_hand(self, key: str) -> bytes | None:
        """Return a frame from memory, at once, or None."""
        content = self.memory.get(key)
        if content is not None:
            self.origins["memory"] += 1
        return content

    async def frame(self, job: FrameJob, key: str, *, background: bool = False) -> Found:
        """Return a frame by its key. background: drawn only when no visitor's frame waits.

        Raises what :meth:`RenderPool.render` raises. If the call is cancelled and no other call wants the frame, it
        leaves the queue.
        """
        if (content := self.at_hand(key)) is not None:
            return Found(EncodedFrame(content, {}), "memory")
        loop = asyncio.get_running_loop()
        expires = loop.time() + self.pool.deadline
        while True:
            joined = self._sharing.in_flight(key)
            running = self._sharing.run(key, lambda turn: self._make(job, key, turn), background=background)
            try:
                # Who comes first has the pool's deadline, which also ends a renderer that hangs.
                async with asyncio.timeout_at(expires if joined and not background else None):
                    found = await running
            except TimeoutError:
                raise DeadlineError("timeout: the frame, which others wait for too, was not finished in time") from None
            except DeadlineError:
                # The deadline of those who came first is not the caller's.
                if not joined or loop.time() >= expires:
                    raise
                continue
            origin: Origin = "shared" if joined and found.origin == "drawn" else found.origin
            self.origins[origin] += 1
            return replace(found, origin=origin)

    async def close(self) -> None:
        """Wait until what was drawn is written."""
        await asyncio.gather(*self._writing, return_exceptions=True)

    async def _make(self, job: FrameJob, key: str, turn: Turn) -> Found:
        if self.disk is not None and (content := await asyncio.to_thread(self.disk.get, key)) is not None:
            self.memory.put(key, content)
            return Found(EncodedFrame(content, {}), "disk")
        frame = await self.pool.render(job, turn)
        self.memory.put(key, frame.content)
        if self.disk is not None:
            # Nobody waits for the disk.
            writing = asyncio.ensure_future(asyncio.to_thread(self.disk.put, key, frame.content))
            self._writing.add(writing)
            writing.add_done_callback(self._writing.discard)
        return Found(frame, "drawn")


def frame_key(job: FrameJob, plan: str, info: Mapping[str, str]) -> str:
    """Return the hash of everything that a frame's bytes depend on, 40 hexadecimal digits.

    The recipe says more than the plan does: also what the plan leaves out. plan: SHA-256 of the frame plan. info: the
    renderer's.
    """
    parts = (version("seafoam"), _drawing(), ENCODERS, plan, recipe_of(job, info, plan), dict(info), job.format)
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:40]


@lru_cache(maxsize=1)
def _drawing() -> str:
    digest = hashlib.sha256()
    for part in _DRAWING:
        path = _PACKAGE / part
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            digest.update(file.relative_to(_PACKAGE).as_posix().encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()
