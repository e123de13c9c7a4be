"""A frame's programs compiled by two processes: a software driver compiles at the first draw, on one core, and finds on
disk what another process has compiled.
"""

import multiprocessing
import os
import signal
import sys
import warnings
from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain, pairwise
from multiprocessing.connection import Connection
from typing import Protocol

from seafoam.framegraph.plan import FramePlan
from seafoam.render.gl.formats import Output
from seafoam.scene.camera import Camera

COLD_SECONDS = 0.1
"""Processor time, s: a program that takes longer to translate is new to the driver. A plan's largest takes 0.15 and
more, or 0.02 to 0.05 where the driver has kept it."""
WAIT_SECONDS = 60.0
"""Time after which a driver hangs; what the process has not compiled is compiled here."""
_INDEX = "H"
"""Type of the indices of passes."""


@dataclass(frozen=True)
class CompileRequest:
    """What decides a frame's programs, and the states in which they draw."""

    plan: FramePlan
    passes: Sequence[int]
    """One for each program and way of drawing with it, in the order of work."""
    camera: Camera
    width: int
    height: int
    output: Output


class CompileWork(Protocol):
    """What compiles the programs of those passes of a request that it is given."""

    def __call__(self, request: CompileRequest, passes: Iterable[int]) -> None: ...


class SecondCompiler:
    """A process that compiles frames' programs beside this one, until it is closed or this process ends.

    Forked while this process has no GL context: what it needs is imported. ``start``: called in it, once.
    """

    def __init__(self, start: Callable[[], CompileWork]) -> None:
        # Passes that no process has taken: each takes the next, and none that ends keeps the other from it.
        self._passes, self._offered = os.pipe()
        os.set_blocking(self._passes, False)
        fork = multiprocessing.get_context("fork")
        self._here, there = fork.Pipe()
        self._asked = False
        self.process = fork.Process(target=_serve, args=(there, self._passes, start), daemon=True)
        with warnings.catch_warnings():
            # Python warns of threads, which a fork has not; numpy's stop before it, and the work needs no others.
            warnings.simplefilter("ignore", DeprecationWarning)
            self.process.start()
        there.close()

    def ask(self, request: CompileRequest) -> Iterator[int]:
        """Have it compile what this process does not; return the passes of this one, of which the first is sure."""
        self.wait()
        os.write(self._offered, array(_INDEX, request.passes[1:]).tobytes())
        with suppress(OSError):
            self._here.send(request)
            self._asked = True
        return chain(request.passes[:1], _taken(self._passes))

    def withdraw(self) -> None:
        """Leave it nothing to do of what it was asked for."""
        for _ in _taken(self._passes):
            pass

    def wait(self) -> None:
        """Wait until it has done its part of what it was asked for, or has ended."""
        if self._asked:
            with suppress(EOFError, OSError):
                if self._here.poll(WAIT_SECONDS):
                    self._here.recv()
                else:
                    self.process.kill()
        self._asked = False

    def close(self) -> None:
        """End it."""
        self.process.kill()
        self.process.join()
        self._here.close()
        os.close(self._passes)
        os.close(self._offered)


def driver_keeps() -> bool:
    """Whether the driver may keep compiled programs, so that another process finds them."""
    return os.environ.get("MESA_SHADER_CACHE_DISABLE", "").lower() not in ("1", "true")


def may_assist() -> bool:
    """Whether a second process is of use: two cores, no GL context here yet, and a driver that may keep programs."""
    forks = "fork" in multiprocessing.get_all_start_methods() and not multiprocessing.current_process().daemon
    # The module that opens the driver's libraries, whoever used it.
    fresh = "glcontext.egl" not in sys.modules
    return driver_keeps() and forks and fresh and (os.cpu_count() or 1) > 1


def _taken(passes: int) -> Iterator[int]:
    """Take passes from a pipe while there are any."""
    with suppress(BlockingIOError):
        while index := os.read(passes, array(_INDEX).itemsize):
            yield array(_INDEX, index)[0]


def _serve(requests: Connection, passes: int, start: Callable[[], CompileWork]) -> None:
    """The second process: work on requests until the first process ends or closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    # Files, pipes and sockets are the first process's.
    null = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(null, stream)
    for below, above in pairwise((2, *sorted((requests.fileno(), passes)), os.sysconf("SC_OPEN_MAX"))):
        os.closerange(below + 1, above)
    os.environ["LP_NUM_THREADS"] = "1"
    work = start()
    with suppress(EOFError, OSError):
        while True:
            request: CompileRequest = requests.recv()
            work(request, _taken(passes))
            requests.send(None)
