"""Errors of a render service."""

from typing import Literal


class RenderError(Exception):
    """Base class of errors that prevent a frame from being rendered."""


class FrameTooLargeError(RenderError):
    """The frame exceeds the size limits. ``field``: what to lower; its bounds are inclusive."""

    def __init__(self, field: Literal["width", "height", "quality"], detail: str, least: int, greatest: int) -> None:
        super().__init__(detail)
        self.field = field
        self.least = least
        self.greatest = greatest


class RenderQueueFullError(RenderError):
    """The render queue is full; retry after ``retry_after`` seconds."""

    def __init__(self, waiting: int, retry_after: int) -> None:
        super().__init__(f"the render queue is full: {waiting} frames are waiting")
        self.retry_after = retry_after


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
        """The text."""
        return str(self)


class RenderFailedError(RenderError):
    """A worker raised an error or crashed while rendering."""
