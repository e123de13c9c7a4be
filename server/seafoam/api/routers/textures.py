"""``/api/textures``: bytes of the textures that plans refer to."""

import gzip
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request
from pydantic import Field
from starlette.responses import Response

from seafoam.api.context import InContext
from seafoam.api.http.answers import IMMUTABLE, NOT_MODIFIED, REVALIDATE, content, not_modified, problems
from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError
from seafoam.textures.store import TextureData, TexturePart, spec_at, texture

router = APIRouter(prefix="/api", tags=["textures"], default_response_class=Response)


class TextureParameters(Parameters):
    """Parameters of a texture."""

    sha256: str | None = Field(default=None, pattern="^[0-9a-f]{64}$")
    """SHA-256 of the bytes, from the plan; makes the response cacheable without limit. Bytes with another hash are
    refused"""
    part: TexturePart | None = None
    """A part of a texture of format R16UI; absent: all of it. upper: the upper 6 bits of each texel, a byte each, as
    what is to be added modulo 64 to the median of the texel before it, the one above it, and their sum less the one
    between them. lower: the lowest 8 bits of each texel, then the 2 above of four texels a byte. The hash is that of
    the whole"""


_RESPONSES = content(
    "All mip levels, largest first; rows from v = 0, tightly packed, little-endian",
    "application/octet-stream",
    headers={"ETag": "Quoted SHA-256 of the bytes"},
)


@router.get("/textures/{name:path}", responses=_RESPONSES | NOT_MODIFIED | problems(404, 422, 503))
async def get_texture(
    name: Annotated[
        str, Path(description="Name of a texture in a plan", examples=["mask/vac-24/ranks"], max_length=9000)
    ],
    query: Annotated[TextureParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get the bytes of a texture. The plan gives its format and size."""
    try:
        found = await context.masks.run(lambda: texture(spec_at(name)))
    except (KeyError, ValueError):
        raise NotFoundError(f"texture {name!r} was not found", "name") from None
    if query.sha256 not in (None, found.sha256):
        detail = f"sha256: texture {name!r} has the hash {found.sha256}; the plan is from another version"
        raise BadRequestError(FieldProblem(parameter="sha256", detail=detail, allowed={"enum": [found.sha256]}))
    headers = {"Cache-Control": IMMUTABLE if query.sha256 else REVALIDATE, "Vary": "Accept-Encoding"}
    tag = f'"{found.sha256}"' if query.part is None else f'"{found.sha256}-{query.part}"'
    current = not_modified(request, tag, headers)
    if current is not None:
        return current
    try:
        content, packed = await context.masks.run(lambda: _content(found, query.part, request))
    except ValueError as error:
        raise BadRequestError(FieldProblem(parameter="part", detail=str(error))) from None
    if packed:
        headers["Content-Encoding"] = "gzip"
    return Response(content, headers={"ETag": tag, **headers}, media_type="application/octet-stream")


def _content(found: TextureData, part: TexturePart | None, request: Request) -> tuple[bytes, bool]:
    """Return the bytes asked for, and whether they are compressed by gzip, which the client must accept."""
    accepted = "gzip" in request.headers.get("accept-encoding", "")
    if part == "upper":
        upper = found.part(part)
        return (upper, True) if accepted else (gzip.decompress(upper), False)
    if part == "lower":
        return found.part(part), False
    packed = found.gzipped if accepted else None
    return (found.data, False) if packed is None else (packed, True)
