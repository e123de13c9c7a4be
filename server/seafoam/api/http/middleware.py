"""ASGI middleware for every request: content codings and entity tags as RFC 9110 has them, limits, security headers."""

import asyncio
import re
from collections.abc import Sequence
from dataclasses import dataclass

from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.types import Message, Receive, Scope, Send

from seafoam.api.http.asgi import CountingSend, HttpMiddleware, altering
from seafoam.api.http.errors import RANGE_PROBLEM, ProblemType, problem
from seafoam.api.http.problems import FieldProblem

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
    """Rejects bodies of more than ``limit`` bytes, by their declared length or as they arrive."""

    limit: int

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        detail = f"the request body exceeds {self.limit:,} bytes"
        announced = Headers(scope=scope).get("content-length", "")
        if announced.isascii() and announced.isdigit() and int(announced) > self.limit:
            await problem(scope["path"], ProblemType(413), detail)(scope, receive, send)
            return
        arrived = 0

        async def counting() -> Message:
            nonlocal arrived
            message = await receive()
            arrived += len(message.get("body", b""))
            if arrived > self.limit:
                # FastAPI lets no other exception pass while it reads a body.
                raise HTTPException(413, detail)
            return message

        await self.app(scope, counting, send)


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
        sent = CountingSend(send)
        try:
            await self.app(scope, receive, sent)
        except asyncio.CancelledError:
            if sent.begun:
                return
            detail, headers = "the server stopped before the answer was made", {"Retry-After": str(RESTART_SECONDS)}
            await problem(scope["path"], _STOPPING, detail, headers=headers)(scope, receive, send)


OFFERED = ("br", "gzip")
"""Codings that answers may have, the better one first: Brotli of files that the build packed, gzip of all text."""
_ALIASES = {"x-gzip": "gzip"}
_ELEMENT = re.compile(r"([!#$%&'*+.^_`|~0-9A-Za-z-]+)\s*(?:;\s*[qQ]=(0(?:\.\d{0,3})?|1(?:\.0{0,3})?)\s*)?")
_SPAN = re.compile(r"(?=.*[0-9])([0-9]{0,18})-([0-9]{0,18})")


def accepted(fields: Sequence[str]) -> list[str]:
    """Return those of :data:`OFFERED` that a client prefers to none, best first (RFC 9110, section 12.5.3).

    fields: lines of Accept-Encoding. What is no coding with a weight from 0 to 1 is passed over. A client that refuses
    ``identity`` and all that is offered gets ``identity`` still, as section 12.1 allows.
    """
    weights: dict[str, float] = {}
    for element in ",".join(fields).split(","):
        if found := _ELEMENT.fullmatch(element.strip()):
            coding = found[1].lower()
            weights[_ALIASES.get(coding, coding)] = float(found[2] or 1.0)
    other = weights.get("*", 0.0)
    least = weights.get("identity", other)
    liked = [coding for coding in OFFERED if weights.get(coding, other) > 0.0]
    preferred = (coding for coding in liked if weights.get(coding, other) >= least)
    return sorted(preferred, key=lambda coding: -weights.get(coding, other))


def _is_range(text: str) -> bool:
    """Whether a Range is of bytes and in order; another must be ignored (RFC 9110, section 14.2)."""
    unit, _, parts = text.partition("=")
    found = [_SPAN.fullmatch(part.strip()) for part in parts.split(",")]
    return unit.strip().lower() == "bytes" and all(
        one and (not (one[1] and one[2]) or int(one[1]) <= int(one[2])) for one in found
    )


class Negotiate(HttpMiddleware):
    """ASGI middleware: what lies within finds Accept-Encoding reduced to :func:`accepted`, lists on one line, and no
    malformed Range.

    A tag of what was compressed is made weak, since the same bytes without a coding have it too; 304 has the tag that
    the client has, and Vary as its 200. Any copy is current (``If-None-Match: *``) of what has no tag, too. A range
    outside of a file is a problem (416), for which Starlette has no words.
    """

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        headers = Headers(scope=scope)
        known = ", ".join(headers.getlist("if-none-match"))
        joined = {"accept-encoding": ", ".join(accepted(headers.getlist("accept-encoding"))), "if-none-match": known}
        others = [(name, value) for name, value in scope["headers"] if name.decode("latin-1").lower() not in joined]
        if not _is_range(headers.get("range", "")):
            others = [(name, value) for name, value in others if name.lower() != b"range"]
        scope["headers"] = others + [
            (name.encode(), value.encode("latin-1")) for name, value in joined.items() if value
        ]

        def mark(status: int, own: MutableHeaders) -> None:
            unmodified = status == 304
            varying = [each.strip() for line in own.getlist("vary") for each in line.split(",")]
            if varying or unmodified:
                varying += ["Accept-Encoding"] * unmodified
                own["Vary"] = ", ".join(dict.fromkeys(varying))
            tag = own.get("etag", "W/")
            if not tag.startswith("W/") and ("content-encoding" in own or (unmodified and f"W/{tag}" in known)):
                own["ETag"] = f"W/{tag}"

        answering = altering(send, mark)
        any_copy = known.strip() == "*" and scope["method"] in ("GET", "HEAD")
        replaced = False

        async def explaining(message: Message) -> None:
            nonlocal replaced
            if message["type"] == "http.response.start":
                other = _instead(message["status"], Headers(raw=message["headers"]), scope["path"], any_copy)
                replaced = other is not None
                if other is not None:
                    await other(scope, receive, answering)
            if not replaced:
                await answering(message)

        await self.app(scope, receive, explaining)


def _instead(status: int, headers: Headers, path: str, any_copy: bool) -> Response | None:
    """Return what is answered in place of an empty answer 416, and of a whole 200 where any copy is current."""
    if status == 416:
        total = headers["content-range"]
        last = int(total.removeprefix("bytes */")) - 1
        detail, allowed = f"Range: the file has bytes 0 to {last}", {"minimum": 0, "maximum": last}
        errors = [FieldProblem(parameter="Range", detail=detail, allowed=allowed)]
        return problem(path, RANGE_PROBLEM, detail, errors=errors, headers={"Content-Range": total})
    if any_copy and status == 200 and "content-length" in headers:  # events have none, and are sent
        unmodified = Response(status_code=304)
        content = (b"content-length", b"content-type", b"content-encoding")
        unmodified.raw_headers = [pair for pair in headers.raw if pair[0] not in content]
        return unmodified
    return None
