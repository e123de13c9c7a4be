"""``/api/masks``: shipped and custom halftone masks, in every format, with their spectra."""

import asyncio
import json
import math
from collections.abc import AsyncIterator, Callable
from functools import lru_cache
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query, Request
from pydantic import BaseModel, Field
from starlette.responses import Response, StreamingResponse

from seafoam.api.context import Context, InContext
from seafoam.api.http.errors import problem_responses
from seafoam.api.http.etags import NO_STORE, REVALIDATE, not_modified, tag_of
from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError
from seafoam.extras import require_reports
from seafoam.masks.catalogue import (
    ON_REQUEST_SECONDS,
    Mask,
    MaskEntry,
    UnknownMaskError,
    is_kept,
    load_catalogue,
    load_mask,
    made_on_request,
)
from seafoam.masks.construct import estimated_seconds
from seafoam.masks.families import (
    ASPECT_MAX,
    DEFAULT_SIGMA,
    SEED_MAX,
    SIDE_MAX,
    SIDE_MIN,
    SIGMA_MAX,
    SIGMA_MIN,
    Family,
    MaskSpec,
    Method,
    check_parameters,
    sigma_range,
)
from seafoam.masks.formats import to_dds, to_npy, to_png8, to_png16, to_u16
from seafoam.masks.torus import Ranks

router = APIRouter(prefix="/api", tags=["masks"])

MaskName = Annotated[str, Path(description="Name of a mask; /api/masks lists them", examples=["vac-24"], max_length=40)]
MaskFormat = Literal["png", "npy", "u16", "dds"]
MaskFormatPath = Annotated[
    MaskFormat,
    Path(
        description="png: 16-bit greyscale of floor(rank 65536/N); npy: float32 thresholds (rank + 0.5)/N; "
        "u16: raw little-endian floor(rank 65536/N); dds: R16_UNORM with a DX10 header"
    ),
]

ENCODERS: dict[MaskFormat, tuple[str, Callable[[Ranks], bytes]]] = {
    "png": ("image/png", to_png16),
    "npy": ("application/x-npy", to_npy),
    "u16": ("application/octet-stream", to_u16),
    "dds": ("image/vnd-ms.dds", to_dds),
}
BACKGROUND_SECONDS = 900.0
"""Expected construction time above which masks are refused in the background, s: more than any takes."""
SIGMA_STEPS = 200
"""Number of steps of sigma that are tried to find those that are fast enough."""


class CustomMask(Parameters):
    """Parameters of a custom mask. The same parameters give the same mask."""

    family: Family = Field(
        description="Construction of the mask. vac: void-and-cluster; blur: low-pass filtered white noise; "
        "clump: band-pass filtered noise; bubble: shrinking discs; mix: clusters of bubbles; "
        "lace: cell walls of a foam",
        examples=["vac"],
    )
    sigma: float | None = Field(
        default=None,
        ge=SIGMA_MIN,
        le=SIGMA_MAX,
        description="Characteristic length, texels; at most an eighth of the shorter side, and at least 2 for bubble "
        "and mix, 4 for lace. "
        f"Absent: {', '.join(f'{name} {sigma:g}' for name, sigma in DEFAULT_SIGMA.items())}, or the maximum for size",
        examples=[3.0],
    )
    size: int = Field(default=256, ge=SIDE_MIN, le=SIDE_MAX, description="Side of the tile, texels", examples=[128])
    width: int | None = Field(
        default=None, ge=SIDE_MIN, le=SIDE_MAX, description="Width of the tile, texels; absent: size", examples=[128]
    )
    height: int | None = Field(
        default=None, ge=SIDE_MIN, le=SIDE_MAX, description="Height of the tile, texels; absent: size", examples=[128]
    )
    seed: int = Field(default=0, ge=0, le=SEED_MAX, description="Random seed", examples=[2011])
    aspect: float = Field(
        default=1.0, ge=1.0, le=ASPECT_MAX, description="Aspect ratio of the cells along x (lace only)", examples=[1.0]
    )
    age: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="Age of the foam, 0 (young) to 1 (old and torn) (lace only)",
        examples=[0.0],
    )


