"""What a server that stops answers to requests that it does not finish."""

import asyncio
from http import HTTPStatus

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seafoam.api.http.errors import problem

RESTART_SECONDS = 5
"""Retry-After of a server that stops, s: time in which another takes its place."""


class AnswerWhenStopped:
    """ASGI middleware: answers 503 to a request that is cancelled, because the server stops before it is finished.

    The cancellation ends here: uvicorn would write a traceback for each, and answer with a plain 500. Where the answer
    has begun, uvicorn closes the connection, so that nobody takes it for whole.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        begun = False

        async def noting(message: Message) -> None:
            nonlocal begun
            begun = True
            await send(message)

        try:
            await self.app(scope, receive, noting)
        except asyncio.CancelledError:
            if begun:
                return
            answer = problem(
                scope["path"],
                HTTPStatus.SERVICE_UNAVAILABLE,
                "the server stopped before the answer was made",
                name="stopping",
                title="The server stops",
                headers={"Retry-After": str(RESTART_SECONDS)},
            )
            await answer(scope, receive, send)
