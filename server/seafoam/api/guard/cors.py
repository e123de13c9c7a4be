"""What pages of other sites may read (the Fetch Standard's CORS): public data all of them, the rest as it is set."""

import re
from collections.abc import Sequence
from functools import partial

from starlette.middleware.cors import CORSMiddleware
from starlette.routing import BaseRoute, Route
from starlette.types import ASGIApp, Receive, Scope, Send

from seafoam.api.watch.logs import REQUEST_ID

READABLE_ELSEWHERE = (
    "ETag", "Link", "Server-Timing", "Seafoam-Plan", "Seafoam-Renderer", "Retry-After", "RateLimit", "RateLimit-Policy",
    REQUEST_ID,
)  # fmt: skip
"""Headers that a page of another origin may read, besides those that every page may."""
_SENT = ("Authorization", "Content-Type", "If-None-Match", REQUEST_ID)
_GROUP_NAME = re.compile(r"\?P<\w+>")


class OtherOrigins:
    """ASGI middleware: adds the headers of CORS to every answer, errors included, and answers preflights.

    public: routes that every origin may GET; their other methods, and all other paths, only ``origins`` may use.
    """

    def __init__(self, app: ASGIApp, public: Sequence[BaseRoute], origins: Sequence[str]) -> None:
        patterns = [
            each.path_regex.pattern for each in public if isinstance(each, Route) and "GET" in (each.methods or ())
        ]
        # One pattern for all, in which the names of groups would clash.
        self.public = re.compile("|".join(_GROUP_NAME.sub("?:", pattern) for pattern in patterns) or r"(?!)")
        cors = partial(CORSMiddleware, app, allow_headers=_SENT, expose_headers=READABLE_ELSEWHERE)
        self.for_all = cors(allow_origins=("*",))
        methods = ("GET", "POST", "PUT", "DELETE")
        self.for_some = cors(allow_origins=origins, allow_methods=methods) if origins else app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"].removeprefix(scope.get("root_path", "")) if scope["type"] == "http" else ""
        await (self.for_all if self.public.match(path) else self.for_some)(scope, receive, send)
