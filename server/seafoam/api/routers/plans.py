"""``/api/plans``: frame plans, compiled scenes for an executor to run."""

from typing import Annotated

from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from seafoam.api.context import InContext
from seafoam.api.frames.plans import CompiledPlan
from seafoam.api.http import answers
from seafoam.api.http.parameters import PlanParameters, PlanRequest, quality_of
from seafoam.api.http.validation import PresetName, Strict, find_preset
from seafoam.framegraph.plan import FramePlan
from seafoam.quality import TIERS

router = APIRouter(prefix="/api", tags=["plans"], default_response_class=Response)

_HEADERS = {
    "ETag": "Quoted SHA-256 of the plan, weak where the answer is compressed",
    "Seafoam-Plan": "SHA-256 of the plan",
}
_RESPONSES: answers.Responses = {
    200: {
        "model": FramePlan,
        "description": "The frame plan; the same scene and quality give the same bytes",
        "headers": answers.headers_of(_HEADERS),
    }
}


@router.get("/plans/{preset}", responses=_RESPONSES | answers.NOT_MODIFIED | answers.problems(404, 422, 501, 503))
async def get_plan(
    preset: PresetName, query: Annotated[PlanParameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the frame plan of a preset."""
    scene = query.apply(find_preset(preset).scene)
    compiled = await context.addressed(scene, TIERS[query.quality])
    headers = {"Cache-Control": answers.REVALIDATE, "Seafoam-Plan": compiled.sha256}
    return answers.not_modified(request, f'"{compiled.sha256}"', headers) or _plan(compiled, headers)


@router.post("/plans", responses=_RESPONSES | answers.problems(413, 415, 422, 501, 503))
async def make_plan(body: Strict[PlanRequest], context: InContext) -> Response:
    """Compile a scene sent as JSON into a frame plan."""
    quality = quality_of(body.quality)
    compiled = await context.addressed(body.scene, quality)
    return _plan(compiled, {"Cache-Control": answers.NO_STORE, "Seafoam-Plan": compiled.sha256})


def _plan(compiled: CompiledPlan, headers: dict[str, str]) -> Response:
    tagged = {"ETag": f'"{compiled.sha256}"', **headers}
    return Response(compiled.content, headers=tagged, media_type="application/json")
