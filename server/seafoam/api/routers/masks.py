"""``/api/masks``: shipped and custom halftone masks, in every format, with their spectra."""

import asyncio
import json
import math
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Annotated, Literal, NamedTuple

from fastapi import APIRouter, Depends, Path, Query, Request
from fastapi.sse import format_sse_event
from pydantic import Field
from starlette.responses import Response, StreamingResponse

from seafoam.api.context import Context, InContext
from seafoam.api.http import answers
from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError
from seafoam.api.http.validation import NoParameters
from seafoam.extras import require
from seafoam.masks import catalogue, families, formats
from seafoam.masks.catalogue import ON_REQUEST_SECONDS, Mask, MaskInfo, load_catalogue
from seafoam.masks.construct.make import estimated_seconds
from seafoam.masks.families import Family, MaskSpec
from seafoam.masks.torus import Ranks

router = APIRouter(prefix="/api", tags=["masks"])

MaskName = Annotated[str, Path(description="Name of a mask; /api/masks lists them", examples=["vac-24"], max_length=40)]
MaskFormat = Literal["png", "npy", "u16", "dds"]
_Side = Annotated[int, Field(ge=families.SIDE_MIN, le=families.SIDE_MAX)]
MaskFormatPath = Annotated[
    MaskFormat,
    Path(
        description="png: 16-bit greyscale of floor(rank 65536/N); npy: float32 thresholds (rank + 0.5)/N; "
        "u16: raw little-endian floor(rank 65536/N); dds: R16_UNORM with a DX10 header"
    ),
]

ENCODERS: dict[MaskFormat, tuple[str, Callable[[Ranks], bytes]]] = {
    "png": ("image/png", formats.to_png16),
    "npy": ("application/x-npy", formats.to_npy),
    "u16": ("application/octet-stream", formats.to_u16),
    "dds": ("image/vnd-ms.dds", formats.to_dds),
}


class CustomMask(Parameters):
    """Parameters of a custom mask. The same parameters give the same mask."""

    family: Family = Field(examples=["vac"])
    """Construction of the mask. vac: void-and-cluster; blur: low-pass filtered white noise; clump: band-pass filtered
    noise; bubble: shrinking discs; mix: clusters of bubbles; lace: cell walls of a foam"""
    sigma: float | None = Field(
        default=None,
        ge=families.SIGMA_MIN,
        le=families.SIGMA_MAX,
        description="Characteristic length, texels; at most an eighth of the shorter side, and at least 2 for bubble "
        "and mix, 4 for lace. "
        f"Absent: {', '.join(f'{name} {sigma:g}' for name, sigma in families.DEFAULT_SIGMA.items())}, "
        "or the maximum for size",
        examples=[3.0],
    )
    size: _Side = Field(default=256, description="Side of the tile, texels", examples=[128])
    width: _Side | None = Field(default=None, description="Width of the tile, texels; absent: size", examples=[128])
    height: _Side | None = Field(default=None, description="Height of the tile, texels; absent: size", examples=[128])
    seed: int = Field(default=0, ge=0, le=families.SEED_MAX, description="Random seed", examples=[2011])
    aspect: float = Field(default=1.0, ge=1.0, le=families.ASPECT_MAX, examples=[1.0])
    """Aspect ratio of the cells along x (lace only)"""
    age: float = Field(default=0.0, ge=0.0, le=1.0, examples=[0.0])
    """Age of the foam, 0 (young) to 1 (old and torn) (lace only)"""


_EVENT_SECONDS = 1.0
"""Between events of a mask that is being generated."""
_EVENTS = answers.content(
    "Server-sent events: `progress`, whose data is the share that is done, 0 to 1, every second; at the end `done`, "
    "whose data is the description of the mask as JSON",
    "text/event-stream",
    schema={"type": "object", "required": ["event", "data"]},
)


def _shipped(name: str) -> Mask:
    try:
        return catalogue.load_mask(name)
    except catalogue.UnknownMaskError:
        raise NotFoundError(f"mask {name!r} was not found", "mask", tuple(load_catalogue())) from None


