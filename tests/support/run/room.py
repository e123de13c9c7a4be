"""No process of a run of the tests may be larger than 2 GB: two of them, a browser and an editor share 8 GB."""

import ctypes
import resource
import sys

import pytest

LIMIT = 2_000_000_000
"""Resident bytes, at their most, of the test process and of each process that it or its children started."""
UNIT = 1 if sys.platform == "darwin" else 1024
"""Of ``ru_maxrss``, bytes."""


def peaks() -> dict[str, int]:
    """Most bytes that were ever resident: of this process, and of the largest one below it that has ended."""
    kinds = {"the tests": resource.RUSAGE_SELF, "a process that they started": resource.RUSAGE_CHILDREN}
    return {who: resource.getrusage(kind).ru_maxrss * UNIT for who, kind in kinds.items()}


def resident() -> int:
    """Bytes that are resident now; where the system does not say, the most that ever were."""
    try:
        with open("/proc/self/statm", encoding="ascii") as said:
            return int(said.read().split()[1]) * resource.getpagesize()
    except OSError:
        return peaks()["the tests"]


def give_back() -> None:
    """Have the allocator return what is free: glibc keeps it, and a process that has forgotten programs looks full."""
    if sys.platform == "linux":
        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
        if trim is not None:
            trim(0)


class Room:
    """The plugin: a run in which a process grew past ``limit`` bytes fails, whatever its tests say."""

    def __init__(self, limit: int = LIMIT) -> None:
        self._limit = limit

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if max(peaks().values()) > self._limit:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for who, peak in peaks().items():
            told = f"Memory at its most: {who}, {peak / 1e6:.0f} of {self._limit / 1e6:.0f} MB"
            over = peak > self._limit
            terminalreporter.write_line(f"FAILED: {told}" if over else told, red=over)