class MaskParameters(BaseModel):
    """Parameters that determine a mask."""

    sigma: float = Field(description="Characteristic length of the family, texels")
    width: int = Field(description="Width of the tile, texels")
    height: int = Field(description="Height of the tile, texels")
    seed: int
    aspect: float | None = Field(description="Aspect ratio of the cells along x; null except for lace")
    age: float | None = Field(description="Age of the foam, 0 (young) to 1 (old and torn); null except for lace")
    method: Method | None = Field(description="Ordering method of vac; null for other families")


class MaskInfo(BaseModel):
    """A mask's description and construction parameters."""

    name: str
    title: str
    summary: str
    family: Family
    parameters: MaskParameters
    generator: str = Field(description="Version of the construction algorithm")
    sha256: str = Field(description="SHA-256 of the ranks as little-endian uint32, in row-major order")
    value_rule: str
    license: str


_BYTES = {"schema": {"type": "string", "format": "binary"}}
_NOT_MODIFIED: dict[int | str, dict[str, Any]] = {
    304: {"description": "Not modified: the copy named by If-None-Match is current"}
}


_EVENT_SECONDS = 1.0
"""Between events of a mask that is being generated."""
_EVENTS: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "Server-sent events: `progress`, whose data is the share that is done, 0 to 1, every second; at "
        "the end `done`, whose data is the description of the mask as JSON",
        "content": {"text/event-stream": {"schema": {"type": "object", "required": ["event", "data"]}}},
    }
}


def _answers(description: str, *media: str, custom: bool) -> dict[int | str, dict[str, Any]]:
    content = {kind: {} if kind == "application/json" else _BYTES for kind in media}
    responses: dict[int | str, dict[str, Any]] = {200: {"description": description, "content": content}}
    return responses | _NOT_MODIFIED | problem_responses(*((422, 503) if custom else (404, 422, 503)))


_DATA = ("Mask data", *(media for media, _ in ENCODERS.values()))
_DATA8 = ("8-bit greyscale PNG of floor(rank 256/N)", "image/png")
_SIDECAR = ("Metadata: construction parameters, hash, filtering tables and spectrum", "application/json")
_SPECTRUM = ("Radially averaged power spectrum and anisotropy by grey level", "application/json")
_SHAPES = (
    "Connected components, holes and chord lengths of the foam by saturation; lengths in texels",
    "application/json",
)
_PLOT = ("Plot of the radially averaged power spectrum and the anisotropy", "image/png")


def _shipped(name: str) -> Mask:
    try:
        return load_mask(name)
    except UnknownMaskError:
        raise NotFoundError(f"mask {name!r} was not found", "mask", tuple(load_catalogue())) from None


def check_custom(asked: CustomMask, *, slow: bool = False) -> MaskSpec:
    """Return the mask's parameters; reject what the family does not allow, with the allowed range.

    Unless ``slow``, reject also what would take too long. Raises :class:`BadRequestError`.
    """
    width, height = asked.width or asked.size, asked.height or asked.size
    tile = f"{width} × {height} texels"
    least, greatest = sigma_range(asked.family, min(width, height))
    if asked.sigma is not None and not least <= asked.sigma <= greatest:
        detail = f"sigma: must be {least:g} to {greatest:g} texels for family {asked.family} on {tile}"
        raise BadRequestError(
            FieldProblem(parameter="sigma", detail=detail, allowed={"minimum": least, "maximum": greatest})
        )
    if asked.family != "lace":
        refused = [
            FieldProblem(
                parameter=name,
                detail=f"{name}: allowed only for family lace, not {asked.family}",
                allowed={"enum": [unset]},
            )
            for name, unset in (("aspect", 1.0), ("age", 0.0))
            if getattr(asked, name) != unset
        ]
        if refused:
            raise BadRequestError(*refused)
    made = check_parameters(asked.family, asked.sigma, (width, height), asked.seed, asked.aspect, asked.age)
    seconds = estimated_seconds(made.family, made.sigma, (width, height))
    limit = BACKGROUND_SECONDS if slow else ON_REQUEST_SECONDS
    if seconds > limit and not is_kept(made):
        steps = (least + (greatest - least) * step / SIGMA_STEPS for step in range(SIGMA_STEPS + 1))
        quick = [sigma for sigma in steps if estimated_seconds(made.family, sigma, (width, height)) <= limit]
        allowed = {"minimum": round(quick[0], 2), "maximum": round(quick[-1], 2)} if quick else None
        within = f"allowed here: sigma {quick[0]:g} to {quick[-1]:g}" if quick else "use a smaller size"
        detail = (
            f"sigma: this mask of {tile} takes about {seconds:.0f} s to generate; the limit of a request is "
            f"{limit:g} s; {within}. GET /api/masks/custom/events generates it in the background"
        )
        raise BadRequestError(FieldProblem(parameter="sigma", detail=detail, allowed=allowed))
    return made


