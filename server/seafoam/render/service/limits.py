"""Size limits of frames."""

import math
from dataclasses import dataclass
from typing import Literal

from seafoam.render.service.errors import FrameTooLargeError


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
                raise FrameTooLargeError(field, f"{field} must be 1 to {side} pixels{why}, not {value}", 1, side)
        requested = width * height * samples
        if requested > self.samples:
            max_height = max(1, self.samples // (width * samples))
            raise FrameTooLargeError(
                "height",
                f"{width} × {height} pixels with {samples} samples each are {requested:,} samples; the limit "
                f"is {self.samples:,}: lower width, height or the quality's samples",
                1,
                max_height,
            )


IN_PROCESS = FrameLimits(side=8192, sampled_side=16384, samples=16384 * 8192)
"""Greatest frame of a program or a command, which memory limits too."""
