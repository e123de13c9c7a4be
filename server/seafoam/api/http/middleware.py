"""ASGI middleware for every request: limits, security headers, stops; what all of it has in common."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass

from starlette.datastructures import MutableHeaders
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seafoam.api.http.errors import ProblemType, problem

CONTENT_SECURITY_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
    "font-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'self'; form-action 'none'; "
    "frame-ancestors 'self'"
)
_PAGE_HEADERS = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "strict-origin-when-cross-origin",
    "X-Frame-Options": "SAMEORIGIN",
}


@dataclass(eq=False)
class HttpMiddleware:
    """ASGI middleware for HTTP requests, in :meth:`_handle`; anything else passes untouched."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await (self._handle if scope["type"] == "http" else self.app)(scope, receive, send)

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        raise NotImplementedError


def altering(send: Send, alter: Callable[[MutableHeaders], None]) -> Send:
    """Return a ``send`` that lets ``alter`` change the headers of an answer before they are sent."""

    async def altered(message: Message) -> None:
        if message["type"] == "http.response.start":
            alter(MutableHeaders(scope=message))
        await send(message)

    return altered


class CountingSend:
    """A ``send`` that notes whether an answer has begun, its status, 500 until then, and the bytes of its body."""

    def __init__(self, send: Send) -> None:
        self.begun = False
        self.status = 500
        self.bytes = 0
        self._send = send

    async def __call__(self, message: Message) -> None:
        self.begun = True
        if message["type"] == "http.response.start":
            self.status = message["status"]
        elif message["type"] == "http.response.body":
            self.bytes += len(message.get("body", b""))
        await self._send(message)


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


@dataclass(eq=False)
class LimitBody(HttpMiddleware):
    """Rejects bodies of more than ``limit`` bytes as they arrive."""

    limit: int

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        arrived = 0

        async def counting() -> Message:
            nonlocal arrived
            message = await receive()
            arrived += len(message.get("body", b""))
            if arrived > self.limit:
                # FastAPI lets no other exception pass while it reads a body.
                raise HTTPException(413, f"the request body exceeds {self.limit:,} bytes")
            return message

        await self.app(scope, counting, send)


class SecurityHeaders(HttpMiddleware):
    """Adds the security headers: ``nosniff`` to every response, and to HTML pages a policy for what they may load.

    Pages run and load nothing but files of this server, without inline scripts and styles. Pictures that a page makes
    itself have ``blob:`` and ``data:`` addresses. Browsers ignore, with a message, an opener policy over plain HTTP,
    so it is sent over HTTPS only.
    """

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        def secure(headers: MutableHeaders) -> None:
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
        sent = CountingSend(send)
        try:
            await self.app(scope, receive, sent)
        except asyncio.CancelledError:
            if sent.begun:
                return
            detail, headers = "the server stopped before the answer was made", {"Retry-After": str(RESTART_SECONDS)}
            await problem(scope["path"], _STOPPING, detail, headers=headers)(scope, receive, send)
