"""Addresses as visitors see them, behind a proxy that serves this server below a path of its own."""

import posixpath
import re
from collections.abc import Sequence
from urllib.parse import urlsplit

from starlette.datastructures import URL, Headers, MutableHeaders
from starlette.types import ASGIApp, Receive, Scope, Send
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from seafoam.api.http.middleware import altering

ROOT_PATH = r"(/[A-Za-z0-9._~-]+)*"
"""Pattern of the path below which a proxy serves this server; empty: at its root."""


class Proxied:
    """ASGI middleware: heeds what trusted proxies say of a visitor, and redirects by relative addresses.

    The proxy strips the path that it serves the server below, so that no route knows it and relative addresses, which
    all pages and answers have, are right as they are. Previews of links need it, and read it from ``base_url``.

    trusted: addresses and networks of proxies. root_path: what holds where none of them sends ``X-Forwarded-Prefix``.
    """

    def __init__(self, app: ASGIApp, trusted: Sequence[str], root_path: str) -> None:
        self.app = ProxyHeadersMiddleware(app, list(trusted))  # type: ignore[arg-type]
        self.root_path = root_path

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)  # type: ignore[arg-type]
            return
        told = Headers(scope=scope).get("x-forwarded-prefix", "").rstrip("/")
        trusted = (scope.get("client") or ("",))[0] in self.app.trusted_hosts
        # Starlette's name for it, without a say in routing: here /water/default is no /default below /water.
        scope["app_root_path"] = told if told and trusted and re.fullmatch(ROOT_PATH, told) else self.root_path
        asked = URL(scope=scope)

        def mark(headers: MutableHeaders) -> None:
            location = headers.get("location")
            if location and urlsplit(location).netloc == asked.netloc:
                headers["Location"] = relative(asked.path, location)

        await self.app(scope, receive, altering(send, mark))  # type: ignore[arg-type]


def relative(path: str, location: str) -> str:
    """Return an address of this server relative to a request's path."""
    parts = urlsplit(location)
    folder = posixpath.relpath(posixpath.dirname(parts.path), posixpath.dirname(path))
    # "./" before a name that could be read as a scheme.
    reference = "./" + posixpath.join(folder, posixpath.basename(parts.path))
    return parts._replace(scheme="", netloc="", path=reference).geturl()
