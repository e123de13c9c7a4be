"""``/api/frames``: frames of presets and of scenes, rendered by the pool.

``/api/plans/{plan}/frames``: frames by the hash of their plan, at addresses whose picture never changes.
"""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request
from pydantic import BeforeValidator
from starlette.responses import Response

from seafoam.accuracy.sweep import Subject
from seafoam.api.context import InContext
from seafoam.api.frames.plans import ResolvedFrame
from seafoam.api.frames.respond import FRAME_RESPONSES, answer, answer_as_before, resolve_frame, with_quality
from seafoam.api.http import answers
from seafoam.api.http.parameters import (
    FORMATS,
    TIME_LIMIT,
    FrameParameters,
    FrameRequest,
    PlanFrameParameters,
    ThumbnailParameters,
)
from seafoam.api.http.problems import NotFoundError
from seafoam.api.http.validation import PresetName, Strict, find_preset, known_preset
from seafoam.numerals import numeral
from seafoam.quality import TIERS
from seafoam.render.encode import FrameFormat
from seafoam.render.service.jobs import FrameJob

router = APIRouter(prefix="/api", tags=["frames"], default_response_class=Response)

_CHOICE = {
    "Seafoam-Quality": "With quality auto: ID of the measured quality that was chosen",
    "Seafoam-Quality-Why": "With quality auto: predicted time, error and number of candidates",
}
_RESPONSES: answers.Responses = {
    200: {**FRAME_RESPONSES[200], "headers": FRAME_RESPONSES[200]["headers"] | answers.headers_of(_CHOICE)}
}
Format = Annotated[FrameFormat, Path(description=FORMATS)]


@router.get(
    "/plans/{plan}/frames/{time}.{format}",
    responses=FRAME_RESPONSES | answers.NOT_MODIFIED | answers.problems(404, 422, 500, 503, 504),
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
    format: Format,
    query: Annotated[PlanFrameParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get a frame of a plan. Its address names everything that the picture depends on, so caches keep it for good.

    Frames of presets and scenes name this address in their header Link.
    """

    async def resolve() -> ResolvedFrame:
        source = await context.plans.run(context.plan_index.find, plan)
        if source is None:
            raise NotFoundError(
                f"plan {plan} was not made by this server, or long ago: post its scene to /api/plans first", "plan"
            )
        view = query.camera, query.width, query.height
        job = FrameJob(source.scene, source.quality, time, *view, format, None, query.dither, query.precision)
        return await resolve_frame(job, request, {"Cache-Control": answers.IMMUTABLE}, "../..")

    return await answer_as_before(context, request, resolve)


@router.get(
    "/frames/{preset}.{format}",
    responses=_RESPONSES | answers.NOT_MODIFIED | answers.problems(404, 422, 500, 501, 503, 504),
)
async def get_frame(
    preset: PresetName, format: Format, query: Annotated[FrameParameters, Query()], request: Request, context: InContext
) -> Response:
    """Render a frame of a preset. Parameters that are absent take the preset's values."""

    async def resolve() -> ResolvedFrame:
        loaded = find_preset(preset)
        job = query.job(loaded, format)
        subject = Subject(None if query.changed else loaded.name, job.scene, loaded.time, loaded.size)
        job, chosen = await with_quality(job, query, subject, context)
        headers = {"Cache-Control": answers.REVALIDATE, **chosen}
        return await resolve_frame(job, request, headers, "../plans")

    # Once more is measured, the same request is answered by another quality.
    if query.quality == "auto":
        return await answer(await resolve(), request, context)
    return await answer_as_before(context, request, resolve)


@router.post("/frames", responses=_RESPONSES | answers.problems(413, 415, 422, 500, 501, 503, 504))
async def render_frame(body: Strict[FrameRequest], request: Request, context: InContext) -> Response:
    """Render a frame of a scene sent as JSON."""
    known_preset(body.preset)
    job, chosen = await with_quality(body.job, body, Subject.of_scene(body.scene), context)
    headers = {"Cache-Control": answers.NO_STORE, **chosen}
    return await answer(await resolve_frame(job, request, headers, "plans"), request, context)


@router.get(
    "/presets/{preset}/thumbnail.{format}",
    responses=FRAME_RESPONSES | answers.NOT_MODIFIED | answers.problems(404, 422, 500, 503, 504),
)
async def get_thumbnail(
    preset: PresetName,
    format: Format,
    query: Annotated[ThumbnailParameters, Query()],
    request: Request,
    context: InContext,
) -> Response:
    """Get a small frame of a preset at its own time. It is drawn when no other frame waits, within 60 s."""

    async def resolve() -> ResolvedFrame:
        loaded = find_preset(preset)
        scene, width = loaded.scene, query.width
        height = max(1, round(width * loaded.size[1] / loaded.size[0]))
        job = FrameJob(scene, TIERS["standard"], loaded.time, scene.camera, width, height, format, preset)
        return await resolve_frame(job, request, {"Cache-Control": answers.REVALIDATE}, "../../plans")

    return await answer_as_before(context, request, resolve, background=True)
