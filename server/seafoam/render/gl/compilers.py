"""A frame's programs compiled by two processes: a software driver compiles at the first draw, on one core, and finds on
disk what another process has compiled.
"""

import os
import pickle
import signal
import sys
import warnings
from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain, pairwise
from select import select

from seafoam.framegraph.plan import FramePlan
from seafoam.render.gl.formats import Output
from seafoam.scene import Camera

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


CompileWork = Callable[[CompileRequest, Iterable[int]], None]
"""What compiles the programs of those passes of a request that it is given."""


class SecondCompiler:
    """A process that compiles frames' programs beside this one, until it is closed or this process ends.

    Forked while this process has no GL context: what it needs is imported. ``start``: called in it, once.
    """

    def __init__(self, start: Callable[[], CompileWork]) -> None:
        # Passes that no process has taken: each takes the next, and none that ends keeps the other from it.
        self._passes, self._offered = os.pipe()
        os.set_blocking(self._passes, False)
        requests, send = os.pipe()
        self._replies, reply = os.pipe()
        self._asked = False
        with warnings.catch_warnings():
            # Python warns of threads, which a fork has not; numpy's stop before it, and the work needs no others.
            warnings.simplefilter("ignore", DeprecationWarning)
            self.process = os.fork()
        if self.process == 0:
            with suppress(BaseException):
                _serve(requests, reply, self._passes, start)
            os._exit(0)
        os.close(requests)
        os.close(reply)
        self._requests = open(send, "wb")  # noqa: SIM115

    def ask(self, request: CompileRequest) -> Iterator[int]:
        """Have it compile what this process does not; return the passes of this one, of which the first is sure."""
        self.wait()
        self.withdraw()
        os.write(self._offered, array(_INDEX, request.passes[1:]).tobytes())
        with suppress(OSError):
            pickle.dump(request, self._requests)
            self._requests.flush()
            self._asked = True
        return chain(request.passes[:1], _taken(self._passes))

    def withdraw(self) -> None:
        """Leave nothing to do of what it was asked for."""
        for _ in _taken(self._passes):
            pass

    def wait(self) -> None:
        """Wait until it has done its part of what it was asked for, or has ended."""
        if self._asked and select((self._replies,), (), (), WAIT_SECONDS)[0]:
            os.read(self._replies, 1)
        elif self._asked:
            os.kill(self.process, signal.SIGKILL)
        self._asked = False

    def close(self) -> None:
        """End it."""
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        with suppress(OSError):
            self._requests.close()
        for pipe in (self._passes, self._offered, self._replies):
            os.close(pipe)


def driver_keeps() -> bool:
    """Whether the driver may keep compiled programs, so that another process finds them."""
    return os.environ.get("MESA_SHADER_CACHE_DISABLE", "").lower() not in ("1", "true")


def may_assist() -> bool:
    """Whether a second process is of use: two cores, no GL context here yet, and a driver that may keep programs."""
    fresh = "glcontext.egl" not in sys.modules  # which opens the driver's libraries, whoever used it
    return driver_keeps() and fresh and hasattr(os, "fork") and (os.cpu_count() or 1) > 1


def _taken(passes: int) -> Iterator[int]:
    """Take passes from a pipe while there are any."""
    with suppress(BlockingIOError):
        while index := os.read(passes, array(_INDEX).itemsize):
            yield array(_INDEX, index)[0]


def _serve(requests: int, replies: int, passes: int, start: Callable[[], CompileWork]) -> None:
    """The second process: work on requests until the first process ends or closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    # Files, pipes and sockets are the first process's.
    null = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(null, stream)
    for below, above in pairwise((2, *sorted((requests, replies, passes)), os.sysconf("SC_OPEN_MAX"))):
        os.closerange(below + 1, above)
    os.environ["LP_NUM_THREADS"] = "1"
    work = start()
    with open(requests, "rb") as stream_of_requests:
        while True:
            request: CompileRequest = pickle.load(stream_of_requests)
            work(request, _taken(passes))
            os.write(replies, b".")
