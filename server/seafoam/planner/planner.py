"""The planner: compiles a scene and a quality into a frame plan."""

from collections.abc import Callable
from functools import lru_cache

from seafoam.effects import EFFECTS, outside
from seafoam.effects.effect import PlanError
from seafoam.effects.light.atmosphere import direct
from seafoam.effects.registry import CHANGED
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import sampler_of, source_of
from seafoam.planner import link
from seafoam.planner.collect import collect
from seafoam.planner.frame import Frame, Stage, is_calm
from seafoam.planner.output import geometry, picture
from seafoam.planner.schedule import with_setup
from seafoam.quality import Quality
from seafoam.scene import Scene

STEEP = -0.5
"""Pitch of a camera below which it looks down on water, rad: a square is seen half as high as wide."""
MIRRORED = 0.1
"""Greatest tolerance of the search for water that mirrors land: 0.2 errs 12 % more (lake-sunset), and saves 1 %."""


@lru_cache(maxsize=128)
def make_plan(scene: Scene, quality: Quality) -> FramePlan:
    """Return the frame plan of a scene at a quality.

    Effects that change no pixel by more than :data:`seafoam.planner.collect.NEGLIGIBLE` are left out. Pure: the same
    arguments give the same bytes. Raises :class:`seafoam.effects.effect.PlanError` if the scene names something that
    does not exist, such as an unknown mask, or more effects together than one shader can read the textures of.
    """
    return linked_plan(scene, quality, picture)


@lru_cache(maxsize=32)
def make_geometry_plan(scene: Scene, quality: Quality) -> FramePlan:
    """Return the plan whose linear frame holds, at each pixel's centre, normal (R, G, B) and distance, m (A).

    Of the water, with its waves and ripples as far as the pixel resolves them, or of land or floor where these are
    nearer; 0 where there is neither. Boats, spray and foam are not in it. Raises as
    :func:`make_plan` does.
    """
    once = quality.model_copy(update={"samples": 1, "samples_max": 1, "pixel_width": 1})
    return linked_plan(scene, once, geometry)


CHANGED += (make_plan.cache_clear, make_geometry_plan.cache_clear)


def linked_plan(scene: Scene, quality: Quality, passes_of: Callable[[Frame], tuple[Stage, str]]) -> FramePlan:
    """Return the plan of a scene's contributions. ``passes_of``: its passes, and the target of its linear frame."""
    asked = quality
    scene = _steepest_waves(scene.settled, quality.waves)
    quality = _suited(scene, quality)
    given = collect((*EFFECTS, *outside()), scene, quality)
    stage, linear = passes_of(Frame(given, quality))
    try:
        for program in stage.programs.values():
            link.refuse_too_many_samplers(program)
    except PlanError:
        if asked.clouds_mirrored == "exact":
            raise
        # Of what is kept in textures this alone is as good without.
        exact = asked.model_copy(update={"clouds_mirrored": "exact"})
        return linked_plan(scene, exact, passes_of)
    uniforms = {**given.uniforms, **link.camera_uniforms(given), **stage.uniforms}
    textures = {name: link.texture_entry(use) for name, use in given.textures.items()}
    read = {sampler_of(name): name for name in (*textures, *stage.targets)} | given.inputs
    read["u_linear"] = linear
    known = {sampler: source_of(name, textures) for sampler, name in read.items()}
    linked = [link.with_inputs(drawn, stage.programs, uniforms, known) for drawn in stage.passes]
    timed, kept = with_setup(linked, stage.programs, uniforms, stage.targets, textures)
    used = link.declared_in(uniforms, stage.programs)
    return FramePlan(
        effects=given.effects,
        skipped=given.skipped,
        programs=dict(stage.programs),
        textures=textures,
        targets=dict(stage.targets),
        passes=timed,
        kept=kept,
        uniforms=used,
        linear=linear,
        samples=quality.samples,
        top=given.max_height,
        trough=given.min_height,
        bottom=given.min_ground,
        live=tuple(sorted(link.live_fields(used) - given.bound_fields)),
    )


def _steepest_waves(scene: Scene, count: int) -> Scene:
    """Return the scene with its ``count`` steepest waves, in their own order."""
    if len(scene.waves) <= count:
        return scene
    order = sorted(range(len(scene.waves)), key=lambda i: -scene.waves[i].amplitude / scene.waves[i].wavelength)
    return scene.model_copy(update={"waves": tuple(scene.waves[i] for i in sorted(order[:count]))})


def _suited(scene: Scene, quality: Quality) -> Quality:
    """Return the quality with the width of drawn pixels, the search's tolerance and the samples that suit the scene.

    The width is 1 where more samples per pixel are asked for, and without light, where a sample costs less than what
    enlarges it; half of that asked for, rounded up, where the camera looks down and sees rows as fine as columns, with
    foam that drifts in lines of every direction and on calm water; at most 3 where boats, land in the water's mirror or
    surf on rocks are beside what is wide; at least 3 where neither sun nor moon shines, so that nothing glitters. A
    mirror of land shows where its water was found, to less than a fifth of a sample. Without light there are edges
    alone, and a sample costs a hundredth: 25, those of ``reference``, are 49.
    """
    asked: int = quality.pixel_width
    light, width, surface = scene.light, asked, quality.surface
    mirrored = scene.shore is not None and light is not None and light.reflection != "sky"
    if quality.samples > 1 or quality.chosen_samples or light is None:
        width = 1
    elif scene.camera.pitch < STEEP or scene.drift or is_calm(scene):
        width = -(-asked // 2)
    elif scene.boats or mirrored or (scene.spray and scene.shore):
        width = min(asked, 3)
    elif asked > 1 and not direct(light).any():
        width = max(asked, 3)
    if mirrored and surface.tolerance > MIRRORED:
        surface = surface.model_copy(update={"tolerance": MIRRORED})
    samples = 49 if light is None and quality.samples == 25 else quality.samples
    return quality.model_copy(update={"pixel_width": width, "surface": surface, "samples": samples})
