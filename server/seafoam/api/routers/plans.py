"""``/api/plans``: frame plans, compiled scenes for an executor to run."""

from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from seafoam.api.context import Context, InContext
from seafoam.api.frames.compile import CompiledPlan, compile_scene
from seafoam.api.frames.presets import PresetName, find_preset
from seafoam.api.http.errors import problem_responses
from seafoam.api.http.etags import NO_STORE, REVALIDATE, not_modified
from seafoam.api.http.parameters import PlanParameters, PlanRequest, quality_of
from seafoam.api.http.validation import strictly
from seafoam.framegraph.plan import FramePlan
from seafoam.quality import TIERS, Quality
from seafoam.scene.models import Scene

router = APIRouter(prefix="/api", tags=["plans"])

_HEADERS = {
    "ETag": {
        "description": "Quoted SHA-256 of the plan, weak where the answer is compressed",
        "schema": {"type": "string"},
    },
    "Seafoam-Plan": {"description": "SHA-256 of the plan", "schema": {"type": "string"}},
}
_RESPONSES: dict[int | str, dict[str, Any]] = {
    200: {
        "model": FramePlan,
        "description": "The frame plan; the same scene and quality give the same bytes",
        "headers": _HEADERS,
    }
}
_NOT_MODIFIED: dict[int | str, dict[str, Any]] = {
    304: {"description": "Not modified: the copy named by If-None-Match is current"}
}


@router.get(
    "/plans/{preset}",
    responses=_RESPONSES | _NOT_MODIFIED | problem_responses(404, 422, 501, 503),
    response_class=Response,
)
async def get_plan(
    preset: PresetName, asked: Annotated[PlanParameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the frame plan of a preset."""
    scene = asked.apply(find_preset(preset).scene)
    compiled = await context.plans.run(
        compile_scene, scene, TIERS[asked.quality], scene_at=None, parameters=asked.changed
    )
    await _remember(compiled, scene, TIERS[asked.quality], context)
    headers = {"Cache-Control": REVALIDATE, "Seafoam-Plan": compiled.sha256}
    return not_modified(request, f'"{compiled.sha256}"', headers) or _plan(compiled, headers)


@router.post("/plans", responses=_RESPONSES | problem_responses(413, 415, 422, 501, 503), response_class=Response)
async def make_plan(asked: strictly(PlanRequest), context: InContext) -> Response:  # type: ignore[valid-type]
    """Compile a scene sent as JSON into a frame plan."""
    body: PlanRequest = asked
    quality = quality_of(body.quality)
    compiled = await context.plans.run(compile_scene, body.scene, quality, scene_at="/scene")
    await _remember(compiled, body.scene, quality, context)
    return _plan(compiled, {"Cache-Control": NO_STORE, "Seafoam-Plan": compiled.sha256})


async def _remember(compiled: CompiledPlan, scene: Scene, quality: Quality, context: Context) -> None:
    """Let the plan's hash be an address of its frames."""
    if not context.plan_index.holds(compiled.sha256):
        await context.plans.run(context.plan_index.remember, compiled.sha256, scene, quality)


def _plan(compiled: CompiledPlan, headers: dict[str, str]) -> Response:
    tagged = {"ETag": f'"{compiled.sha256}"', **headers}
    return Response(compiled.content, headers=tagged, media_type="application/json")
