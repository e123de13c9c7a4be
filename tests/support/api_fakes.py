"""Renderers for tests, importable by spawned workers."""

import os
import resource
import signal
import time as clock
from dataclasses import dataclass
from pathlib import Path
from zlib import crc32

import numpy as np

from seafoam.render.gl.executor import NoRendererError
from seafoam.render.service.worker import CANARY_SIDE

HANG = 777.0
CRASH = 666.0
RAISE = 555.0
SLOW = 444.0
SLOW_SECONDS = 0.5
COMPILING_SECONDS = 4.0
GREEDY = 222.0
LOST = "SEAFOAM_TEST_LOST"
"""Variable that names a file; a :class:`LostRenderer` that finds it loses its context."""
REMEDY = "no OpenGL context: none here; install a driver"


@dataclass
class FakeRendered:
    pixels: np.ndarray
    timings: dict[str, float]


class FakeRenderer:
    """Draws a gradient that depends on everything a frame depends on; some times make it misbehave.

    It never does so at the size of test pictures, at which programs are compiled.
    """

    def __init__(self, *, assisted: bool = False, optimized: bool = True) -> None:
        self.optimized = optimized
        self.info = {"vendor": "Nobody", "renderer": "gradient", "version": "0"}

    def render(self, plan, *, time, camera, width, height, output):
        match None if width == height == CANARY_SIDE else time:
            case 777.0:
                clock.sleep(600)
            case 666.0:
                os.kill(os.getpid(), signal.SIGKILL)
            case 555.0:
                raise ValueError("secret of the driver")
            case 444.0:
                clock.sleep(SLOW_SECONDS)
            case 222.0:
                # What is left of its limit is too little for the frame.
                resource.setrlimit(resource.RLIMIT_AS, (1 << 20, resource.RLIM_INFINITY))
                np.ones((8192, 8192))
        seed = crc32(repr((plan.sha256, time, camera)).encode())
        ramp = np.linspace(0.0, 1.0, width * height * 4).reshape(height, width, 4)
        pixels = {
            "linear": ramp.astype(np.float32),
            "rgba8": (ramp * 250).astype(np.uint8),
            "rgba16": (ramp * 250 * 257).astype(np.uint16),
        }[output]
        # No two of the tests' frames are alike by chance.
        pixels[0, 0, :3] = [(seed >> shift & 255) * (257 if output == "rgba16" else 1) for shift in (0, 8, 16)]
        return FakeRendered(pixels, {"render": 0.001, "read": 0.001})


class CompilingRenderer(FakeRenderer):
    """Takes long for the first frame of each plan."""

    def __init__(self) -> None:
        super().__init__()
        self.compiled = set()

    def render(self, plan, *, time, camera, width, height, output):
        if plan.sha256 not in self.compiled:
            clock.sleep(COMPILING_SECONDS)
            self.compiled.add(plan.sha256)
        return super().render(plan, time=time, camera=camera, width=width, height=height, output=output)


class LostRenderer(FakeRenderer):
    """Loses its context when a file says so, and takes the file away: its successor's is sound."""

    lost = False

    def render(self, plan, *, time, camera, width, height, output):
        drawn = super().render(plan, time=time, camera=camera, width=width, height=height, output=output)
        told = Path(os.environ[LOST])
        if told.exists():
            told.unlink()
            self.lost = True
        return FakeRendered(0 * drawn.pixels, drawn.timings) if self.lost else drawn


class BlankRenderer(FakeRenderer):
    """Draws nothing, as a lost context does."""

    def render(self, plan, *, time, camera, width, height, output):
        return FakeRendered(np.zeros((height, width, 4), np.uint8), {"render": 0.0, "read": 0.0})


class DyingRenderer(FakeRenderer):
    """Takes its process along when it starts."""

    def __init__(self) -> None:
        os.kill(os.getpid(), signal.SIGKILL)


def no_renderer():
    """A machine without GL."""
    raise NoRendererError(REMEDY)
