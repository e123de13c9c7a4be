"""What a process asks of glibc's allocator, by ``mallopt`` (``malloc.h``); other C libraries are left as they are."""

import ctypes
import sys

_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8


def share_one_arena() -> None:
    """Serve all threads from one arena; call it before any are started.

    With one for each, a server keeps what its threads free: 1 to 2 MB for every 1,000 requests (docs/operations.md).
    """
    _set(_ARENA_MAX, 1)


def keep_freed_memory() -> None:
    """Keep 64 MB of freed memory: to map llvmpipe's 28 MB of triangles of ``shallows`` anew took 9 % of each frame."""
    _set(_TRIM_THRESHOLD, 64 << 20)
    # This ends glibc's own choice of what is mapped by itself: all larger than a picture of 1280 × 720, 3.5 MB.
    _set(_MMAP_THRESHOLD, 4 << 20)


def _set(option: int, value: int) -> None:
    if sys.platform == "linux" and (mallopt := getattr(ctypes.CDLL(None), "mallopt", None)):
        mallopt(option, value)
