"""Entity tags, which allow a 304 response before any work is done."""

from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from fastapi import Request
from starlette.responses import FileResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles

from seafoam.accuracy.cache import key_of

VERSION = version("seafoam")

IMMUTABLE = "public, max-age=31536000, immutable"
REVALIDATE = "public, no-cache"
"""Stored, but revalidated before each use: the response is a cheap 304, and upgrades show at once."""
NO_STORE = "no-store"


def tag_of(*parts: Any) -> str:
    """Return a strong entity tag of JSON values and this package's version."""
    return f'"{key_of(VERSION, *parts)}"'


def not_modified(request: Request, tag: str, headers: Mapping[str, str]) -> Response | None:
    """Return a 304 with the headers of a full response if the client's copy is current, else None."""
    sent = request.headers.get("if-none-match", "")
    current = sent.strip() == "*" or tag in (part.strip().removeprefix("W/") for part in sent.split(","))
    return Response(status_code=304, headers={"ETag": tag, **headers}) if current else None


def file_unless_current(request: Request, response: FileResponse) -> Response:
    """Return the answer with a file, made with ``stat_result``, or 304 if the client's copy is current."""
    known = StaticFiles(check_dir=False).is_not_modified(response.headers, request.headers)
    return NotModifiedResponse(response.headers) if known else response
