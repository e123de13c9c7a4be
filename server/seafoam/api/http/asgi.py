"""What ASGI middleware of this package has in common."""

from collections.abc import Callable
from dataclasses import dataclass

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send


@dataclass(eq=False)
class HttpMiddleware:
    """ASGI middleware for HTTP requests, in :meth:`_handle`; anything else passes untouched."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await (self._handle if scope["type"] == "http" else self.app)(scope, receive, send)

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        raise NotImplementedError


def altering(send: Send, alter: Callable[[int, MutableHeaders], None]) -> Send:
    """Return a ``send`` that lets ``alter`` change the headers of an answer, by its status, before they are sent."""

    async def altered(message: Message) -> None:
        if message["type"] == "http.response.start":
            alter(message["status"], MutableHeaders(scope=message))
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
