"""What ``seafoam serve`` sets for its process and its workers: the allocator, and where compiled programs are kept."""

import ctypes
import os
import sys
from contextlib import suppress
from pathlib import Path

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


def keep_programs(folder: Path) -> None:
    """Have Mesa keep what it compiles in a folder, unless the environment names one; workers inherit it."""
    if "MESA_SHADER_CACHE_DIR" not in os.environ:
        # Mesa makes the last folder of the path alone, and without it keeps nothing.
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            os.environ["MESA_SHADER_CACHE_DIR"] = str(folder)
