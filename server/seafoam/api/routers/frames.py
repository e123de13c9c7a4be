"""``/api/frames``: frames of presets and of scenes, rendered by the pool."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request
from starlette.responses import Response

from seafoam.accuracy.sweep import Subject
from seafoam.api.answering import FRAME_RESPONSES, NOT_MODIFIED, answer, asked_before, identify
from seafoam.api.auto import Asked, resolve
from seafoam.api.caching import NO_STORE, REVALIDATE
from seafoam.api.context import Context, InContext
from seafoam.api.errors import problem_responses
from seafoam.api.known import Identified
from seafoam.api.parameters import FORMATS, FrameParameters, FrameRequest, ThumbnailParameters
from seafoam.api.planning import compile_scene
from seafoam.api.routers.presets import PresetName, find_preset, known_preset
from seafoam.api.strict import strictly
from seafoam.quality import TIERS
from seafoam.render.encode import FrameFormat
from seafoam.render.service.jobs import FrameJob

router = APIRouter(prefix="/api", tags=["frames"])

_CHOICE = {
    "Seafoam-Quality": "With quality auto: ID of the measured quality that was chosen",
    "Seafoam-Quality-Why": "With quality auto: predicted time, error and number of candidates",
}
_HEADERS = FRAME_RESPONSES[200]["headers"] | {
    name: {"description": text, "schema": {"type": "string"}} for name, text in _CHOICE.items()
}
_RESPONSES: dict[int | str, dict[str, Any]] = {200: FRAME_RESPONSES[200] | {"headers": _HEADERS}}
_FORMAT = Path(description=FORMATS)


@router.get(
    "/frames/{preset}.{format}",
    responses=_RESPONSES | NOT_MODIFIED | problem_responses(404, 422, 500, 501, 503, 504),
    response_class=Response,
)
async def get_frame(
    preset: PresetName,
    format: Annotated[FrameFormat, _FORMAT],
    asked: Annotated[FrameParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Render a frame of a preset. Parameters that are absent take the preset's values."""
    if asked.quality == "auto":  # once more is measured, the same request is answered by another quality
        identified = await _identified(preset, format, asked, request, context)
    else:
        identified = await asked_before(context, request, lambda: _identified(preset, format, asked, request, context))
    return await answer(identified, request, context)


async def _identified(
    preset: str, format: FrameFormat, asked: FrameParameters, request: Request, context: Context
) -> Identified:
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
    camera = asked.camera(scene.camera)
    job = FrameJob(scene, quality, time, camera, width, height, format, preset, asked.dither, asked.precision)
    compiled = await context.plans.run(compile_scene, scene, quality, scene_at=None, parameters=asked.changed)
    return await identify(job, compiled, request, {"Cache-Control": REVALIDATE, **chosen}, "../plans")


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
    size = body.width, body.height
    job = FrameJob(body.scene, quality, body.time, camera, *size, body.format, body.preset, body.dither, body.precision)
    compiled = await context.plans.run(compile_scene, body.scene, quality, scene_at="/scene")
    identified = await identify(job, compiled, request, {"Cache-Control": NO_STORE, **chosen}, "plans")
    return await answer(identified, request, context)


@router.get(
    "/presets/{preset}/thumbnail.{format}",
    responses=FRAME_RESPONSES | NOT_MODIFIED | problem_responses(404, 422, 500, 503, 504),
    response_class=Response,
)
async def get_thumbnail(
    preset: PresetName,
    format: Annotated[FrameFormat, _FORMAT],
    asked: Annotated[ThumbnailParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get a small frame of a preset at its own time. It is drawn when no other frame waits, within 60 s."""
    identified = await asked_before(context, request, lambda: _thumbnail(preset, format, asked.width, request, context))
    return await answer(identified, request, context, background=True)


async def _thumbnail(preset: str, format: FrameFormat, width: int, request: Request, context: Context) -> Identified:
    loaded = find_preset(preset)
    height = max(1, round(width * loaded.size[1] / loaded.size[0]))
    quality, scene = TIERS["standard"], loaded.scene
    context.settings.frame_limits.check(width, height, quality.samples_drawn)
    job = FrameJob(scene, quality, loaded.time, scene.camera, width, height, format, preset)
    compiled = await context.plans.run(compile_scene, scene, quality, scene_at=None)
    return await identify(job, compiled, request, {"Cache-Control": REVALIDATE}, "../../plans")
