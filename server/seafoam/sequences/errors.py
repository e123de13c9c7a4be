"""Errors of sequences."""

from typing import Literal

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
