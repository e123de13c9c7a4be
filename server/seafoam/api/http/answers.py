"""What answers have in common: cache headers and entity tags, and their description in the OpenAPI document."""

from collections.abc import Awaitable, Callable, Mapping, Sequence
from http import HTTPStatus
from importlib.metadata import version
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import Response

from seafoam.accuracy.cache import key_of
from seafoam.api.http.errors import MEDIA_TYPE, PROBLEM_TYPES, Problem
from seafoam.quality import QualityExtensions
from seafoam.scene import SceneExtensions

VERSION = version("seafoam")

IMMUTABLE = "public, max-age=31536000, immutable"
REVALIDATE = "public, no-cache"
"""Stored, but revalidated before each use: the response is a cheap 304, and upgrades show at once."""
NO_STORE = "no-store"


def not_modified(request: Request, tag: str, headers: Mapping[str, str]) -> Response | None:
    """Return a 304 with the headers of a full response if the client's copy is current, else None."""
    sent = request.headers.get("if-none-match", "").split(",")
    current = tag in (part.strip().removeprefix("W/") for part in sent)
    return Response(status_code=304, headers={"ETag": tag, **headers}) if current else None


async def kept(
    request: Request, identity: Sequence[Any], make: Callable[[], Awaitable[bytes]], media_type: str, **headers: str
) -> Response:
    """Answer with what is made, or with 304 before it is made.

    identity: JSON values that it depends on, beside this package's version and the last step of the request's path.
    headers: other than those of caches.
    """
    tag = f'"{key_of(VERSION, *identity, request.url.path.rpartition("/")[2])}"'
    headers = {"Cache-Control": REVALIDATE, **headers}
    if current := not_modified(request, tag, headers):
        return current
    return Response(await make(), headers={"ETag": tag, **headers}, media_type=media_type)


Responses = dict[int | str, dict[str, Any]]
"""Descriptions of answers by their status."""

TEXT = {"type": "string"}
BINARY = {"type": "string", "format": "binary"}
NOT_MODIFIED: Responses = {304: {"description": "Not modified: the copy named by If-None-Match is current"}}


def problems(*statuses: int) -> Responses:
    """Describe the problems that an operation can answer with."""
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    described: Responses = {}
    for status in sorted(statuses):
        titles = dict.fromkeys(kind.title for kind in PROBLEM_TYPES.values() if kind.status == status)
        described[status] = {"description": "; ".join(titles) or HTTPStatus(status).phrase, "content": content}
    return described


def content(
    description: str, *media_types: str, schema: Mapping[str, Any] = BINARY, headers: Mapping[str, str] | None = None
) -> Responses:
    """Describe an answer of status 200 that is no JSON. headers: descriptions by name."""
    described = {"description": description, "content": {media: {"schema": schema} for media in media_types}}
    return {200: described if headers is None else {**described, "headers": headers_of(headers)}}


def headers_of(descriptions: Mapping[str, str]) -> dict[str, Any]:
    """Describe headers. descriptions: by name."""
    return {name: {"description": text, "schema": TEXT} for name, text in descriptions.items()}


def install(app: FastAPI) -> None:
    """Add the problem schema to the application's document, and take out the schemas of what nothing extends."""
    made = app.openapi

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            schemas = made()["components"]["schemas"]
            problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
            schemas |= problem.pop("$defs") | {"Problem": problem}
            for unused in (one for one in (SceneExtensions, QualityExtensions) if not one.known):
                del schemas[unused.__name__]
        return made()

    app.openapi = openapi  # type: ignore[method-assign]
