"""Streams: frames in motion for pages that do not draw themselves, a bounded number of them."""

import asyncio
import math
import secrets
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from seafoam.quality import Quality
from seafoam.render.service.slots import Turn
from seafoam.scene.models import Scene

LEASE_SECONDS = 10.0
"""Time without a request after which a stream ends, s."""
FRAMES_AT_ONCE = 2
"""Frames of one stream that may be drawn or wait: one is drawn while the one before it travels."""
_PATH = "/api/streams/"


def is_frame(path: str) -> bool:
    """Whether a request's path is that of a stream's frame."""
    return path.startswith(_PATH) and "/frame." in path


@dataclass(eq=False, slots=True)
class Stream:
    """One page's frames. ``expires``: of the registry's clock, s."""

    id: str
    scene: Scene
    quality: Quality
    expires: float
    frames: list[tuple[Turn, asyncio.Task[object]]] = field(default_factory=list)
    """Those that are drawn or wait, in order of arrival."""

    @contextmanager
    def place(self, turn: Turn, waits: Callable[[Turn], bool]) -> Iterator[None]:
        """Hold a place for the current task's frame; where all are taken, the oldest frame that waits is given up.

        waits: whether a frame has not been begun.
        """
        task = asyncio.current_task()
        assert task is not None
        if len(self.frames) >= FRAMES_AT_ONCE:
            oldest = next((frame for frame in self.frames if waits(frame[0])), self.frames[0])
            self.frames.remove(oldest)
            oldest[1].cancel()
        self.frames.append((turn, task))
        try:
            yield
        finally:
            self.frames = [frame for frame in self.frames if frame[1] is not task]


class Streams:
    """The streams of one event loop. limit: how many at once; clock: seconds, steady."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.limit = limit
        self.seconds_per_megapixel: float | None = None
        """Of late, from a request to its frame without waiting; None: no frame yet."""
        self._clock = clock
        self._open: dict[str, Stream] = {}

    def __len__(self) -> int:
        self._expire()
        return len(self._open)

    @property
    def retry_after(self) -> int:
        """Seconds until a place may be free: when the stream that was asked least lately would end."""
        first = min((stream.expires for stream in self._open.values()), default=math.inf)
        return max(1, math.ceil(min(first - self._clock(), LEASE_SECONDS)))

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
        stream = self._open.get(id)
        if stream is not None:
            stream.expires = self._clock() + LEASE_SECONDS
        return stream

    def close(self, id: str) -> None:
        """End a stream, if it has not ended."""
        self._open.pop(id, None)

    def drawn(self, pixels: int, seconds: float) -> None:
        """Note how long a frame took, without waiting."""
        rate = 1e6 * seconds / pixels
        known = self.seconds_per_megapixel
        self.seconds_per_megapixel = rate if known is None else known + 0.2 * (rate - known)

    def _expire(self) -> None:
        now = self._clock()
        for id in [id for id, stream in self._open.items() if stream.expires < now]:
            del self._open[id]
