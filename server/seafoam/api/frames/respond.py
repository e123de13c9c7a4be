"""Answers with frames, the same for every address that has them; ``quality=auto`` by measurements on this server."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import replace
from typing import Any, TypeVar
from urllib.parse import urlencode

from fastapi import Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from seafoam.accuracy.model import Running
from seafoam.accuracy.sweep import Subject
from seafoam.accuracy.timing import choose
from seafoam.api.context import Context, retry_seconds
from seafoam.api.frames.plans import ADDRESS_KEPT, ResolvedFrame, address_of
from seafoam.api.http.answers import content, not_modified
from seafoam.api.http.middleware import HttpMiddleware
from seafoam.api.http.parameters import FrameParameters, FrameRequest
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotMeasuredError
from seafoam.api.watch.metrics import trace_stages
from seafoam.render.encode import MEDIA_TYPES
from seafoam.render.service.jobs import EncodedFrame, FrameJob

STAGES = ("queue", "plan", "render", "read", "encode")
CLIENT_CLOSED_REQUEST = 499
"""nginx's status for a client that disconnected; it appears only in the log and the metrics."""
T = TypeVar("T")
FRAME_RESPONSES = content(
    "The frame: an sRGB image; linear R, G, B, coverage, normal and distance as OpenEXR; or a linear float32 array "
    "(height, width, 4) with foam coverage in the last channel",
    *MEDIA_TYPES.values(),
    headers={
        "ETag": "Entity tag of the response bytes; it depends on the renderer too",
        "Server-Timing": f"Time per stage, ms: {', '.join(STAGES)}; or `cache` with where the frame was: memory, "
        "disk, or shared with another request",
        "Seafoam-Plan": "SHA-256 of the frame plan",
        "Seafoam-Renderer": "Name of the GL renderer",
        "Link": "The frame's immutable address (rel=canonical)",
    },
)


async def answer_as_before(
    context: Context, request: Request, find: Callable[[], Awaitable[ResolvedFrame]], *, background: bool = False
) -> Response:
    """Answer with what a request asks for: as found before with the same renderer, or else by ``find``."""
    resolved = context.request_cache.get(address_of(request.scope, context.pool.info))
    if resolved is None:
        resolved = await find()
        if len(request.scope["query_string"]) <= ADDRESS_KEPT:
            context.request_cache.put(address_of(request.scope, context.pool.info), resolved)
    return await answer(resolved, request, context, background=background)


class AnswerFromMemory(HttpMiddleware):
    """ASGI middleware: answers repeats of GET requests from memory, before they are routed, checked and planned.

    It costs a tenth of what the whole way to the same answer does. What is not at hand goes that way.
    """

    async def _handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        response = None
        if scope["method"] == "GET":
            context: Context = scope["app"].state.context
            resolved = context.request_cache.get(address_of(scope, context.pool.info))
            if resolved is not None:
                response = at_hand(resolved, Request(scope), context)
                scope["route"] = resolved.route  # by which requests are counted
        await (response or self.app)(scope, receive, send)


def at_hand(resolved: ResolvedFrame, request: Request, context: Context) -> Response | None:
    """Return the answer to a GET if the client has it (304) or it is in memory, else None."""
    if current := not_modified(request, f'"{resolved.key}"', resolved.headers):
        return current
    held = context.frames.at_hand(resolved.key)
    return None if held is None else _response(resolved, held)


async def resolve_frame(job: FrameJob, request: Request, headers: Mapping[str, str], plans_at: str) -> ResolvedFrame:
    """Check and plan a frame, and find its key and headers. plans_at: relative address of ``/api/plans``."""
    context: Context = request.app.state.context
    context.settings.frame_limits.check(job.width, job.height, job.quality.samples_drawn)
    plan = (await context.addressed(job.scene, job.quality)).sha256
    await context.pool.wait_until_settled()
    own = {
        "Seafoam-Plan": plan,
        "Seafoam-Renderer": context.pool.info["renderer"],
        "Link": f'<{plans_at}/{_address(job, plan)}>; rel="canonical"',
    }
    return ResolvedFrame(job, context.frames.key(job, plan), {**own, **headers}, request.scope["route"])


