"""Errors of the interface for Python; ``seafoam.render.gl.executor.NoRendererError`` says that OpenGL is missing."""


class InvalidRequestError(ValueError):
    """A value is not allowed; the text names it and what is."""


class ServerError(RuntimeError):
    """A server did not answer, or answered with an error. ``status``: of HTTP; 0 without an answer."""

    def __init__(self, detail: str, status: int = 0) -> None:
        super().__init__(detail)
        self.status = status
