"""Frames of a sequence: times, identity, errors, and who draws them, behind one small interface."""

import hashlib
import math
import re
from collections.abc import Generator, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib.metadata import version
from typing import Any, Literal, Protocol

from seafoam.numerals import numeral
from seafoam.render.service.jobs import FrameJob, Renderer, described, plan_hash, render_frame, renderer_of

OutputField = Literal["width", "height", "fps", "stop"]


class SequenceError(Exception):
    """Base class of errors that end a sequence. Finished frames stay on disk."""


class OtherSequenceError(SequenceError):
    """The directory holds frames of another sequence, or files that are not ours."""


class OutputError(SequenceError):
    """The output cannot hold the sequence. ``field``: what to change; the text names it."""

    def __init__(self, field: OutputField, detail: str) -> None:
        super().__init__(detail)
        self.field = field


class MixedFleetError(SequenceError):
    """Workers have different renderers, whose frames differ."""


class SequenceStoppedError(SequenceError):
    """The sequence was cancelled."""


LEAST_FPS, GREATEST_FPS = 0.001, 1000.0
"""Frames a second."""
GREATEST_DENOMINATOR = 1_000_000
"""Of a rate: numerator and denominator fit the 32 bits that containers have."""
_BROADCAST = [Fraction(1000 * whole, 1001) for whole in (24, 30, 48, 60, 120, 240)]
"""What colour television made of whole numbers of frames a second."""
MOST_FRAMES = 1_000_000
"""Frames of a sequence: their names have six digits."""
GREATEST_TIME = 1e9
"""s."""
_ROUNDING = 1e-6
"""Share of a frame by which a stop may miss a frame's time: 0.1 s is no whole number of frames in binary."""


@dataclass(frozen=True, slots=True)
class SequenceSpec:
    """Frames at ``job.time + i / fps`` before ``stop``, s; at least one.

    job: scene, quality, camera, size; its time is the start, its format ``png``.
    """

    job: FrameJob
    stop: float
    fps: Fraction

    @property
    def count(self) -> int:
        return max(1, math.ceil((self.stop - self.job.time) * float(self.fps) - _ROUNDING))

    def frame(self, index: int) -> FrameJob:
        """Return the job of a frame, whose time is not summed up, so that it is exact in long sequences."""
        return replace(self.job, time=self.job.time + float(index / self.fps))

    def identity(self, info: Mapping[str, str]) -> dict[str, Any]:
        """Return all that the bytes of frame i depend on, as JSON values; not the stop, so a sequence can be continued.

        info: the renderer's ``renderer`` and ``version``. Raises :class:`seafoam.planner.PlanError`.
        """
        job = self.job
        return {
            "plan": plan_hash(job.scene, job.quality),
            # The recipe in each frame also has what the plan leaves out.
            "scene": hashlib.sha256(job.scene.model_dump_json().encode()).hexdigest(),
            "preset": job.preset,
            "quality": described(job.quality),
            "camera": job.camera.model_dump(mode="json"),
            "width": job.width,
            "height": job.height,
            "start": job.time,
            "fps": float(self.fps) if float(self.fps) == self.fps else str(self.fps),
            "renderer": renderer_of(info),
            "seafoam": version("seafoam"),
        }


def rate_of(fps: float | str) -> Fraction:
    """Return a rate in frames a second, from a number or a fraction such as ``30000/1001``.

    A number within 0.005 of a broadcast rate becomes that: 29.97 is 30000/1001, 23.976 and 23.98 are 24000/1001. Any
    other is what its decimals say. Raises :class:`OutputError`.
    """
    ratio = re.fullmatch(r"([0-9]{1,12})/([0-9]{1,12})", str(fps))
    try:
        if ratio:
            rate = Fraction(int(ratio[1]), int(ratio[2]))
        else:
            given = float(numeral(fps))
            near = (rate for rate in _BROADCAST if abs(given - rate) < 0.005)
            rate = next(near, Fraction(repr(given)).limit_denominator(GREATEST_DENOMINATOR))
    except (ValueError, ZeroDivisionError):
        rate = Fraction(0)
    if not LEAST_FPS <= float(rate) <= GREATEST_FPS or rate.denominator > GREATEST_DENOMINATOR:
        raise OutputError(
            "fps",
            f"fps must be {LEAST_FPS:g} to {GREATEST_FPS:g} frames a second, a number or a fraction such as 30000/1001 "
            f"with a denominator of at most {GREATEST_DENOMINATOR}, not {fps:.40}",
        )
    return rate


def sequence_of(job: FrameJob, stop: float, fps: float | str) -> SequenceSpec:
    """Return a checked sequence. Raises :class:`OutputError` that names ``fps`` or ``stop`` and what is allowed."""
    rate = rate_of(fps)
    last = min(GREATEST_TIME, job.time + float(MOST_FRAMES / rate))
    if not job.time < stop <= last:
        raise OutputError("stop", f"stop must be above the start and at most {last:.12g} s, not {stop:g}")
    return SequenceSpec(job, stop, rate)


Units = Iterable[tuple[int, FrameJob]]
"""Units of work: the number of a frame, and all that its bytes depend on."""
DrawnFrames = Generator[tuple[int, bytes], None, None]
"""Encoded frames with their numbers."""


class Workers(Protocol):
    """Draws frames."""

    @property
    def info(self) -> Mapping[str, str]:
        """The renderer's ``vendor``, ``renderer`` and ``version``."""

    def draw(self, units: Units) -> DrawnFrames:
        """Draw frames, in any order, and return each encoded with its number; none is lost.

        Closing the generator ends the work. Raises what drawing raises.
        """


class InProcess:
    """Draws with a renderer of this process, in the thread that created it."""

    def __init__(self, renderer: Renderer) -> None:
        self._renderer = renderer

    @property
    def info(self) -> Mapping[str, str]:
        return self._renderer.info

    def draw(self, units: Units) -> DrawnFrames:
        for index, job in units:
            yield index, render_frame(self._renderer, job).content
