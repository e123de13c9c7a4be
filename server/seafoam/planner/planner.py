"""The planner: compiles a scene and a quality into a frame plan."""

from functools import lru_cache

from seafoam.effects import EFFECTS, outside
from seafoam.effects.registry import CHANGED
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.visibility import everywhere
from seafoam.planner.collect import Collection
from seafoam.planner.frame import FrameBuilder
from seafoam.planner.link import (
    camera_uniforms,
    declared_in,
    live_fields,
    refuse_integers,
    refuse_too_many_samplers,
    texture_entry,
    with_inputs,
)
from seafoam.planner.schedule import with_setup
from seafoam.quality import Quality
from seafoam.scene.models import Scene


@lru_cache(maxsize=128)
def make_plan(scene: Scene, quality: Quality, *, economy: bool = True) -> FramePlan:
    """Return the frame plan of a scene at a quality.

    ``economy``: leave out effects that change no pixel by more than :data:`seafoam.planner.collect.NEGLIGIBLE`, and
    declare where passes can be visible; otherwise everything that the scene names is drawn from everywhere, so that
    tests can compare both. Pure: the same arguments give the same bytes. Raises
    :class:`seafoam.effects.effect.PlanError` if the scene names something that does not exist, such as an unknown mask,
    or more effects together than one shader can read the textures of.
    """
    return linked_plan(scene, quality, FrameBuilder, economy=economy)


CHANGED.append(make_plan.cache_clear)


def linked_plan(scene: Scene, quality: Quality, builder: type[FrameBuilder], *, economy: bool) -> FramePlan:
    """Return the plan of the passes that a builder makes of a scene's contributions."""
    scene = _steepest_waves(scene, quality.waves)
    collection = Collection((*EFFECTS, *outside()), scene, quality, economy=economy)
    frame = builder(collection, collection.scene, quality)
    passes = frame.passes()
    for program in frame.programs.values():
        refuse_too_many_samplers(program, collection.readers)
    for drawn in passes:
        refuse_integers(drawn, frame.targets)
    camera = camera_uniforms(
        collection.max_height, collection.min_height, collection.max_slope, collection.map_error, collection.bounds
    )
    uniforms = {**collection.uniforms, **camera, **frame.uniforms}
    textures = {name: texture_entry(use) for name, use in collection.textures.items()}
    linked = [with_inputs(drawn, frame.programs, uniforms) for drawn in passes]
    timed, kept = with_setup(linked, frame.programs, uniforms, frame.targets, textures)
    used = declared_in(uniforms, frame.programs)
    plan = FramePlan(
        effects=tuple(collection.effects),
        skipped=tuple(collection.skipped),
        programs=frame.programs,
        textures=textures,
        targets=frame.targets,
        passes=timed,
        kept=kept,
        uniforms=used,
        linear=frame.linear,
        samples=quality.samples,
        top=collection.max_height,
        trough=collection.min_height,
        bottom=collection.min_ground,
        live=tuple(sorted(live_fields(used) - collection.bound_fields)),
    )
    return plan if economy else everywhere(plan)


def _steepest_waves(scene: Scene, count: int) -> Scene:
    """Return the scene with its ``count`` steepest waves, in their own order."""
    if len(scene.waves) <= count:
        return scene
    order = sorted(range(len(scene.waves)), key=lambda i: -scene.waves[i].amplitude / scene.waves[i].wavelength)
    return scene.model_copy(update={"waves": tuple(scene.waves[i] for i in sorted(order[:count]))})
