"""Memory that a worker writes a frame's pixels to and its parent reads them from.

Through a pipe the same pixels take five times as long, in pieces of 64 KiB with a change of processes for each. The
memory has no name and belongs to the parent, so that a worker that dies leaves nothing behind, and it is not limited by
the size of ``/dev/shm``, which containers keep small.
"""

import itertools
import mmap
import os
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

LEAST_BYTES = 1 << 18
"""Size of the smallest memory, bytes."""
KEPT_BYTES = 1 << 25
"""Largest memory that is kept for later frames, bytes: memory that is new costs as much time as the copy."""
KEPT_MAPPINGS = 4
"""Mappings that a worker keeps: two frames for each worker are under way, in one or two sizes."""


@dataclass(frozen=True, slots=True)
class BufferAddress:
    """Where a worker finds the memory. ``serial``: never used again, which the path can be."""

    path: str
    size: int
    serial: int


@dataclass(frozen=True, slots=True)
class SharedPixels:
    """Pixels that were written to the memory: their shape and type."""

    shape: tuple[int, ...]
    dtype: str


class SharedBuffer:
    """Memory for one frame, in the parent."""

    def __init__(self, size: int) -> None:
        size = max(size, LEAST_BYTES)
        self._file = os.memfd_create("seafoam")
        os.ftruncate(self._file, size)
        self._memory = mmap.mmap(self._file, size)
        self.address = BufferAddress(f"/proc/{os.getpid()}/fd/{self._file}", size, next(_serials))

    def received(self, pixels: NDArray[Any] | SharedPixels) -> NDArray[Any]:
        """Return the pixels that a worker sent. They stay valid after :meth:`close`."""
        if not isinstance(pixels, SharedPixels):
            return pixels
        count = int(np.prod(pixels.shape))
        return np.frombuffer(self._memory, pixels.dtype, count).reshape(pixels.shape)

    def close(self) -> None:
        """Close it, once; the memory is freed when nothing refers to its pixels."""
        os.close(self._file)


_serials = itertools.count()


class BufferPool:
    """BufferPool for one event loop, used again when their frame is encoded. limit: how many are kept."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._free: list[SharedBuffer] = []

    def take(self, size: int) -> SharedBuffer:
        for index, buffer in enumerate(self._free):
            if size <= buffer.address.size <= max(4 * size, LEAST_BYTES):
                return self._free.pop(index)
        return SharedBuffer(size)

    def give_back(self, buffer: SharedBuffer) -> None:
        """Take back a buffer to which no worker writes and whose pixels nobody reads any more."""
        if buffer.address.size > KEPT_BYTES:
            buffer.close()
            return
        self._free.append(buffer)
        while len(self._free) > self._limit:
            self._free.pop(0).close()

    def close(self) -> None:
        while self._free:
            self._free.pop().close()


@lru_cache(maxsize=KEPT_MAPPINGS)
def _mapped(address: BufferAddress) -> mmap.mmap:
    file = os.open(address.path, os.O_RDWR)
    try:
        return mmap.mmap(file, address.size)
    finally:
        os.close(file)


def send(pixels: NDArray[Any], address: BufferAddress) -> Any:
    """Write pixels to the parent's memory, in a worker, and return :class:`SharedPixels`, or else the pixels."""
    try:
        memory = _mapped(address)
    except OSError:  # the parent no longer waits and has closed it
        return pixels
    np.copyto(np.frombuffer(memory, pixels.dtype, pixels.size).reshape(pixels.shape), pixels)
    return SharedPixels(pixels.shape, pixels.dtype.str)
