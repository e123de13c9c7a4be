"""A whole frame: surface and sky, what stands before them, the mean of the samples, and the picture on the screen; and
what a picture's pixels show rather than its light: distance and normal, for compositing.
"""

from collections.abc import Sequence

from seafoam.effects.effect import ABOVE, BENEATH, FINISHED
from seafoam.effects.shader import COMMON, PLACE, Piece, SlotRef, Source, constant_function
from seafoam.framegraph.plan import Pass, State
from seafoam.framegraph.resources import Target, TargetInput, ViewportSize
from seafoam.planner.adaptive import Redrawn, additional_samples
from seafoam.planner.frame import Frame, Stage, from_under, fullscreen, underwater
from seafoam.planner.glsl import slot_pieces
from seafoam.planner.slots import GLARE, TONE
from seafoam.planner.surface import Scenery

_SAMPLES = "samples"
"""The target of all samples, in a square for each pixel."""
_ENLARGED = "output/enlarge.glsl@enlarged"
_GEOMETRY = "geometry"
"""Target, program and pass."""
_LEVEL_FLOOR = constant_function("vec3", "floor_normal", "vec2 p", "vec3(0.0, 1.0, 0.0)")
_SURFACE: tuple[Piece | SlotRef, ...] = (*COMMON, PLACE, SlotRef("waves"), SlotRef("detail"))


def picture(frame: Frame) -> tuple[Stage, str]:
    """Return everything that draws a picture, and the target that holds its finished linear frame."""
    after = frame.effect_passes("after")
    first = BENEATH if after and not frame.narrow else _SAMPLES
    scenery = Scenery(frame, first)
    surface = Target(size=frame.sampled, format=frame.quality.target, depth=True)
    before = Stage(frame.effect_passes("before"), frame.effect_programs(), frame.collection.targets)
    stages, linear = [before, scenery.stage(), Stage(targets={first: surface})], first
    if after:
        # Boats and drops have upright edges: they are drawn at full width.
        linear = "composed" if frame.narrow else _SAMPLES
        stages += [Stage(after), _composed(frame, first, linear)]
    elif frame.narrow:
        files = ["lib/numbers.glsl", _ENLARGED, "output/enlarge.glsl@picture"]
        drawn = fullscreen("enlarged", "enlarge", "enlarged", {"u_narrow": _SAMPLES})
        stages.append(_alone(frame, drawn, files, Target(size=ViewportSize(), format=frame.quality.target)))
        linear = "enlarged"
    if frame.side > 1:
        drawn = fullscreen("mean of the samples", "resolve", "linear")
        target = Target(size=ViewportSize(), format="RGBA32F")
        stages.append(_alone(frame, drawn, ["output/frame.glsl@resolve"], target))
        linear = "linear"
    # Without light an additional sample costs less than its selection.
    if frame.quality.chosen_samples and frame.scene.light is not None:
        stages.append(additional_samples(frame, linear, "finished", scenery.redrawn(), _redrawn_overlays(frame)))
        linear = "finished"
    return Stage.joined(*stages, _display(frame, linear)), linear


def _composed(frame: Frame, beneath: str, target: str) -> Stage:
    """The pass that lays what stands before the scenery over it, which it enlarges if that is narrow."""
    read, under = "u_beneath", Source("output/frame.glsl@beneath")
    if frame.narrow:
        read, under = "u_narrow", Source(_ENLARGED, (("enlarged", "beneath"),))
    size, part = ViewportSize(scale=frame.side), min(spec.part for spec in frame.above)
    over = "output/frame.glsl@above_coarse" if part > 1 else "output/frame.glsl@above"
    files: list[Piece] = ["lib/numbers.glsl", under, over, "output/frame.glsl@compose"]
    drawn = fullscreen("what stands before the water", "compose", target, {read: beneath})
    coarse = size.model_copy(update={"part": part})
    veil = Target(size=coarse, format="RGBA16F", filter="linear" if part > 1 else "nearest")
    above = Stage(targets={ABOVE: veil})
    return above.joined(_alone(frame, drawn, files, Target(size=size, format=frame.quality.target)))


def _alone(frame: Frame, drawn: Pass, files: Sequence[Piece], target: Target) -> Stage:
    """A pass with the target that it alone draws into."""
    return Stage([drawn], {drawn.program: frame.program(files)}, {drawn.target: target})


def _redrawn_overlays(frame: Frame) -> tuple[Redrawn, ...]:
    found: list[Redrawn] = []
    for spec in frame.above:
        for drawn in frame.passes_of(spec):
            over = drawn.program == spec.program
            pieces = frame.pieces(spec.fragment if over else spec.under)
            found.append(Redrawn(drawn, tuple(pieces), over=over if spec.under else None))
    return tuple(found)


def _display(frame: Frame, linear: str) -> Stage:
    """Passes that show the finished frame: those of effects, and tone mapping."""
    finished = []
    for drawn in frame.effect_passes("finished"):
        ends = {name for name, source in drawn.inputs.items() if source == TargetInput(target=FINISHED)}
        inputs = {**drawn.inputs, **dict.fromkeys(ends, TargetInput(target=linear))}
        finished.append(drawn.model_copy(update={"inputs": inputs}))
    files = [piece for slot in (GLARE, TONE) for piece in slot_pieces(slot, frame.marched)]
    return Stage(
        passes=[*finished, fullscreen("tone", "present", "screen", {"u_linear": linear})],
        programs={"present": frame.program([*files, "output/frame.glsl@present"])},
    )


def geometry(frame: Frame) -> tuple[Stage, str]:
    """The scene's passes, up to what the rays of pixels' centres meet, and the target of that."""
    over = (*_SURFACE, SlotRef("find"), SlotRef("land"), SlotRef("first"), "output/frame.glsl@geometry")
    programs = {**frame.effect_programs(), _GEOMETRY: frame.program(over, over=True)}
    drawn = frame.found_over(_GEOMETRY, _GEOMETRY, _GEOMETRY, State())
    passes = [*frame.effect_passes("before"), drawn]
    if frame.below:
        floor: Piece = "shore/floor.glsl@floor_normal" if frame.shore else _LEVEL_FLOOR
        under = (*_SURFACE, SlotRef("marched"), SlotRef("now"), SlotRef("underside"), SlotRef("reach"), floor)
        low = underwater(_GEOMETRY)
        programs[low] = frame.program((*under, "output/frame.glsl@geometry_below"), over=False)
        passes += from_under(drawn.model_copy(update={"program": low}), frame.level)
    target = Target(size=ViewportSize(), format="RGBA32F")
    return Stage(passes, programs, {**frame.collection.targets, _GEOMETRY: target}), _GEOMETRY
