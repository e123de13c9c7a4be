"""Scenes and qualities.

``/api/presets``: the named scenes. ``/api/quality``: tiers and settings. ``/api/schema``: the JSON schemas of both.
``/api/scenes``: scenes checked and completed. ``/api/plans``: scenes compiled for an executor to run.
"""

from threading import Lock
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from pydantic import BaseModel, Field
from starlette.responses import Response

from seafoam.accuracy.model import ParameterInfo
from seafoam.accuracy.points import every_parameter
from seafoam.api.context import InContext, ThreadPool
from seafoam.api.frames.plans import CompiledPlan, compile_scene
from seafoam.api.http import answers
from seafoam.api.http.answers import problems
from seafoam.api.http.parameters import PlanParameters, PlanRequest, quality_of
from seafoam.api.http.validation import NoParameters, PresetName, Strict, find_preset
from seafoam.described import Described
from seafoam.framegraph.plan import FramePlan
from seafoam.library.request import schemas
from seafoam.quality import TIERS, Quality, Tier
from seafoam.scene import Group, Scene, load_preset, preset_names

router = APIRouter(prefix="/api", tags=["presets"])
plans = APIRouter(prefix="/api", tags=["plans"], default_response_class=Response)


class PresetSummary(BaseModel):
    """A preset without its scene."""

    name: str
    group: Group = Field(description="Heading of the menu under which the preset is listed")
    title: str
    summary: str
    size: tuple[int, int] = Field(description="Recommended width and height, pixels")
    time: float = Field(description="Recommended time, s")
    effects: list[str] = Field(description="Names of the effects in use")


class PresetDetail(PresetSummary):
    """A preset with its scene."""

    scene: Scene


class QualityTiers(BaseModel):
    """Quality tiers and settings."""

    tiers: dict[Tier, Quality] = Field(description="Settings of each named tier, fastest first")
    parameters: dict[str, Any] = Field(description="JSON schema of the quality settings, with ranges and defaults")
    measured: list[ParameterInfo] = Field(description="Title, owner and measured values of each setting")


_summaries: dict[str, PresetSummary] = {}
_one_at_a_time = Lock()


def _summary(name: str) -> PresetSummary:
    """Return a preset's list entry, kept, because its effects require a plan. Raises ``KeyError``."""
    # A list that is asked for while presets are still planned waits for these plans, and does not make them again.
    with _one_at_a_time:
        if name not in _summaries:
            preset = load_preset(name)
            effects = [effect.name for effect in compile_scene(preset.scene, TIERS["standard"]).plan.effects]
            own = preset.model_dump(include=set(PresetSummary.model_fields))
            _summaries[name] = PresetSummary(**own, effects=effects)
        return _summaries[name]


async def warm(threads: ThreadPool) -> None:
    """Plan every preset once, so that the first list request is fast; one at a time, so as not to delay others."""
    for name in preset_names():
        await threads.run(_summary, name)


@router.get("/presets", responses=problems(422, 503))
async def list_presets(_: NoParameters, context: InContext) -> list[PresetSummary]:
    """List all presets, in menu order."""
    return await context.plans.run(lambda: [_summary(name) for name in preset_names()])


@router.get("/presets/{preset}", responses=problems(404, 422, 503))
async def get_preset(preset: PresetName, _: NoParameters, context: InContext) -> PresetDetail:
    """Get a preset with its scene, which can be changed and posted to /api/frames and /api/plans."""
    loaded = find_preset(preset)
    summary = await context.plans.run(_summary, preset)
    return PresetDetail(**summary.model_dump(), scene=loaded.scene)


@router.get("/quality", responses=problems(422))
async def get_quality(_: NoParameters) -> QualityTiers:
    """Get the quality tiers with the value of every setting, and the allowed values of each setting."""
    measured = [ParameterInfo(owner=owner, **vars(parameter)) for owner, parameter in every_parameter()]
    return QualityTiers(tiers=TIERS, parameters=Quality.model_json_schema(), measured=measured)


class Schemas(Described):
    """Schemas of what a client edits."""

    tiers: list[Tier] = Field(description="Names of the quality tiers, fastest first")
    components: dict[str, dict[str, Any]]
    """`schemas`: the JSON schemas of Scene, Quality and their parts, as in the OpenAPI document"""


@router.get("/schema", responses=problems(422))
def get_schema(_: NoParameters) -> Schemas:
    """Get the JSON schemas of scene and quality alone, a third of the OpenAPI document."""
    return Schemas(**schemas())


@router.post("/scenes", responses=problems(413, 415, 422, 501, 503))
async def complete_scene(scene: Strict[Scene], context: InContext) -> Scene:
    """Check a scene sent as JSON, and return it with the default of every absent field."""
    await context.compiled(scene, TIERS["standard"])
    return scene


_PLAN_HEADERS = {"ETag": "Quoted SHA-256 of the plan", "Seafoam-Plan": "SHA-256 of the plan"}
_PLAN: answers.Responses = {
    200: {
        "model": FramePlan,
        "description": "The frame plan; the same scene and quality give the same bytes",
        "headers": answers.headers_of(_PLAN_HEADERS),
    }
}


@plans.get("/plans/{preset}", responses=_PLAN | answers.NOT_MODIFIED | problems(404, 422, 501, 503))
async def get_plan(
    preset: PresetName, query: Annotated[PlanParameters, Query()], request: Request, context: InContext
) -> Response:
    """Get the frame plan of a preset."""
    scene = query.apply(find_preset(preset).scene)
    compiled = await context.addressed(scene, TIERS[query.quality])
    headers = {"Cache-Control": answers.REVALIDATE, "Seafoam-Plan": compiled.sha256}
    return answers.not_modified(request, f'"{compiled.sha256}"', headers) or _plan(compiled, headers)


@plans.post("/plans", responses=_PLAN | problems(413, 415, 422, 501, 503))
async def make_plan(body: Strict[PlanRequest], context: InContext) -> Response:
    """Compile a scene sent as JSON into a frame plan."""
    quality = quality_of(body.quality)
    compiled = await context.addressed(body.scene, quality)
    return _plan(compiled, {"Cache-Control": answers.NO_STORE, "Seafoam-Plan": compiled.sha256})


def _plan(compiled: CompiledPlan, headers: dict[str, str]) -> Response:
    tagged = {"ETag": f'"{compiled.sha256}"', **headers}
    return Response(compiled.content, headers=tagged, media_type="application/json")
