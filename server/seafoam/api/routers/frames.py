"""``/api/frames``: frames of presets and of scenes, rendered by the pool.

``/api/plans/{plan}/frames``: frames by the hash of their plan, at addresses whose picture never changes.
"""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request
from pydantic import BeforeValidator
from starlette.responses import Response

from seafoam.accuracy.sweep import Subject
from seafoam.api.context import Context, InContext
from seafoam.api.frames.auto_quality import Asked, resolve
from seafoam.api.frames.compile import compile_scene
from seafoam.api.frames.presets import PresetName, find_preset, known_preset
from seafoam.api.frames.request_cache import Identified
from seafoam.api.frames.respond import FRAME_RESPONSES, NOT_MODIFIED, answer, asked_before, identify
from seafoam.api.http.errors import problem_responses
from seafoam.api.http.etags import IMMUTABLE, NO_STORE, REVALIDATE
from seafoam.api.http.parameters import (
    FORMATS,
    TIME_LIMIT,
    FrameParameters,
    FrameRequest,
    PlanFrameParameters,
    ThumbnailParameters,
)
from seafoam.api.http.problems import NotFoundError
from seafoam.api.http.validation import strictly
from seafoam.numerals import numeral
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
    "/plans/{plan}/frames/{time}.{format}",
    responses=FRAME_RESPONSES | NOT_MODIFIED | problem_responses(404, 422, 500, 503, 504),
    response_class=Response,
)
async def get_plan_frame(
    plan: Annotated[
        str, Path(pattern="^[0-9a-f]{64}$", description="SHA-256 of a plan that this server has made: Seafoam-Plan")
    ],
    time: Annotated[
        float,
        Path(ge=-TIME_LIMIT, le=TIME_LIMIT, allow_inf_nan=False, description="Time, s", examples=[12.5]),
        BeforeValidator(numeral),  # after the bounds, which the schema then names
    ],
    format: Annotated[FrameFormat, Path(description=FORMATS)],
    asked: Annotated[PlanFrameParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get a frame of a plan. Its address names everything that the picture depends on, so caches keep it for good.

    Frames of presets and scenes name this address in their header Link.
    """
    identified = await asked_before(context, request, lambda: _plan_frame(plan, time, format, asked, request, context))
    return await answer(identified, request, context)


async def _plan_frame(
    plan: str, time: float, format: FrameFormat, asked: PlanFrameParameters, request: Request, context: Context
) -> Identified:
    source = await context.plans.run(context.plan_index.find, plan)
    if source is None:
        raise NotFoundError(
            f"plan {plan} was not made by this server, or long ago: post its scene to /api/plans first", "plan"
        )
    scene, quality = source.scene, source.quality
    context.settings.frame_limits.check(asked.width, asked.height, quality.samples_drawn)
    size = asked.width, asked.height
    job = FrameJob(scene, quality, time, asked.camera, *size, format, None, asked.dither, asked.precision)
    compiled = await context.plans.run(compile_scene, scene, quality, scene_at=None)
    return await identify(job, compiled, request, {"Cache-Control": IMMUTABLE}, "../..")


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
