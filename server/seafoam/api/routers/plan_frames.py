"""``/api/plans/{plan}/frames``: frames by the hash of their plan, at addresses whose picture never changes."""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request
from pydantic import BeforeValidator
from starlette.responses import Response

from seafoam.api.answering import FRAME_RESPONSES, NOT_MODIFIED, answer, asked_before, identify
from seafoam.api.caching import IMMUTABLE
from seafoam.api.context import Context, InContext
from seafoam.api.errors import problem_responses
from seafoam.api.known import Identified
from seafoam.api.parameters import FORMATS, TIME_LIMIT, PlanFrameParameters
from seafoam.api.planning import compile_scene
from seafoam.api.problems import NotFoundError
from seafoam.numerals import numeral
from seafoam.render.encode import FrameFormat
from seafoam.render.service.jobs import FrameJob

router = APIRouter(prefix="/api", tags=["frames"])


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
    identified = await asked_before(context, request, lambda: _identified(plan, time, format, asked, request, context))
    return await answer(identified, request, context)


async def _identified(
    plan: str, time: float, format: FrameFormat, asked: PlanFrameParameters, request: Request, context: Context
) -> Identified:
    source = await context.plans.run(context.known.find, plan)
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
