"""``/api/frames``: frames, rendered by the pool."""

import asyncio
from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request
from starlette.responses import Response

from seafoam.accuracy.sweep import Subject
from seafoam.api.auto import Asked, resolve
from seafoam.api.caching import NO_STORE, REVALIDATE, not_modified, tag_of
from seafoam.api.context import Context, InContext
from seafoam.api.errors import problem_responses
from seafoam.api.parameters import FrameParameters, FrameRequest, strictly
from seafoam.api.planning import CompiledPlan, compile_scene
from seafoam.api.routers.presets import PresetName, find_preset, known_preset
from seafoam.quality import TIERS
from seafoam.render.encode import MEDIA_TYPES, FrameFormat
from seafoam.render.service.jobs import Frame, FrameJob
from seafoam.render.service.recipe import recipe_of

router = APIRouter(prefix="/api", tags=["frames"])

STAGES = ("queue", "plan", "render", "read", "encode")
CLIENT_CLOSED_REQUEST = 499
"""nginx's status for a client that disconnected; it appears only in the log and the metrics."""

_TEXT = {"type": "string"}
_RESPONSES: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The frame: an sRGB image, or a linear float32 array (height, width, 4) with foam "
        "coverage in the last channel",
        "content": {media: {"schema": {"type": "string", "format": "binary"}} for media in MEDIA_TYPES.values()},
        "headers": {
            "ETag": {
                "description": "Entity tag of the response bytes; it depends on the renderer too",
                "schema": _TEXT,
            },
            "Server-Timing": {"description": f"Time per stage, ms: {', '.join(STAGES)}", "schema": _TEXT},
            "Seafoam-Plan": {"description": "SHA-256 of the frame plan", "schema": _TEXT},
            "Seafoam-Renderer": {"description": "Name of the GL renderer", "schema": _TEXT},
            "Seafoam-Quality": {
                "description": "With quality auto: ID of the measured quality that was chosen",
                "schema": _TEXT,
            },
            "Seafoam-Quality-Why": {
                "description": "With quality auto: predicted time, error and number of candidates",
                "schema": _TEXT,
            },
        },
    }
}
_NOT_MODIFIED: dict[int | str, dict[str, Any]] = {
    304: {"description": "Not modified: the copy named by If-None-Match is current"}
}


@router.get(
    "/frames/{preset}.{format}",
    responses=_RESPONSES | _NOT_MODIFIED | problem_responses(404, 422, 500, 501, 503, 504),
    response_class=Response,
)
async def get_frame(
    preset: PresetName,
    format: Annotated[FrameFormat, Path(description="png, webp (lossless), or npy (linear float32)")],
    asked: Annotated[FrameParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Render a frame of a preset. Parameters that are absent take the preset's values."""
    loaded = find_preset(preset)
    width = loaded.size[0] if asked.width is None else asked.width
    height = loaded.size[1] if asked.height is None else asked.height
    scene = asked.apply(loaded.scene)
    time = loaded.time if asked.time is None else asked.time
    subject = Subject(None if asked.changed else loaded.name, scene, loaded.time, loaded.size)
    given = Asked(asked.quality, asked.budget_ms, width, height, parameter=True)
    if asked.quality == "auto":  # a scene that cannot be planned is refused before it is measured
        await context.plans.run(compile_scene, scene, TIERS["standard"], scene_at=None, parameters=asked.changed)
    quality, chosen = await resolve(given, subject, context)
    context.settings.frame_limits.check(width, height, quality.samples_drawn)
    job = FrameJob(scene, quality, time, asked.camera(scene.camera), width, height, format, preset)
    compiled = await context.plans.run(compile_scene, scene, quality, scene_at=None, parameters=asked.changed)
    tag, headers = await _identity(job, compiled, context)
    headers |= {"Cache-Control": REVALIDATE, **chosen}
    return not_modified(request, tag, headers) or await _rendered(job, tag, headers, request, context)


@router.post(
    "/frames", responses=_RESPONSES | problem_responses(413, 415, 422, 500, 501, 503, 504), response_class=Response
)
async def render_frame(asked: strictly(FrameRequest), request: Request, context: InContext) -> Response:  # type: ignore[valid-type]
    """Render a frame of a scene sent as JSON."""
    body: FrameRequest = asked
    known_preset(body.preset)
    given = Asked(body.quality, body.budget_ms, body.width, body.height, parameter=False)
    if body.quality == "auto":
        await context.plans.run(compile_scene, body.scene, TIERS["standard"], scene_at="/scene")
    quality, chosen = await resolve(given, Subject.of_scene(body.scene), context)
    context.settings.frame_limits.check(body.width, body.height, quality.samples_drawn)
    camera = body.camera or body.scene.camera
    job = FrameJob(body.scene, quality, body.time, camera, body.width, body.height, body.format, body.preset)
    compiled = await context.plans.run(compile_scene, body.scene, quality, scene_at="/scene")
    tag, headers = await _identity(job, compiled, context)
    headers |= {"Cache-Control": NO_STORE, **chosen}
    return await _rendered(job, tag, headers, request, context)


async def _identity(job: FrameJob, compiled: CompiledPlan, context: Context) -> tuple[str, dict[str, str]]:
    """Return entity tag and headers of a frame, before it is rendered."""
    await context.pool.wait_until_settled()
    info = context.pool.info
    camera = job.camera.model_dump(mode="json")
    # Only a PNG carries the recipe, which says more than the plan: also what the plan leaves out.
    recipe = recipe_of(job, info) if job.format == "png" else None
    tag = tag_of(compiled.sha256, job.time, camera, job.width, job.height, job.format, info, recipe)
    return tag, {"Seafoam-Plan": compiled.sha256, "Seafoam-Renderer": info["renderer"]}


async def _rendered(job: FrameJob, tag: str, headers: dict[str, str], request: Request, context: Context) -> Response:
    frame = await _unless_gone(request, context, job)
    if frame is None:
        return Response(status_code=CLIENT_CLOSED_REQUEST)
    context.metrics.count_frame(frame, job.format)
    timing = ", ".join(f"{stage};dur={1000 * frame.timings[stage]:.2f}" for stage in STAGES)
    return Response(
        frame.content,
        headers={"ETag": tag, "Server-Timing": timing, **headers},
        media_type=MEDIA_TYPES[job.format],
    )


async def _unless_gone(request: Request, context: Context, job: FrameJob) -> Frame | None:
    """Return the frame, or None if the client disconnected: the frame then leaves the queue."""
    rendering = asyncio.ensure_future(context.pool.render(job))
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