async def answer(resolved: ResolvedFrame, request: Request, context: Context, *, background: bool = False) -> Response:
    """Answer with a frame, or a GET with 304 if the client's copy is current. background: visitors go first."""
    if request.method == "GET" and (response := at_hand(resolved, request, context)):
        return response
    frame = await unless_gone(request, context.frames.frame(resolved.job, resolved.key, background=background))
    if frame is None:
        return Response(status_code=CLIENT_CLOSED_REQUEST)
    if frame.origin == "drawn":
        context.metrics.count_frame(frame, resolved.job.format)
        trace_stages({stage: frame.timings[stage] for stage in STAGES})
    return _response(resolved, frame)


def _response(resolved: ResolvedFrame, frame: EncodedFrame) -> Response:
    headers = {"ETag": f'"{resolved.key}"', "Server-Timing": server_timing(frame), **resolved.headers}
    return Response(frame.content, headers=headers, media_type=MEDIA_TYPES[resolved.job.format])


def server_timing(frame: EncodedFrame) -> str:
    """Return the value of ``Server-Timing``: the stages of a frame that was drawn, or where else it was."""
    if frame.origin != "drawn":
        return f'cache;desc="{frame.origin}"'
    return ", ".join(f"{stage};dur={1000 * frame.timings[stage]:.2f}" for stage in STAGES)


def _address(job: FrameJob, plan: str) -> str:
    """Return the address of a frame below ``/api/plans``, which names all that the picture depends on."""
    camera = job.camera
    x, y, z = camera.position
    query: dict[str, Any] = {"width": job.width, "height": job.height, "x": x, "y": y, "z": z}
    query |= {"yaw": camera.yaw, "pitch": camera.pitch, "roll": camera.roll, "fov": camera.fov}
    if job.format in ("png", "webp") and not job.dither:
        query["dither"] = "false"
    if job.format == "exr" and job.precision != "half":
        query["precision"] = job.precision
    return f"{plan}/frames/{job.time!r}.{job.format}?{urlencode(query)}"


async def unless_gone(request: Request, making: Awaitable[T]) -> T | None:
    """Return what is made, or None if the client disconnected: a frame then leaves the queue."""
    rendering = asyncio.ensure_future(making)
    leaving = asyncio.ensure_future(_client_gone(request))
    try:
        await asyncio.wait({rendering, leaving}, return_when=asyncio.FIRST_COMPLETED)
        return await rendering if rendering.done() else None
    finally:
        for task in (rendering, leaving):
            if not task.done():
                task.cancel()
                await asyncio.gather(task, return_exceptions=True)


async def _client_gone(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def with_quality(
    job: FrameJob, asked: FrameParameters | FrameRequest, subject: Subject, context: Context
) -> tuple[FrameJob, Mapping[str, str]]:
    """Return a job with the quality that was asked for, and headers that explain an automatic choice.

    The prediction holds for the subject's own camera and time, which can differ from the frame's. Raises
    :class:`NotMeasuredError` while the subject is being measured; the first call starts the measurement.
    """
    if asked.quality != "auto":
        if asked.budget_ms is not None:
            raise _refused(asked, "allowed only with quality auto")
        return job, {}
    # A scene that cannot be planned is refused before it is measured.
    await context.compiled(job.scene, job.quality)
    if asked.budget_ms is None:
        raise _refused(asked, "quality auto requires budget_ms, the frame time allowed in milliseconds")
    limits = context.settings.frame_limits
    size = job.width, job.height
    limits.check(*size, 1)
    sweep = await context.measured(subject)
    if isinstance(sweep, Running):
        what = f"preset {subject.preset}" if subject.preset else "this scene"
        state = "is queued for measurement" if sweep.status == "queued" else f"is {100 * sweep.progress:.0f} % measured"
        detail = f"cost of accuracy: {what} {state}; retry later, or name a tier"
        raise NotMeasuredError(detail, retry_seconds(sweep))
    choice = choose(sweep, *size, asked.budget_ms, lambda quality: limits.allows(*size, quality.samples_drawn))
    headers = {"Seafoam-Quality": choice.point.id, "Seafoam-Quality-Why": choice.why}
    return replace(job, quality=choice.point.quality), headers


def _refused(asked: FrameParameters | FrameRequest, detail: str) -> BadRequestError:
    place = {"parameter": "budget_ms"} if isinstance(asked, FrameParameters) else {"pointer": "/budget_ms"}
    return BadRequestError(FieldProblem(**place, detail=f"budget_ms: {detail}"))
