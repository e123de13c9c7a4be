"""A frame's programs compiled by two processes: a software driver compiles at the first draw, on one core, and finds on
disk what another process has compiled.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Self

from seafoam.files import write_whole
from seafoam.framegraph.plan import FramePlan
from seafoam.render.gl.formats import Output
from seafoam.scene.camera import Camera

COLD_SECONDS = 0.1
"""Processor time, s: a program that takes longer to translate is new to the driver. A plan's largest takes 0.15 and
more, or 0.02 to 0.05 where the driver has kept it."""
WAIT_SECONDS = 60.0
"""Time after which a driver hangs; what the process has not compiled is compiled here."""
_REQUEST = "request"
_START = "from seafoam.render.gl.executor import compile_beside; compile_beside()"


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
    device: int | None = None


@dataclass(frozen=True)
class Claims:
    """Which of two processes compiles the program of a pass: the first that asks. ``folder``: theirs alone."""

    folder: Path

    def claimed(self, passes: Iterable[int]) -> Iterator[int]:
        """Yield those passes that the other process has not taken; from then on they are this one's."""
        for index in passes:
            try:
                (self.folder / str(index)).mkdir()
            except FileExistsError:
                continue
            yield index


class SecondCompiler:
    """A process that compiles a frame's programs beside this one; ends with the context."""

    def __init__(self, request: CompileRequest) -> None:
        self._folder = TemporaryDirectory(prefix="seafoam-", ignore_cleanup_errors=True)
        self.claims = Claims(Path(self._folder.name))
        write_whole(self.claims.folder / _REQUEST, pickle.dumps(request))
        self._process = subprocess.Popen(
            [sys.executable, "-c", _START, self._folder.name],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "LP_NUM_THREADS": "1"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()

    def wait_for(self, own: int) -> None:
        """Wait for the programs that the process has taken, if any; ``own``: how many this one has."""
        if sum(each.is_dir() for each in self.claims.folder.iterdir()) > own:
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(WAIT_SECONDS)


def driver_keeps() -> bool:
    """Whether the driver may keep compiled programs, so that another process finds them."""
    return os.environ.get("MESA_SHADER_CACHE_DISABLE", "").lower() not in ("1", "true")


def received() -> tuple[CompileRequest, Claims]:
    """Return what the second process is to do."""
    folder = Path(sys.argv[1])
    request: CompileRequest = pickle.loads((folder / _REQUEST).read_bytes())
    return request, Claims(folder)
