"""ASGI middleware for every request."""

import asyncio

from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seafoam.api.http.asgi import HttpMiddleware, altering
from seafoam.api.http.errors import ProblemType, problem

CONTENT_SECURITY_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' blob: data:",
        "connect-src 'self'",
        "font-src 'self'",
        "worker-src 'self'",
        "manifest-src 'self'",
        "base-uri 'self'",
        "form-action 'none'",
        "frame-ancestors 'self'",
    )
)
_PAGE_HEADERS = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "strict-origin-when-cross-origin",
    "X-Frame-Options": "SAMEORIGIN",
}


RESTART_SECONDS = 5
"""Retry-After of a server that stops, s: time in which another takes its place."""
_STOPPING = ProblemType(503, "stopping", "The server stops")


class HeadAsGet(HttpMiddleware):
    """Answers HEAD like GET, without the body."""

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def bodiless(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        inner = {**scope, "method": "GET"}
        try:
            await self.app(inner, receive, bodiless)
        finally:
            # By which requests are logged, outside.
            scope["route"] = inner.get("route")


class LimitBody(HttpMiddleware):
    """Rejects bodies of more than ``limit`` bytes, by their declared length or as they arrive."""

    def __init__(self, app: ASGIApp, limit: int) -> None:
        super().__init__(app)
        self.limit = limit

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        announced = Headers(scope=scope).get("content-length", "")
        if announced.isascii() and announced.isdigit() and int(announced) > self.limit:
            await problem(scope["path"], ProblemType(413), self._detail)(scope, receive, send)
            return
        arrived = 0

        async def counting() -> Message:
            nonlocal arrived
            message = await receive()
            arrived += len(message.get("body", b""))
            if arrived > self.limit:
                # FastAPI lets no other exception pass while it reads a body.
                raise HTTPException(413, self._detail)
            return message

        await self.app(scope, counting, send)

    @property
    def _detail(self) -> str:
        return f"the request body exceeds {self.limit:,} bytes"


class SecurityHeaders(HttpMiddleware):
    """Adds the security headers: ``nosniff`` to every response, and to HTML pages a policy for what they may load.

    Pages run and load nothing but files of this server, without inline scripts and styles. Pictures that a page makes
    itself have ``blob:`` and ``data:`` addresses. Browsers ignore, with a message, an opener policy over plain HTTP,
    so it is sent over HTTPS only.
    """

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        def secure(_: int, headers: MutableHeaders) -> None:
            headers.setdefault("X-Content-Type-Options", "nosniff")
            if headers.get("content-type", "").startswith("text/html"):
                for name, value in _PAGE_HEADERS.items():
                    headers.setdefault(name, value)
                if scope["scheme"] == "https":
                    headers.setdefault("Cross-Origin-Opener-Policy", "same-origin")

        await self.app(scope, receive, altering(send, secure))


class AnswerWhenStopped(HttpMiddleware):
    """Answers 503 to a request that is cancelled, because the server stops before it is finished.

    The cancellation ends here: uvicorn would write a traceback for each, and answer with a plain 500. Where the answer
    has begun, uvicorn closes the connection, so that nobody takes it for whole.
    """

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
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
            detail, headers = "the server stopped before the answer was made", {"Retry-After": str(RESTART_SECONDS)}
            await problem(scope["path"], _STOPPING, detail, headers=headers)(scope, receive, send)