def _custom(asked: CustomMask) -> Mask:
    return made_on_request(check_custom(asked))


class _Making:
    """A mask on its way; ends early once nobody follows it."""

    def __init__(self, made: MaskSpec) -> None:
        self._made = made
        self._share = 0.0
        self._followed = True

    def run(self) -> Mask:
        return made_on_request(self._made, math.inf, self._tell)

    def _tell(self, share: float) -> None:
        if not self._followed:
            raise asyncio.CancelledError
        self._share = share

    async def events(self, task: asyncio.Task[Mask]) -> AsyncIterator[str]:
        try:
            while not task.done():
                yield f"event: progress\ndata: {self._share:.3f}\n\n"
                await asyncio.wait({task}, timeout=_EVENT_SECONDS)
            yield f"event: done\ndata: {json.dumps(task.result().entry.to_json())}\n\n"
        finally:
            self._followed = False
            task.cancel()


def _ranks_as(encoder: Callable[[Ranks], bytes]) -> Callable[[Mask], bytes]:
    return lambda mask: encoder(mask.ranks)


def _info(mask: Mask) -> bytes:
    return json.dumps(mask.entry.to_json()).encode()


def _sidecar(mask: Mask) -> bytes:
    return json.dumps(mask.sidecar()).encode()


def _spectrum(mask: Mask) -> bytes:
    return json.dumps(mask.spectrum.to_json()).encode()


def _shapes(mask: Mask) -> bytes:
    return json.dumps(mask.morphology.to_json()).encode()


@lru_cache(maxsize=32)
def _plot(mask: Mask) -> bytes:
    require_reports()
    # Matplotlib takes a second to import, so only a server that is asked for a plot pays.
    from seafoam.masks.plots import plot_spectrum

    return plot_spectrum(mask.spectrum, mask.entry.title)


async def _answer(
    source: Callable[[], Mask],
    encode: Callable[[Mask], bytes],
    media_type: str,
    request: Request,
    context: Context,
    file: str = "",
) -> Response:
    """Return a mask as bytes, or 304 before they are encoded."""
    mask = await context.masks.run(source)
    headers = {"Cache-Control": REVALIDATE}
    if file:
        headers["Content-Disposition"] = f'inline; filename="{mask.entry.name}{file}"'
    tag = tag_of(mask.entry.to_json(), request.url.path.rpartition("/")[2])
    if current := not_modified(request, tag, headers):
        return current
    content = await context.masks.run(encode, mask)
    return Response(content, headers={"ETag": tag, **headers}, media_type=media_type)


@router.get("/masks", response_model=list[MaskInfo], responses=problem_responses(422))
async def list_masks(_: Annotated[Parameters, Query()]) -> list[dict[str, Any]]:
    """List the shipped masks."""
    entries: list[MaskEntry] = list(load_catalogue().values())
    return [entry.to_json() for entry in entries]


