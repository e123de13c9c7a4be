"""Plans of what a picture's pixels show rather than of its light: distance and normal, for compositing."""

from functools import lru_cache

from seafoam.effects.registry import CHANGED
from seafoam.effects.shader import COMMON, PLACE, Piece, SlotRef, constant_function
from seafoam.framegraph.passes import State
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import Target, ViewportSize
from seafoam.planner.frame import Frame, Stage, from_under, underwater
from seafoam.planner.planner import linked_plan
from seafoam.quality import Quality
from seafoam.scene.models import Scene

GEOMETRY = "geometry"
"""Target, program and pass."""
_LEVEL_FLOOR = constant_function("vec3", "floor_normal", "vec2 p", "vec3(0.0, 1.0, 0.0)")
_SURFACE: tuple[Piece | SlotRef, ...] = (*COMMON, PLACE, SlotRef("waves"), SlotRef("detail"))


def _geometry(frame: Frame) -> tuple[Stage, str]:
    """The scene's passes, up to what the rays of pixels' centres meet, and the target of that."""
    over = (*_SURFACE, SlotRef("find"), SlotRef("land"), SlotRef("first"), "output/frame.glsl@geometry")
    programs = {**frame.effect_programs(), GEOMETRY: frame.program(over, over=True)}
    drawn = frame.found_over(GEOMETRY, GEOMETRY, GEOMETRY, State(), frame.collection.inputs)
    passes = [*frame.effect_passes("before"), drawn]
    if frame.below:
        floor: Piece = "shore/floor.glsl@floor_normal" if frame.shore else _LEVEL_FLOOR
        under = (*_SURFACE, SlotRef("marched"), SlotRef("now"), SlotRef("underside"), SlotRef("reach"), floor)
        low = underwater(GEOMETRY)
        programs[low] = frame.program((*under, "output/frame.glsl@geometry_below"), over=False)
        passes += from_under(drawn.model_copy(update={"program": low}), frame.level)
    target = Target(size=ViewportSize(), format="RGBA32F")
    return Stage(passes, programs, {**frame.collection.targets, GEOMETRY: target}), GEOMETRY


@lru_cache(maxsize=32)
def make_geometry_plan(scene: Scene, quality: Quality) -> FramePlan:
    """Return the plan whose linear frame holds, at each pixel's centre, normal (R, G, B) and distance, m (A).

    Of the water, with its waves and ripples as far as the pixel resolves them, or of land or floor where these are
    nearer; 0 where there is neither. Boats, spray and foam are not in it. Raises as
    :func:`seafoam.planner.make_plan` does.
    """
    once = quality.model_copy(update={"samples": 1, "samples_max": 1, "pixel_width": 1})
    return linked_plan(scene, once, _geometry, economy=True)


CHANGED.append(make_geometry_plan.cache_clear)