def check_custom(query: CustomMask, *, slow: bool = False) -> MaskSpec:
    """Return the mask's parameters; reject what the family does not allow and, unless ``slow``, what takes too long.

    Raises :class:`BadRequestError`.
    """
    tile = query.width or query.size, query.height or query.size
    try:
        made = families.check_parameters(query.family, query.sigma, tile, query.seed, query.aspect, query.age)
    except ValueError as error:
        # Its text begins with the argument's name, and has its range.
        name, _, said = str(error).partition(" ")
        raise BadRequestError(FieldProblem(parameter=name, detail=f"{name}: {said}")) from None
    seconds = estimated_seconds(made)
    if not slow and seconds > ON_REQUEST_SECONDS and not catalogue.is_kept(made):
        detail = (
            f"sigma: this mask of {made.width} × {made.height} texels takes about {seconds:.0f} s to generate; a "
            f"request may take {ON_REQUEST_SECONDS:g} s. GET /api/masks/custom/events generates it in the background"
        )
        raise BadRequestError(FieldProblem(parameter="sigma", detail=detail))
    return made


class _Making:
    """A mask on its way; ends early once nobody follows it."""

    def __init__(self, made: MaskSpec) -> None:
        self._made = made
        self._share = 0.0
        self._followed = True

    def run(self) -> Mask:
        return catalogue.made_on_request(self._made, math.inf, self._tell)

    def _tell(self, share: float) -> None:
        if not self._followed:
            raise asyncio.CancelledError
        self._share = share

    async def events(self, task: asyncio.Task[Mask]) -> AsyncIterator[bytes]:
        try:
            while not task.done():
                yield format_sse_event(event="progress", data_str=f"{self._share:.3f}")
                await asyncio.wait({task}, timeout=_EVENT_SECONDS)
            yield format_sse_event(event="done", data_str=json.dumps(task.result().entry.model_dump()))
        finally:
            self._followed = False
            task.cancel()


@lru_cache(maxsize=32)
def _plot(mask: Mask) -> bytes:
    require("reports")
    # Matplotlib takes a second to import, so only a server that is asked for a plot pays.
    from seafoam.masks.judge.plots import plot_spectrum

    return plot_spectrum(mask.tables.spectrum, mask.entry.title)


@dataclass(frozen=True, slots=True)
class _MaskAnswer:
    """A mask that a request asks for. ``find``: loads or generates it, in a thread."""

    find: Callable[[], Mask]
    request: Request
    context: Context

    async def answer(self, encode: Callable[[Mask], bytes], media_type: str, file: str = "") -> Response:
        """Return the mask as bytes, or 304 before they are encoded. file: end of the name to save it under."""
        mask = await self.context.masks.run(self.find)
        headers = {"Content-Disposition": f'inline; filename="{mask.entry.name}{file}"'} if file else {}
        make = partial(self.context.masks.run, encode, mask)
        return await answers.kept(self.request, [mask.entry.model_dump()], make, media_type, **headers)


def _custom_mask(query: Annotated[CustomMask, Query()], request: Request, context: InContext) -> _MaskAnswer:
    return _MaskAnswer(lambda: catalogue.made_on_request(check_custom(query)), request, context)


def _shipped_mask(mask: MaskName, _: NoParameters, request: Request, context: InContext) -> _MaskAnswer:
    return _MaskAnswer(lambda: _shipped(mask), request, context)


class _MaskPart(NamedTuple):
    """What a mask has below its address beside its data. title: of a kind of mask. file: end of a saved file's name."""

    below: str
    name: str
    title: str
    description: str
    encode: Callable[[Mask], bytes]
    file: str = ""
    problems: tuple[int, ...] = ()


