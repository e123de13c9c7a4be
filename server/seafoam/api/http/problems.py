"""Errors that the API raises, and what they say of a field; :mod:`seafoam.api.http.errors` makes answers of them.

Nothing here imports the web framework, for commands use the models of parameters too.
"""

from collections.abc import Sequence
from typing import Any

from pydantic import Field

from seafoam.described import Described


class FieldProblem(Described):
    """An error in one body member or parameter."""

    pointer: str | None = Field(default=None, description="JSON pointer (RFC 6901) into the request body")
    parameter: str | None = Field(default=None, description="Name of the query or path parameter")
    detail: str = Field(description="Description of the error")
    allowed: dict[str, Any] | None = Field(default=None, examples=[{"minimum": 1, "maximum": 4096}])
    """Allowed values: minimum and maximum (inclusive), enum, members, pattern or type"""


class ApiError(Exception):
    """Base class of errors that routers raise.

    Of any error the answer has ``errors`` of fields, a ``remedy`` and, s, ``retry_after``, where it has them.
    """


class NotFoundError(ApiError):
    """A resource does not exist. ``parameter``: path parameter with the wrong name; ``known``: available names."""

    def __init__(self, detail: str, parameter: str, known: Sequence[str] = ()) -> None:
        super().__init__(detail)
        allowed = {"enum": list(known)} if known else None
        self.errors = [FieldProblem(parameter=parameter, detail=detail, allowed=allowed)]


class BadRequestError(ApiError):
    """Parts of the request are invalid."""

    def __init__(self, *errors: FieldProblem) -> None:
        super().__init__("; ".join(error.detail for error in errors))
        self.errors = list(errors)


class UnsupportedMediaError(ApiError):
    """The body is not JSON."""


class ExportTooLargeError(ApiError):
    """The textures of a scene to take home exceed the limit."""


class NotBuiltError(ApiError):
    """The web client is not built. ``remedy``: how to build it."""

    remedy = "run: make webclient"


class BusyError(ApiError):
    """The queue for this kind of work is full; retry after ``retry_after`` seconds."""

    def __init__(self, detail: str, retry_after: int) -> None:
        super().__init__(detail)
        self.retry_after = retry_after


class NotMeasuredError(BusyError):
    """A measurement that the response requires is still running; the text gives its progress."""


class StreamsFullError(BusyError):
    """All streams are taken, or the server gives none."""