@router.get(
    "/masks/custom",
    responses=problem_responses(422, 503) | {200: {"model": MaskInfo}},
    response_class=Response,
)
async def get_custom_mask(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Generate a custom mask and get its description. Its data is below this path, with the same parameters."""
    return await _answer(lambda: _custom(asked), _info, "application/json", request, context)


@router.get("/masks/custom/events", responses=_EVENTS | problem_responses(422, 503), response_class=StreamingResponse)
async def get_custom_events(asked: Annotated[CustomMask, Query()], context: InContext) -> Response:
    """Generate a custom mask in the background and follow it: one at a time, until the connection is closed.

    After the event `done`, its data is below `/api/masks/custom`, with the same parameters, as of any other mask.
    """
    making = _Making(check_custom(asked, slow=True))
    task = asyncio.create_task(context.slow_masks.run(making.run))
    # The task begins: a full queue is an answer of its own.
    await asyncio.sleep(0)
    if task.done():
        task.result()
    headers = {"Cache-Control": NO_STORE, "X-Accel-Buffering": "no"}
    return StreamingResponse(making.events(task), headers=headers, media_type="text/event-stream")


@router.get("/masks/custom/data.{format}", responses=_answers(*_DATA, custom=True), response_class=Response)
async def get_custom_data(
    format: MaskFormatPath, asked: Annotated[CustomMask, Query()], request: Request, context: InContext
) -> Response:
    """Get the data of a custom mask."""
    media, encoder = ENCODERS[format]
    return await _answer(lambda: _custom(asked), _ranks_as(encoder), media, request, context, f".{format}")


@router.get("/masks/custom/data8.png", responses=_answers(*_DATA8, custom=True), response_class=Response)
async def get_custom_data8(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Get a custom mask in 8 bits."""
    return await _answer(lambda: _custom(asked), _ranks_as(to_png8), "image/png", request, context, "-8bit.png")


@router.get("/masks/custom/sidecar", responses=_answers(*_SIDECAR, custom=True), response_class=Response)
async def get_custom_sidecar(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Get the metadata of a custom mask."""
    return await _answer(lambda: _custom(asked), _sidecar, "application/json", request, context, ".json")


@router.get("/masks/custom/spectrum", responses=_answers(*_SPECTRUM, custom=True), response_class=Response)
async def get_custom_spectrum(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Get the measured spectrum of a custom mask."""
    return await _answer(lambda: _custom(asked), _spectrum, "application/json", request, context)


@router.get("/masks/custom/shapes", responses=_answers(*_SHAPES, custom=True), response_class=Response)
async def get_custom_shapes(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Get the measured foam shapes of a custom mask."""
    return await _answer(lambda: _custom(asked), _shapes, "application/json", request, context)


@router.get(
    "/masks/custom/spectrum.png",
    responses=_answers(*_PLOT, custom=True) | problem_responses(501),
    response_class=Response,
)
async def get_custom_plot(asked: Annotated[CustomMask, Query()], request: Request, context: InContext) -> Response:
    """Get the measured spectrum of a custom mask as a plot."""
    return await _answer(lambda: _custom(asked), _plot, "image/png", request, context, "-spectrum.png")


@router.get(
    "/masks/{mask}", responses=problem_responses(404, 422, 503) | {200: {"model": MaskInfo}}, response_class=Response
)
async def get_mask(mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext) -> Response:
    """Get the description of a shipped mask: size, family, sigma, seed, hash and construction."""
    return await _answer(lambda: _shipped(mask), _info, "application/json", request, context)


@router.get("/masks/{mask}/data.{format}", responses=_answers(*_DATA, custom=False), response_class=Response)
async def get_data(
    mask: MaskName,
    format: MaskFormatPath,
    _: Annotated[Parameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get the data of a shipped mask."""
    media, encoder = ENCODERS[format]
    return await _answer(lambda: _shipped(mask), _ranks_as(encoder), media, request, context, f".{format}")


@router.get("/masks/{mask}/data8.png", responses=_answers(*_DATA8, custom=False), response_class=Response)
async def get_data8(
    mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext
) -> Response:
    """Get a shipped mask in 8 bits."""
    return await _answer(lambda: _shipped(mask), _ranks_as(to_png8), "image/png", request, context, "-8bit.png")


@router.get("/masks/{mask}/sidecar", responses=_answers(*_SIDECAR, custom=False), response_class=Response)
async def get_sidecar(
    mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the metadata of a shipped mask."""
    return await _answer(lambda: _shipped(mask), _sidecar, "application/json", request, context, ".json")


@router.get("/masks/{mask}/spectrum", responses=_answers(*_SPECTRUM, custom=False), response_class=Response)
async def get_spectrum(
    mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the measured spectrum of a shipped mask."""
    return await _answer(lambda: _shipped(mask), _spectrum, "application/json", request, context)


@router.get("/masks/{mask}/shapes", responses=_answers(*_SHAPES, custom=False), response_class=Response)
async def get_shapes(
    mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the measured foam shapes of a shipped mask."""
    return await _answer(lambda: _shipped(mask), _shapes, "application/json", request, context)


@router.get(
    "/masks/{mask}/spectrum.png",
    responses=_answers(*_PLOT, custom=False) | problem_responses(501),
    response_class=Response,
)
async def get_plot(mask: MaskName, _: Annotated[Parameters, Query()], request: Request, context: InContext) -> Response:
    """Get the measured spectrum of a shipped mask as a plot."""
    return await _answer(lambda: _shipped(mask), _plot, "image/png", request, context, "-spectrum.png")