_PARTS = (
    _MaskPart(
        "data8.png", "data8", "Get a {} mask in 8 bits.", "8-bit greyscale PNG of floor(rank 256/N)",
        lambda mask: formats.to_png8(mask.ranks), "-8bit.png",
    ),
    _MaskPart(
        "sidecar", "sidecar", "Get the metadata of a {} mask.",
        "Metadata: construction parameters, hash, filtering tables and spectrum",
        lambda mask: json.dumps(mask.sidecar()).encode(), ".json",
    ),
    _MaskPart(
        "spectrum", "spectrum", "Get the measured spectrum of a {} mask.",
        "Radially averaged power spectrum and anisotropy by grey level",
        lambda mask: json.dumps(mask.tables.spectrum.model_dump()).encode(),
    ),
    _MaskPart(
        "shapes", "shapes", "Get the measured foam shapes of a {} mask.",
        "Connected components, holes and chord lengths of the foam by saturation; lengths in texels",
        lambda mask: json.dumps(mask.tables.morphology.model_dump()).encode(),
    ),
    _MaskPart(
        "spectrum.png", "plot", "Get the measured spectrum of a {} mask as a plot.",
        "Plot of the radially averaged power spectrum and the anisotropy", _plot, "-spectrum.png", (501,),
    ),
)  # fmt: skip


def _serve_parts(path: str, kind: str, find: Callable[..., _MaskAnswer], *problems: int) -> None:
    """Add the routes of description, data and :data:`_PARTS` at the address of a kind of mask. find: a dependency."""
    prefix = "get_" if kind == "shipped" else "get_custom_"
    responses = answers.NOT_MODIFIED | answers.problems(422, 503, *problems)
    add = partial(router.add_api_route, response_class=Response)

    async def info(mask: Annotated[_MaskAnswer, Depends(find)]) -> Response:
        return await mask.answer(lambda mask: json.dumps(mask.entry.model_dump()).encode(), "application/json")

    said = f"Get the description of a {kind} mask: size, family, sigma, seed, hash and construction."
    add(path, info, name=f"{prefix}mask", description=said, responses=responses | {200: {"model": MaskInfo}})

    async def data(mask: Annotated[_MaskAnswer, Depends(find)], format: MaskFormatPath) -> Response:
        media_type, encoder = ENCODERS[format]
        return await mask.answer(lambda mask: encoder(mask.ranks), media_type, f".{format}")

    described = answers.content("Mask data", *(media for media, _ in ENCODERS.values())) | responses
    said = f"Get the data of a {kind} mask."
    add(f"{path}/data.{{format}}", data, name=f"{prefix}data", description=said, responses=described)

    def answering(part: _MaskPart, media_type: str) -> Callable[..., Awaitable[Response]]:
        async def answer(mask: Annotated[_MaskAnswer, Depends(find)]) -> Response:
            return await mask.answer(part.encode, media_type, part.file)

        return answer

    for part in _PARTS:
        plain = not part.below.endswith(".png")
        media_type, body = ("application/json", {}) if plain else ("image/png", {"schema": answers.BINARY})
        described = {200: {"description": part.description, "content": {media_type: body}}}
        add(
            f"{path}/{part.below}",
            answering(part, media_type),
            name=f"{prefix}{part.name}",
            description=part.title.format(kind),
            responses=described | responses | answers.problems(*part.problems),
        )


@router.get("/masks", responses=answers.problems(422))
async def list_masks(_: NoParameters) -> list[MaskInfo]:
    """List the shipped masks."""
    return list(load_catalogue().values())


@router.get("/masks/custom/events", responses=_EVENTS | answers.problems(422, 503), response_class=StreamingResponse)
async def get_custom_events(query: Annotated[CustomMask, Query()], context: InContext) -> Response:
    """Generate a custom mask in the background and follow it: one at a time, until the connection is closed.

    After the event `done`, its data is below `/api/masks/custom`, with the same parameters, as of any other mask.
    """
    making = _Making(check_custom(query, slow=True))
    task = asyncio.create_task(context.slow_masks.run(making.run))
    # The task begins: a full queue is an answer of its own.
    await asyncio.sleep(0)
    if task.done():
        task.result()
    headers = {"Cache-Control": answers.NO_STORE, "X-Accel-Buffering": "no"}
    return StreamingResponse(making.events(task), headers=headers, media_type="text/event-stream")


_serve_parts("/masks/custom", "custom", _custom_mask)
_serve_parts("/masks/{mask}", "shipped", _shipped_mask, 404)
