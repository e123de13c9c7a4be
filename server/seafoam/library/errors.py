"""Errors of the interface for Python; ``seafoam.render.gl.executor.NoRendererError`` says that OpenGL is missing."""

from pydantic import ValidationError


class InvalidRequestError(ValueError):
    """A value is not allowed; the text names it and what is."""

    @staticmethod
    def of(where: str, error: ValidationError) -> "InvalidRequestError":
        """Return the errors of a model as one line. ``where``: what was validated, such as ``scene``."""
        lines = []
        for item in error.errors():
            place = "/".join(str(step) for step in (where, *item["loc"]))
            lines.append(f"{place}: {item['msg'].removeprefix('Value error, ')}, not {item['input']!r:.80}")
        return InvalidRequestError("; ".join(lines))


class ServerError(RuntimeError):
    """A server did not answer, or answered with an error. ``status``: of HTTP; 0 without an answer."""

    def __init__(self, detail: str, status: int = 0) -> None:
        super().__init__(detail)
        self.status = status
