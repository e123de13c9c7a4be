"""ASGI middleware before the API: rates, keys and signed links. Pages, files and health checks pass it untouched."""

from http import HTTPStatus
from urllib.parse import unquote

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seafoam.api.context import Context
from seafoam.api.guard.keys import API, CHALLENGE, SIGNED, Access
from seafoam.api.guard.rates import Standing, TokenBuckets, bucket_of, limit_of
from seafoam.api.http.errors import problem


class Gate:
    """Answers 401 without a key, 403 for an altered link and 429 beyond a client's rate; lets all else in.

    A client is the name of its key, or else its address. rates: absent: any number of requests. An answer to a key is
    ``private``: caches between must not give it to those without; a signed link is its own permission.
    """

    def __init__(self, app: ASGIApp, access: Access, rates: TokenBuckets | None) -> None:
        self.app = app
        self.access = access
        self.rates = rates

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"] if scope["type"] == "http" else ""
        signed = self.access.signing is not None and path.startswith(SIGNED)
        if not (signed or path.startswith(API)):
            await self.app(scope, receive, send)
            return
        name = self.access.name_of(Headers(scope=scope)) if self.access.keys else None
        scope.setdefault("state", {})["client"] = name
        standing = None
        # Frames of an open stream are bounded by the stream, which counts when it is opened.
        if self.rates is not None and not _is_of_a_stream(scope):
            address = (scope.get("client") or ("",))[0]
            standing = self.rates.take(f"key {name}" if name else bucket_of(address))
        refusal = self._beyond(scope, standing) or self._refusal(scope, signed, name)

        async def marking(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                if name and "public" in headers.get("cache-control", ""):
                    headers["Cache-Control"] = headers["Cache-Control"].replace("public", "private")
                if signed and "link" in headers:
                    # Relative to the address without signature, and not signed itself.
                    del headers["link"]
                self._tell(headers, standing)
            await send(message)

        await (refusal or self.app)(scope, receive, marking)

    def _tell(self, headers: MutableHeaders, standing: Standing | None) -> None:
        if self.rates is not None and standing is not None:
            headers["RateLimit-Policy"] = self.rates.policy
            headers["RateLimit"] = limit_of(standing)

    def _beyond(self, scope: Scope, standing: Standing | None) -> Response | None:
        if standing is None or standing.allowed or self.rates is None:
            return None
        return problem(
            scope["path"],
            HTTPStatus.TOO_MANY_REQUESTS,
            f"more than {self.rates.burst} requests at once and {self.rates.rate:g} a second; "
            f"the next is allowed in {standing.seconds} s",
            name="rate-exceeded",
            title="Too many requests",
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
            HTTPStatus.UNAUTHORIZED,
            ("the key is not known" if sent else "a key is required")
            + ", as Authorization: Bearer KEY or as the password of Basic"
            + ("; or a signed link" if self.access.signing else ""),
            name="unauthorized",
            title="A key is required",
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
                HTTPStatus.FORBIDDEN,
                "the signature is not that of path and query; they must be sent as they were signed",
                name="bad-signature",
                title="The link was altered",
            )
        if scope["method"] != "GET":
            return problem(
                scope["path"],
                HTTPStatus.METHOD_NOT_ALLOWED,
                f"method {scope['method']} is not allowed for signed links",
                headers={"Allow": "GET, HEAD"},
            )
        # In place: what counts and logs requests reads the route from the same scope.
        scope["raw_path"], scope["path"] = path, unquote(path.decode("latin-1"))
        return None


def _is_of_a_stream(scope: Scope) -> bool:
    context: Context = scope["app"].state.context
    return context.streams.has_frame(scope["path"])
