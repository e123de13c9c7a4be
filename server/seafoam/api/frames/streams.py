"""Streams: frames in motion for pages that do not draw themselves, a bounded number of them."""

import asyncio
import re
import secrets
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field

from seafoam.quality import Quality
from seafoam.render.service.queues import Ticket
from seafoam.scene import Scene

LEASE_SECONDS = 3.0
"""Time without a request after which a stream ends, s: pages that are closed by force do not say so."""
RETRY_SECONDS = 5
"""Retry-After where all streams are taken, s."""
FRAMES_AT_ONCE = 2
"""Frames of one stream that may be drawn or wait for a worker: one is drawn while the one before it travels."""
_FRAME = re.compile(r"/api/streams/([^/]+)/frame\.")


def is_frame(path: str) -> bool:
    return _FRAME.match(path) is not None


@dataclass(eq=False, slots=True)
class _StreamFrame:
    """A frame that is drawn or waits. ``placed``: whether it has one of the stream's places."""

    ticket: Ticket
    task: asyncio.Task[object]
    placed: bool = False


@dataclass(eq=False, slots=True)
class Stream:
    """One page's frames. ``expires``: of the registry's clock, s."""

    id: str
    scene: Scene
    quality: Quality
    expires: float
    frames: list[_StreamFrame] = field(default_factory=list)
    """In order of arrival: as many as there are places, and one more where the frames of all places are being drawn."""
    late: int = 0
    """Frames that missed their deadline since the last that came."""
    _places: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(FRAMES_AT_ONCE))

    @asynccontextmanager
    async def place(self, ticket: Ticket, waits: Callable[[Ticket], bool]) -> AsyncIterator[None]:
        """Hold a place for the current task's frame; where all are taken, the oldest frame that waits is given up.

        One that has been begun is not: else a page that asks faster than frames are drawn would never get one.

        waits: whether a frame with a place has not been begun.
        """
        task = asyncio.current_task()
        assert task is not None
        if len(self.frames) >= FRAMES_AT_ONCE:
            waiting = (frame for frame in self.frames if not frame.placed or waits(frame.ticket))
            if (oldest := next(waiting, None)) is not None:
                self.frames.remove(oldest)
                oldest.task.cancel()
        own = _StreamFrame(ticket, task)
        self.frames.append(own)
        try:
            async with self._places:
                own.placed = True
                yield
        finally:
            self.frames = [frame for frame in self.frames if frame is not own]


class Streams:
    """The streams of one event loop. limit: how many at once; clock: seconds, steady."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.limit = limit
        self._clock = clock
        self._open: dict[str, Stream] = {}

    def __len__(self) -> int:
        self._expire()
        return len(self._open)

    def open(self, scene: Scene, quality: Quality) -> Stream | None:
        """Open a stream, or return None where all are taken."""
        if len(self) >= self.limit:
            return None
        stream = Stream(secrets.token_urlsafe(12), scene, quality, self._clock() + LEASE_SECONDS)
        self._open[stream.id] = stream
        return stream

    def find(self, id: str) -> Stream | None:
        """Return a stream, whose lease begins anew, or None if it has ended."""
        self._expire()
        if (stream := self._open.get(id)) is not None:
            self.renew(stream)
        return stream

    def renew(self, stream: Stream) -> None:
        stream.expires = self._clock() + LEASE_SECONDS

    def has_frame(self, path: str) -> bool:
        """Whether a request's path is that of a frame of a stream that has not ended."""
        self._expire()
        match = _FRAME.match(path)
        return match is not None and match[1] in self._open

    def close(self, id: str) -> None:
        """End a stream, if it has not ended, and give up its frames: else streams that follow each other have many."""
        if (stream := self._open.pop(id, None)) is not None:
            for frame in stream.frames:
                frame.task.cancel()

    def _expire(self) -> None:
        now = self._clock()
        # A frame may take longer than the lease.
        for id in [id for id, stream in self._open.items() if stream.expires < now and not stream.frames]:
            del self._open[id]
