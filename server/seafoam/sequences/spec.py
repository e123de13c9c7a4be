"""What a sequence is: frames of one scene at regular times."""

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import Any

from seafoam.planner import make_plan
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.recipe import described
from seafoam.sequences.errors import OutputError

LEAST_FPS, GREATEST_FPS = 0.001, 1000.0
"""Frames a second."""
MOST_FRAMES = 1_000_000
"""Frames of a sequence: their names have six digits."""
GREATEST_TIME = 1e9
"""s."""
_ROUNDING = 1e-6
"""Share of a frame by which a stop may miss a frame's time: 0.1 s is no whole number of frames in binary."""


@dataclass(frozen=True, slots=True)
class SequenceSpec:
    """Frames at ``start + i / fps`` before ``stop``, s; at least one.

    job: scene, quality, camera, size; its time is the start, its format ``png``.
    """

    job: FrameJob
    stop: float
    fps: float

    @property
    def start(self) -> float:
        """Time of the first frame, s."""
        return self.job.time

    @property
    def count(self) -> int:
        """Number of frames."""
        return frame_count(self.start, self.stop, self.fps)

    def frame(self, index: int) -> FrameJob:
        """Return the job of a frame, whose time is not summed up, so that it is exact in long sequences."""
        return replace(self.job, time=self.start + index / self.fps)

    def identity(self, info: Mapping[str, str]) -> dict[str, Any]:
        """Return all that the bytes of frame i depend on, as JSON values; not the stop, so a sequence can be continued.

        info: the renderer's ``renderer`` and ``version``. Raises :class:`seafoam.planner.PlanError`.
        """
        job = self.job
        return {
            "plan": make_plan(job.scene, job.quality).sha256,
            # The recipe in each frame also has what the plan leaves out.
            "scene": hashlib.sha256(job.scene.model_dump_json().encode()).hexdigest(),
            "preset": job.preset,
            "quality": described(job.quality),
            "camera": job.camera.model_dump(mode="json"),
            "width": job.width,
            "height": job.height,
            "start": self.start,
            "fps": self.fps,
            "renderer": f"{info['renderer']}, {info['version']}",
            "seafoam": version("seafoam"),
        }


def sequence_of(job: FrameJob, stop: float, fps: float) -> SequenceSpec:
    """Return a checked sequence. Raises :class:`OutputError` that names ``fps`` or ``stop`` and what is allowed."""
    if not LEAST_FPS <= fps <= GREATEST_FPS:
        raise OutputError("fps", f"fps must be {LEAST_FPS:g} to {GREATEST_FPS:g} frames a second, not {fps:g}")
    last = min(GREATEST_TIME, job.time + MOST_FRAMES / fps)
    if not job.time < stop <= last:
        raise OutputError("stop", f"stop must be above the start and at most {last:.12g} s, not {stop:g}")
    return SequenceSpec(job, stop, fps)


def frame_count(start: float, stop: float, fps: float) -> int:
    """Return the number of frames from ``start`` to before ``stop`` (s), at least one."""
    return max(1, math.ceil((stop - start) * fps - _ROUNDING))
