"""``/api/presets``: the named scenes. ``/api/quality``: quality tiers and settings."""

from functools import cache
from typing import Annotated, Any

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, Field

from seafoam.accuracy.knobs import every_knob
from seafoam.accuracy.model import KnobInfo
from seafoam.api.context import InContext
from seafoam.api.errors import NotFoundError, problem_responses
from seafoam.api.parameters import Parameters
from seafoam.api.planning import compile_scene
from seafoam.api.threads import ThreadPool
from seafoam.quality import TIERS, Quality, Tier
from seafoam.scene.models import Scene
from seafoam.scene.presets import Group, Preset, load_preset, preset_names

router = APIRouter(prefix="/api", tags=["presets"])

PresetName = Annotated[
    str, Path(description="Name of a preset; /api/presets lists them", examples=["default"], max_length=80)
]


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
    knobs: dict[str, Any] = Field(description="JSON schema of the quality settings, with ranges and defaults")
    measured: list[KnobInfo] = Field(description="Title, owner and measured values of each setting")


def find_preset(name: str) -> Preset:
    """Return a preset by name. Raises :class:`NotFoundError` with the available names."""
    try:
        return load_preset(name)
    except KeyError:
        raise NotFoundError(f"preset {name!r} was not found", "preset", preset_names()) from None


@cache
def _summary(name: str) -> PresetSummary:
    """Return a preset's list entry, cached, because its effects require a plan. Raises ``KeyError``."""
    preset = load_preset(name)
    compiled = compile_scene(preset.scene, TIERS["standard"], scene_at="")
    effects = [effect.name for effect in compiled.plan.effects]
    return PresetSummary(**preset.model_dump(include=set(PresetSummary.model_fields)), effects=effects)


async def warm(plans: ThreadPool) -> None:
    """Plan every preset once, so that the first list request is fast; one at a time, so as not to delay others."""
    for name in preset_names():
        await plans.run(_summary, name)


@router.get("/presets", responses=problem_responses(422, 503))
async def list_presets(_: Annotated[Parameters, Query()], context: InContext) -> list[PresetSummary]:
    """List all presets, in menu order."""
    return await context.plans.run(lambda: [_summary(name) for name in preset_names()])


@router.get("/presets/{preset}", responses=problem_responses(404, 422, 503))
async def get_preset(preset: PresetName, _: Annotated[Parameters, Query()], context: InContext) -> PresetDetail:
    """Get a preset with its scene, which can be changed and posted to /api/frames and /api/plans."""
    loaded = find_preset(preset)
    summary = await context.plans.run(_summary, preset)
    return PresetDetail(**summary.model_dump(), scene=loaded.scene)


@router.get("/quality", responses=problem_responses(422))
async def get_quality(_: Annotated[Parameters, Query()]) -> QualityTiers:
    """Get the quality tiers with the value of every setting, and the allowed values of each setting."""
    measured = [
        KnobInfo(owner=owner, pointer=knob.pointer, title=knob.title, cause=knob.cause, steps=knob.steps)
        for owner, knob in every_knob()
    ]
    return QualityTiers(tiers=TIERS, knobs=Quality.model_json_schema(), measured=measured)
