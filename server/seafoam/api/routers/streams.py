"""``/api/streams``: frames in motion, for pages that do not draw themselves."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response
from pydantic import Field

from seafoam.api.context import Context, InContext
from seafoam.api.frames.respond import CLIENT_CLOSED_REQUEST, server_timing, unless_gone
from seafoam.api.frames.streams import LEASE_SECONDS, RETRY_SECONDS, Stream
from seafoam.api.http.answers import NO_STORE, content, problems
from seafoam.api.http.parameters import PlanRequest, StreamFrameParameters, quality_of
from seafoam.api.http.problems import NotFoundError, StreamsFullError
from seafoam.api.http.validation import NoParameters, Strict
from seafoam.described import Described
from seafoam.quality import Quality
from seafoam.render.service.errors import DeadlineError
from seafoam.render.service.jobs import EncodedFrame, FrameJob
from seafoam.render.service.queues import Ticket

router = APIRouter(prefix="/api/streams", tags=["frames"])

LATE_FRAMES = 3
"""Frames in a row that may miss their deadline, as while programs are compiled: after them each is an error."""
_FRAME = content("The frame, lossy, without recipe", "image/jpeg") | {
    204: {"description": "No frame: later ones of the stream were asked for, or it was not drawn before its deadline"}
}
StreamId = Annotated[str, Path(max_length=64, description="ID of the stream", examples=["Zk1uY2F0c2Vh"])]


class StreamState(Described):
    """The streams of this server."""

    limit: int = Field(description="Number of streams at once")
    open: int = Field(description="Number of streams that are open")


class OpenStream(StreamState):
    """A stream that was opened."""

    id: str = Field(description="ID, for the addresses of its frames")
    lease: float = Field(description="Time without a request after which the stream ends, s")


@router.get("", responses=problems(422))
async def get_streams(_: NoParameters, context: InContext) -> StreamState:
    """Get how many streams there are and may be."""
    return StreamState(limit=context.streams.limit, open=len(context.streams))


@router.post("", status_code=201, responses=problems(413, 415, 422, 501, 503))
async def open_stream(body: Strict[PlanRequest], response: Response, context: InContext) -> OpenStream:
    """Open a stream of frames of a scene. It ends when it is deleted, or not asked for a frame for a while.

    Single frames go before those of streams. Where all streams are taken, the answer is 503 with Retry-After.
    """
    streams = context.streams
    # Before the scene is planned, too: a crowd that is refused costs little.
    stream = streams.open(body.scene, await _planned(body, context)) if len(streams) < streams.limit else None
    if stream is None:
        raise StreamsFullError(f"all {streams.limit} streams are taken", RETRY_SECONDS)
    response.headers["Location"] = f"streams/{stream.id}"
    return OpenStream(id=stream.id, lease=LEASE_SECONDS, limit=streams.limit, open=len(streams))


@router.put("/{stream}", status_code=204, responses=problems(404, 413, 415, 422, 501, 503))
async def change_stream(stream: StreamId, body: Strict[PlanRequest], context: InContext) -> None:
    """Show another scene, or in another quality."""
    found = _find(stream, context)
    found.quality, found.scene = await _planned(body, context), body.scene


@router.delete("/{stream}", status_code=204, responses=problems(422))
async def close_stream(stream: StreamId, _: NoParameters, context: InContext) -> None:
    """End a stream, if it has not ended."""
    context.streams.close(stream)


@router.get("/{stream}/frame.jpg", responses=_FRAME | problems(404, 422, 500, 503, 504), response_class=Response)
async def get_stream_frame(
    stream: StreamId, query: Annotated[StreamFrameParameters, Query()], request: Request, context: InContext
) -> Response:
    """Get a frame of a stream as JPEG. A third one that is asked for gives up the oldest that waits (204)."""
    found = _find(stream, context)
    context.settings.frame_limits.check(query.width, query.height, found.quality.samples_drawn)
    camera, size = query.camera, (query.width, query.height)
    job = FrameJob(found.scene, found.quality, query.time, camera, *size, "png", None, dither=False, lossy=True)
    # No error: browsers would log one for every frame that a drag overtakes, or whose programs are yet compiled.
    none = Response(status_code=204, headers={"Cache-Control": NO_STORE})
    try:
        frame = await unless_gone(request, _drawn(found, job, context))
    except DeadlineError:
        found.late += 1
        if found.late > LATE_FRAMES:
            raise
        return none
    except asyncio.CancelledError:
        task = asyncio.current_task()
        if task is not None and task.cancelling():
            raise
        return none
    if frame is None:
        return Response(status_code=CLIENT_CLOSED_REQUEST)
    found.late = 0
    context.metrics.count_frame(frame, "jpeg")
    headers = {"Cache-Control": NO_STORE, "Server-Timing": server_timing(frame)}
    return Response(frame.content, headers=headers, media_type="image/jpeg")


async def _drawn(stream: Stream, job: FrameJob, context: Context) -> EncodedFrame:
    """Draw a frame in one of the stream's places; the task that this runs in is cancelled if a later one takes it."""
    ticket = Ticket(stream=True)
    try:
        async with stream.place(ticket, context.pool.waits):
            return await context.pool.render(job, ticket)
    finally:
        # It may have taken longer than the lease.
        context.streams.renew(stream)


async def _planned(body: PlanRequest, context: Context) -> Quality:
    """Return the quality, of a scene that can be planned with it."""
    quality = quality_of(body.quality)
    await context.compiled(body.scene, quality)
    return quality


def _find(stream: str, context: Context) -> Stream:
    found = context.streams.find(stream)
    if found is None:
        raise NotFoundError("the stream has ended: open another", "stream")
    return found
