"""Compiles and caches frame plans, as canonical bytes with their hash."""

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache

from seafoam.api.http.problems import BadRequestError, FieldProblem
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import PlanError, make_plan
from seafoam.quality import Quality
from seafoam.scene.models import Scene


@dataclass(frozen=True, slots=True)
class CompiledPlan:
    """A plan, its canonical JSON and the SHA-256 of that JSON."""

    plan: FramePlan
    content: bytes
    sha256: str


@lru_cache(maxsize=64)
def _compiled(scene: Scene, quality: Quality) -> CompiledPlan:
    plan = make_plan(scene, quality)
    return CompiledPlan(plan, plan.canonical_json(), plan.sha256)


def compile_scene(
    scene: Scene, quality: Quality, *, scene_at: str | None, parameters: Collection[str] = ()
) -> CompiledPlan:
    """Compile a scene into a plan.

    A scene that cannot be planned raises :class:`BadRequestError`, which names the member of the body (``scene_at``:
    JSON pointer of the scene in it) or the query parameter (among ``parameters``) that set the value.
    """
    try:
        return _compiled(scene, quality)
    except PlanError as error:
        member = error.pointer.rpartition("/")[2]
        parameter = member if scene_at is None and member in parameters else None
        pointer = None if parameter else f"{scene_at or ''}{error.pointer}"
        raise BadRequestError(
            FieldProblem(
                pointer=pointer, parameter=parameter, detail=f"{parameter or pointer or 'scene'}: {error.message}"
            )
        ) from error
