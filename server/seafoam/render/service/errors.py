"""Errors of a render service, and the size limits of frames."""

import math
from dataclasses import dataclass
from typing import Literal


class RenderError(Exception):
    """Base class of errors that prevent a frame from being rendered."""


class FrameTooLargeError(RenderError):
    """The frame exceeds the size limits. ``field``: what to lower, to 1 to ``greatest``."""

    def __init__(self, field: Literal["width", "height", "quality"], detail: str, greatest: int) -> None:
        super().__init__(detail)
        self.field = field
        self.greatest = greatest


class RenderQueueFullError(RenderError):
    """The render queue is full; retry after ``retry_after`` seconds."""

    retry_after = 2


class DeadlineError(RenderError):
    """A frame was not finished before its deadline, waiting included."""


class StartingError(DeadlineError):
    """The renderer does not draw yet; retry after ``retry_after`` seconds."""

    retry_after = 5


class RendererUnavailableError(RenderError):
    """No usable GL. The text gives the remedy; a server looks for one again after ``retry_after`` seconds."""

    retry_after = 60

    @property
    def remedy(self) -> str:
        return str(self)


class RenderFailedError(RenderError):
    """A worker raised an error or crashed while rendering."""


@dataclass(frozen=True, slots=True)
class FrameLimits:
    """Size limits of a frame. Checked before anything is allocated."""

    side: int = 4096
    """Width and height, pixels."""
    sampled_side: int = 8192
    """Width and height times samples along them: limited by the render targets of every supported GL."""
    samples: int = 8_400_000
    """Width × height × samples per pixel."""

    def allows(self, width: int, height: int, samples: int) -> bool:
        """Whether :meth:`check` accepts a frame."""
        try:
            self.check(width, height, samples)
        except FrameTooLargeError:
            return False
        return True

    def check(self, width: int, height: int, samples: int) -> None:
        """Raise :class:`FrameTooLargeError` naming the field to lower; ``samples``: per pixel."""
        along = math.isqrt(samples)
        side = min(self.side, self.sampled_side // along)
        sides: tuple[tuple[Literal["width", "height"], int], ...] = (("width", width), ("height", height))
        for field, value in sides:
            if not 1 <= value <= side:
                why = "" if side == self.side else f" at {samples} samples per pixel"
                raise FrameTooLargeError(field, f"{field} must be 1 to {side} pixels{why}, not {value}", side)
        requested = width * height * samples
        if requested > self.samples:
            max_height = max(1, self.samples // (width * samples))
            asked = f"{width} × {height} pixels with {samples} samples each are {requested:,} samples"
            advice = f"the limit is {self.samples:,}: lower width, height or the quality's samples"
            raise FrameTooLargeError("height", f"{asked}; {advice}", max_height)


IN_PROCESS = FrameLimits(side=8192, sampled_side=16384, samples=16384 * 8192)
"""Greatest frame of a program or a command, which memory limits too."""
