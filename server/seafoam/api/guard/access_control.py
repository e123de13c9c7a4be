"""ASGI middleware before the API: rates, keys and signed links. Pages, files and health checks pass it untouched."""

from urllib.parse import unquote

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from seafoam.api.guard.keys import API, CHALLENGE, SIGNED, Access
from seafoam.api.guard.rates import Standing, TokenBuckets, bucket_of, limit_of
from seafoam.api.http.asgi import HttpMiddleware, altering
from seafoam.api.http.errors import ProblemType, problem

_RATE_EXCEEDED = ProblemType(429, "rate-exceeded", "Too many requests")
_UNAUTHORIZED = ProblemType(401, "unauthorized", "A key is required")
_BAD_SIGNATURE = ProblemType(403, "bad-signature", "The link was altered")


class AccessControl(HttpMiddleware):
    """Answers 401 without a key, 403 for an altered link and 429 beyond a client's rate; lets all else in.

    A client is the name of its key, or else its address. rates: absent: any number of requests. An answer to a key is
    ``private``: caches between must not give it to those without; a signed link is its own permission.
    """

    def __init__(self, app: ASGIApp, access: Access, rates: TokenBuckets | None) -> None:
        super().__init__(app)
        self.access = access
        self.rates = rates

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"]
        signed = self.access.signing is not None and path.startswith(SIGNED)
        if not (signed or path.startswith(API)):
            await self.app(scope, receive, send)
            return
        name = self.access.name_of(Headers(scope=scope)) if self.access.keys else None
        scope.setdefault("state", {})["client"] = name
        standing = None
        # Frames of an open stream are bounded by the stream, which counts when it is opened.
        if self.rates is not None and not scope["app"].state.context.streams.has_frame(path):
            address = (scope.get("client") or ("",))[0]
            standing = self.rates.take(f"key {name}" if name else bucket_of(address))
        refusal = self._beyond(scope, standing) or self._refusal(scope, signed, name)

        def mark(_: int, headers: MutableHeaders) -> None:
            if name and "public" in headers.get("cache-control", ""):
                headers["Cache-Control"] = headers["Cache-Control"].replace("public", "private")
            if signed and "link" in headers:
                # Relative to the address without signature, and not signed itself.
                del headers["link"]
            if self.rates is not None and standing is not None:
                headers["RateLimit-Policy"] = self.rates.policy
                headers["RateLimit"] = limit_of(standing)

        await (refusal or self.app)(scope, receive, altering(send, mark))

    def _beyond(self, scope: Scope, standing: Standing | None) -> Response | None:
        if standing is None or standing.allowed or self.rates is None:
            return None
        return problem(
            scope["path"],
            _RATE_EXCEEDED,
            f"more than {self.rates.burst} requests at once and {self.rates.rate:g} a second; "
            f"the next is allowed in {standing.seconds} s",
            headers={"Retry-After": str(standing.seconds)},
        )

    def _refusal(self, scope: Scope, signed: bool, name: str | None) -> Response | None:
        """Return why a request is not let in, or None. A signed one goes on as the request that was signed."""
        if signed:
            return self._unsign(scope)
        if not self.access.restricted or name:
            return None
        sent = "authorization" in Headers(scope=scope)
        return problem(
            scope["path"],
            _UNAUTHORIZED,
            ("the key is not known" if sent else "a key is required")
            + ", as Authorization: Bearer KEY or as the password of Basic"
            + ("; or a signed link" if self.access.signing else ""),
            headers={"WWW-Authenticate": CHALLENGE},
        )

    def _unsign(self, scope: Scope) -> Response | None:
        assert self.access.signing is not None
        raw = scope.get("raw_path") or scope["path"].encode()
        signature, slash, rest = raw.removeprefix(SIGNED.encode()).partition(b"/")
        path = slash + rest
        address = path + (b"?" + scope["query_string"] if scope["query_string"] else b"")
        if not path.startswith(API.encode()) or not self.access.signing.holds(signature.decode("latin-1"), address):
            return problem(
                scope["path"],
                _BAD_SIGNATURE,
                "the signature is not that of path and query; they must be sent as they were signed",
            )
        if scope["method"] != "GET":
            return problem(
                scope["path"],
                ProblemType(405),
                f"method {scope['method']} is not allowed for signed links",
                headers={"Allow": "GET, HEAD"},
            )
        # In place: what counts and logs requests reads the route from the same scope.
        scope["raw_path"], scope["path"] = path, unquote(path.decode("latin-1"))
        return None
