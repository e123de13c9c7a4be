"""How glibc's allocator keeps the server's memory."""

import ctypes
import sys

_M_ARENA_MAX = -8
"""Option of ``mallopt`` (glibc, ``malloc.h``)."""


def share_one_arena() -> None:
    """Have glibc serve all threads from one arena; call it before any are started. Elsewhere it does nothing.

    With an arena for each thread a long-lived server keeps what its threads free: 1 to 2 MB for every 1,000 requests
    (docs/operations.md).
    """
    if sys.platform == "linux":
        mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
        if mallopt is not None:
            mallopt(_M_ARENA_MAX, 1)
