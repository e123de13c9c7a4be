"""Answers with frames, the same for every address that has them."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from typing import Any, TypeVar
from urllib.parse import urlencode

from fastapi import Request
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from seafoam.api.context import Context
from seafoam.api.frames.compile import CompiledPlan
from seafoam.api.frames.request_cache import Identified
from seafoam.api.http.etags import not_modified
from seafoam.render.encode import MEDIA_TYPES
from seafoam.render.service.jobs import EncodedFrame, FrameJob
from seafoam.render.service.source import Found

STAGES = ("queue", "plan", "render", "read", "encode")
CLIENT_CLOSED_REQUEST = 499
"""nginx's status for a client that disconnected; it appears only in the log and the metrics."""
_TEXT = {"type": "string"}
T = TypeVar("T")
FRAME_RESPONSES: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The frame: an sRGB image; linear R, G, B, coverage, normal and distance as OpenEXR; or a "
        "linear float32 array (height, width, 4) with foam coverage in the last channel",
        "content": {media: {"schema": {"type": "string", "format": "binary"}} for media in MEDIA_TYPES.values()},
        "headers": {
            "ETag": {
                "description": "Entity tag of the response bytes; it depends on the renderer too",
                "schema": _TEXT,
            },
            "Server-Timing": {
                "description": f"Time per stage, ms: {', '.join(STAGES)}; or `cache` with where the frame was: memory, "
                "disk, or shared with another request",
                "schema": _TEXT,
            },
            "Seafoam-Plan": {"description": "SHA-256 of the frame plan", "schema": _TEXT},
            "Seafoam-Renderer": {"description": "Name of the GL renderer", "schema": _TEXT},
            "Link": {"description": "The frame's immutable address (rel=canonical)", "schema": _TEXT},
        },
    }
}
NOT_MODIFIED: dict[int | str, dict[str, Any]] = {
    304: {"description": "Not modified: the copy named by If-None-Match is current"}
}


async def asked_before(context: Context, request: Request, find: Callable[[], Awaitable[Identified]]) -> Identified:
    """Return what a request asks for: as found before with the same renderer, or else by ``find``."""
    identified = context.request_cache.get(request.scope, context.pool.info)
    if identified is None:
        identified = await find()
        context.request_cache.put(request.scope, context.pool.info, identified)
    return identified


class Repeats:
    """ASGI middleware: answers repeats of GET requests from memory, before they are routed, checked and planned.

    It costs a tenth of what the whole way to the same answer does. What is not at hand goes that way.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        response = None
        if scope["type"] == "http" and scope["method"] == "GET":
            context: Context = scope["app"].state.context
            identified = context.request_cache.get(scope, context.pool.info)
            if identified is not None:
                response = at_hand(identified, Request(scope), context)
                scope["route"] = identified.route  # by which requests are counted
        await (response or self.app)(scope, receive, send)


def at_hand(identified: Identified, request: Request, context: Context) -> Response | None:
    """Return the answer to a GET if the client has it (304) or it is in memory, else None."""
    if current := not_modified(request, f'"{identified.key}"', identified.headers):
        return current
    content = context.frames.at_hand(identified.key)
    return None if content is None else _response(identified, content, 'cache;desc="memory"')


async def identify(
    job: FrameJob, compiled: CompiledPlan, request: Request, headers: Mapping[str, str], plans_at: str
) -> Identified:
    """Find key and headers of a frame, and remember its plan. plans_at: relative address of ``/api/plans``."""
    context: Context = request.app.state.context
    await context.pool.wait_until_settled()
    plan = compiled.sha256
    if not context.plan_index.holds(plan):
        await context.plans.run(context.plan_index.remember, plan, job.scene, job.quality)
    own = {
        "Seafoam-Plan": plan,
        "Seafoam-Renderer": context.pool.info["renderer"],
        "Link": f'<{plans_at}/{_address(job, plan)}>; rel="canonical"',
    }
    return Identified(job, context.frames.key(job, plan), {**own, **headers}, request.scope["route"])


async def answer(identified: Identified, request: Request, context: Context, *, background: bool = False) -> Response:
    """Answer with a frame, or a GET with 304 if the client's copy is current. background: visitors go first."""
    if request.method == "GET" and (response := at_hand(identified, request, context)):
        return response
    frame = context.frames.frame(identified.job, identified.key, background=background)
    found = await unless_gone(request, frame)
    if found is None:
        return Response(status_code=CLIENT_CLOSED_REQUEST)
    if found.origin == "drawn":
        context.metrics.count_frame(found.frame, identified.job.format)
        if context.traces is not None:
            context.traces.stages({stage: found.frame.timings[stage] for stage in STAGES})
    return _response(identified, found.frame.content, _timing(found))


def _response(identified: Identified, content: bytes, timing: str) -> Response:
    headers = {"ETag": f'"{identified.key}"', "Server-Timing": timing, **identified.headers}
    return Response(content, headers=headers, media_type=MEDIA_TYPES[identified.job.format])


def _timing(found: Found) -> str:
    if found.origin != "drawn":
        return f'cache;desc="{found.origin}"'
    return stages(found.frame)


def stages(frame: EncodedFrame) -> str:
    """Return the value of ``Server-Timing`` of a frame that was drawn."""
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
