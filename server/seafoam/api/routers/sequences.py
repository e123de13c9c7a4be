"""``/api/sequences``: sequences of frames, made in the background and downloaded as one file."""

import asyncio
from collections.abc import AsyncIterator
from typing import Annotated, Literal

from fastapi import APIRouter, Depends, Path, Request
from fastapi.sse import EventSourceResponse, ServerSentEvent
from pydantic import Field
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles

from seafoam.api.context import Context, InContext
from seafoam.api.http import answers
from seafoam.api.http.parameters import (
    DEFAULT_HEIGHT,
    DEFAULT_WIDTH,
    TIME_LIMIT,
    OriginalPreset,
    OwnCamera,
    PlanRequest,
    quality_of,
)
from seafoam.api.http.problems import BadRequestError, FieldProblem
from seafoam.api.http.validation import NoParameters, Strict, known_preset
from seafoam.render.service.jobs import FrameJob
from seafoam.sequences.formats import Codec
from seafoam.sequences.service import FINISHED, SequenceStatus, UnknownSequenceError
from seafoam.sequences.spec import SequenceSpec, sequence_of

router = APIRouter(prefix="/api", tags=["sequences"])

MEDIA_TYPES = {"zip": "application/zip", "webp": "image/webp", "mp4": "video/mp4"}
_EVENT_SECONDS = 0.25
"""Between looks whether a sequence has moved on."""

SequenceName = Annotated[
    str, Path(description="Name of a sequence, from the response that started it", pattern="^[0-9a-f]{32}$")
]


class SequenceRequest(PlanRequest):
    """A sequence to render: frames of a scene from ``start`` to before ``stop``."""

    start: float = Field(default=0.0, ge=-TIME_LIMIT, le=TIME_LIMIT, description="Time of the first frame, s")
    stop: float = Field(ge=-TIME_LIMIT, le=TIME_LIMIT, examples=[2.0])
    """Time before which the last frame is, s; above start. The server limits the number of frames"""
    fps: float | str = Field(default=24.0, examples=[24, "30000/1001"])
    """Frames per second, 0.001 to 1000: a number, or a fraction as text; 29.97 is taken as 30000/1001"""
    width: int = Field(default=DEFAULT_WIDTH, ge=1, description="Width, pixels; even in a video", examples=[640])
    height: int = Field(default=DEFAULT_HEIGHT, ge=1, description="Height, pixels; even in a video", examples=[360])
    format: Literal["zip", "webp", "mp4"] = "mp4"
    """zip: of PNG frames; webp: animated, lossless; mp4: video"""
    codec: Codec = Field(default="h264", description="Of a video; av1 needs sides of at least 64 pixels")
    camera: OwnCamera = None
    preset: OriginalPreset = None


_STARTED: answers.Responses = {
    202: {
        "description": "The sequence is being made, or was made before",
        "headers": answers.headers_of({"Location": "Address of its status"}),
    }
}
_EVENTS = answers.content(
    "Server-sent events named `status`, whose data is the status as JSON; the last one is final",
    "text/event-stream",
    schema=answers.TEXT,
)
_FILE = answers.content("The file", *MEDIA_TYPES.values()) | {
    304: {"description": "Not modified: the copy named by If-None-Match or If-Modified-Since is current"},
    416: {"description": "The range is outside of the file, whose size Content-Range says"},
}


@router.post("/sequences", status_code=202, responses=_STARTED | answers.problems(413, 415, 422, 501, 503, 504))
async def start_sequence(body: Strict[SequenceRequest], context: InContext) -> SequenceStatus:
    """Render a sequence in the background, behind the frames of visitors.

    The same request has the same name: it goes on where it stopped, or is there at once.
    """
    known_preset(body.preset)
    spec = _spec(body, context)
    await context.compiled(body.scene, spec.job.quality)
    await context.pool.wait_until_settled()
    status = await context.plans.run(context.sequences.submit, spec, body.format, body.codec)
    headers = {"Location": f"sequences/{status.id}", "Cache-Control": answers.NO_STORE}
    return JSONResponse(status.model_dump(mode="json"), 202, headers)  # type: ignore[return-value]


async def _status(sequence: SequenceName, context: InContext) -> SequenceStatus:
    return await context.plans.run(context.sequences.status, sequence)


Status = Annotated[SequenceStatus, Depends(_status)]


@router.get("/sequences/{sequence}", responses=answers.problems(404, 422, 503))
async def get_sequence(status: Status, _: NoParameters, response: Response) -> SequenceStatus:
    """Get how far a sequence is, with the estimated time left."""
    response.headers["Cache-Control"] = answers.NO_STORE
    return status


@router.get(
    "/sequences/{sequence}/events",
    responses=_EVENTS | answers.problems(404, 422, 503),
    response_class=EventSourceResponse,
)
async def get_events(status: Status, _: NoParameters, context: InContext) -> AsyncIterator[ServerSentEvent]:
    """Follow a sequence: an event whenever it has moved on, until it ends."""
    yield ServerSentEvent(event="status", data=status)
    while status.status not in FINISHED:
        await asyncio.sleep(_EVENT_SECONDS)
        try:
            now = await asyncio.to_thread(context.sequences.status, status.id)
        except UnknownSequenceError:  # cancelled, and its files removed
            now = status.model_copy(update={"status": "cancelled", "eta_s": None})
        if now != status:
            status = now
            yield ServerSentEvent(event="status", data=status)


@router.get(
    "/sequences/{sequence}/file", responses=_FILE | answers.problems(404, 409, 422, 503), response_class=FileResponse
)
async def get_file(sequence: SequenceName, _: NoParameters, request: Request, context: InContext) -> Response:
    """Download a finished sequence. Parts can be requested with the header Range."""
    path = await context.plans.run(context.sequences.file, sequence)
    media = MEDIA_TYPES[path.suffix[1:]]
    response = FileResponse(path, media_type=media, filename=path.name, stat_result=path.stat())
    known = StaticFiles(check_dir=False).is_not_modified(response.headers, request.headers)
    return NotModifiedResponse(response.headers) if known else response


@router.delete("/sequences/{sequence}", status_code=204, responses=answers.problems(404, 422, 503))
async def delete_sequence(sequence: SequenceName, _: NoParameters, context: InContext) -> None:
    """Cancel a sequence, or forget a finished one, and remove its files: for all who asked for the same."""
    await context.plans.run(context.sequences.cancel, sequence)


def _spec(body: SequenceRequest, context: Context) -> SequenceSpec:
    """Return the sequence, within the limits of the server."""
    settings = context.settings
    quality = quality_of(body.quality)
    settings.frame_limits.check(body.width, body.height, quality.samples_drawn)
    camera = body.camera or body.scene.camera
    job = FrameJob(body.scene, quality, body.start, camera, body.width, body.height, "png", body.preset)
    spec = sequence_of(job, body.stop, body.fps)
    if spec.count > settings.sequence_frames:
        greatest = body.start + float(settings.sequence_frames / spec.fps)
        limit = f"{spec.count:,} frames exceed the limit of {settings.sequence_frames:,}"
        detail = f"stop must be at most {greatest:.12g} s: {limit}"
        raise BadRequestError(FieldProblem(pointer="/stop", detail=detail, allowed={"maximum": greatest}))
    return spec
