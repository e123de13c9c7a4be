"""ASGI middleware before the API: rates, keys and signed links, and what pages of other sites may read.

Pages, files and health checks pass rates and keys untouched.
"""

import math
import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from ipaddress import IPv6Address, ip_network
from urllib.parse import unquote

from starlette.datastructures import Headers, MutableHeaders
from starlette.middleware.cors import CORSMiddleware
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from seafoam.api.guard.keys import API, CHALLENGE, SIGNED, Access
from seafoam.api.http.errors import ProblemType, problem
from seafoam.api.http.middleware import HttpMiddleware, altering
from seafoam.api.watch.logs import REQUEST_ID
from seafoam.render.service.frame_cache import LruCache

CLIENTS_KEPT = 65_536
"""Clients whose buckets are remembered, 16 MB; one that is forgotten has a full bucket again."""
IPV6_PREFIX = 64
"""Leading bits of an IPv6 address that count: what one subscriber has at least."""


class TokenBuckets:
    """Buckets of ``burst`` tokens that refill with ``rate`` tokens a second; a request takes one.

    clock: seconds that never go back.
    """

    def __init__(self, rate: float, burst: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.rate = rate
        self.burst = burst
        self._clock = clock
        self._full_at: LruCache[str, float] = LruCache(CLIENTS_KEPT)

    def take(self, client: str) -> int:
        """Take a token, and return 0; or, if there is none, the seconds until there is one."""
        now = self._clock()
        full_at = max(self._full_at.get(client) or now, now)
        tokens = self.burst - (full_at - now) * self.rate
        # The sums of many requests round.
        if tokens < 1.0 - 1e-6:
            return math.ceil((1.0 - tokens) / self.rate)
        self._full_at.put(client, full_at + 1.0 / self.rate)
        return 0


def bucket_of(address: str) -> str:
    """Return the name of an address's bucket: the address, or the network of an IPv6 address."""
    try:
        return str(IPv6Address(address).ipv4_mapped or ip_network((address, IPV6_PREFIX), strict=False))
    except ValueError:
        return address


READABLE_ELSEWHERE = (
    "ETag", "Link", "Server-Timing", "Seafoam-Plan", "Seafoam-Renderer", "Retry-After", REQUEST_ID,
)  # fmt: skip
"""Headers that a page of another origin may read, besides those that every page may."""
_SENT = ("Authorization", "Content-Type", "If-None-Match", REQUEST_ID)
_PUBLIC = re.compile(r"/api/((presets|plans)/[^/]+|presets|quality|schema|masks(/.*)?|textures/.*)")
"""What is data, and no picture or work of the renderer."""


class OtherOrigins:
    """ASGI middleware: adds the headers of CORS to every answer, errors included, and answers preflights.

    public: whether every origin may GET what is data; its other methods, and all other paths, only ``origins`` may use.
    """

    def __init__(self, app: ASGIApp, public: bool, origins: Sequence[str]) -> None:
        self.public = public
        cors = partial(CORSMiddleware, app, allow_headers=_SENT, expose_headers=READABLE_ELSEWHERE)
        self.for_all = cors(allow_origins=("*",))
        methods = ("GET", "POST", "PUT", "DELETE")
        self.for_some = cors(allow_origins=origins, allow_methods=methods) if origins else app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"].removeprefix(scope.get("root_path", "")) if scope["type"] == "http" else ""
        await (self.for_all if self.public and _PUBLIC.fullmatch(path) else self.for_some)(scope, receive, send)


_RATE_EXCEEDED = ProblemType(429, "rate-exceeded", "Too many requests")
_UNAUTHORIZED = ProblemType(401, "unauthorized", "A key is required")
_BAD_SIGNATURE = ProblemType(403, "bad-signature", "The link was altered")


@dataclass(eq=False)
class AccessControl(HttpMiddleware):
    """Answers 401 without a key, 403 for an altered link and 429 beyond a client's rate; lets all else in.

    A client is the name of its key, or else its address. rates: absent: any number of requests. An answer to a key is
    ``private``: caches between must not give it to those without; a signed link is its own permission.
    """

    access: Access
    rates: TokenBuckets | None

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"]
        signed = self.access.signing is not None and path.startswith(SIGNED)
        if not (signed or path.startswith(API)):
            await self.app(scope, receive, send)
            return
        name = self.access.name_of(Headers(scope=scope)) if self.access.keys else None
        scope.setdefault("state", {})["client"] = name
        refusal: Response | None = None
        # Frames of an open stream are bounded by the stream, which counts when it is opened.
        if self.rates is not None and not scope["app"].state.context.streams.has_frame(path):
            address = (scope.get("client") or ("",))[0]
            if wait := self.rates.take(f"key {name}" if name else bucket_of(address)):
                most = f"{self.rates.burst} requests at once and {self.rates.rate:g} a second"
                detail = f"more than {most}; the next is allowed in {wait} s"
                refusal = problem(path, _RATE_EXCEEDED, detail, headers={"Retry-After": str(wait)})
        refusal = refusal or self._refusal(scope, signed, name)

        def mark(headers: MutableHeaders) -> None:
            if name and "public" in headers.get("cache-control", ""):
                headers["Cache-Control"] = headers["Cache-Control"].replace("public", "private")
            if signed and "link" in headers:
                # Relative to the address without signature, and not signed itself.
                del headers["link"]

        await (refusal or self.app)(scope, receive, altering(send, mark))

    def _refusal(self, scope: Scope, signed: bool, name: str | None) -> Response | None:
        """Return why a request is not let in, or None. A signed one goes on as the request that was signed."""
        if signed:
            return self._unsign(scope)
        if not self.access.restricted or name:
            return None
        why = "the key is not known" if "authorization" in Headers(scope=scope) else "a key is required"
        otherwise = "; or a signed link" if self.access.signing else ""
        detail = f"{why}, as Authorization: Bearer KEY or as the password of Basic{otherwise}"
        return problem(scope["path"], _UNAUTHORIZED, detail, headers={"WWW-Authenticate": CHALLENGE})

    def _unsign(self, scope: Scope) -> Response | None:
        assert self.access.signing is not None
        raw = scope.get("raw_path") or scope["path"].encode()
        signature, slash, rest = raw.removeprefix(SIGNED.encode()).partition(b"/")
        path = slash + rest
        address = path + (b"?" + scope["query_string"] if scope["query_string"] else b"")
        if not path.startswith(API.encode()) or not self.access.signing.holds(signature.decode("latin-1"), address):
            detail = "the signature is not that of path and query; they must be sent as they were signed"
            return problem(scope["path"], _BAD_SIGNATURE, detail)
        if scope["method"] != "GET":
            detail = f"method {scope['method']} is not allowed for signed links"
            return problem(scope["path"], ProblemType(405), detail, headers={"Allow": "GET, HEAD"})
        # In place: what counts and logs requests reads the route from the same scope.
        scope["raw_path"], scope["path"] = path, unquote(path.decode("latin-1"))
        return None
