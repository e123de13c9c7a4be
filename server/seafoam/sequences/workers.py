"""Who draws the frames of a sequence, behind one small interface."""

from collections.abc import Generator, Iterable, Mapping
from typing import Protocol

from seafoam.render.service.jobs import FrameJob, Renderer, render_frame

Unit = tuple[int, FrameJob]
"""A unit of work: the number of a frame, and all that its bytes depend on."""


Units = Iterable[Unit]
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
        """The renderer's ``vendor``, ``renderer`` and ``version``."""
        return self._renderer.info

    def draw(self, units: Units) -> DrawnFrames:
        """Draw frames one after the other."""
        for index, job in units:
            yield index, render_frame(self._renderer, job).content
