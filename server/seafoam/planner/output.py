"""A whole frame: surface and sky, what stands before them, the mean of the samples, and the picture on the screen; and
what a picture's pixels show rather than its light: distance and normal, for compositing.
"""

from collections.abc import Sequence

from seafoam.effects.effect import ABOVE, BENEATH
from seafoam.effects.shader import COMMON, PLACE, Piece, SlotRef, constant_function
from seafoam.framegraph.plan import Pass, State
from seafoam.framegraph.resources import Target, TargetFormat, ViewportSize
from seafoam.planner.adaptive import Redrawn, additional_samples
from seafoam.planner.frame import Frame, Stage, from_under, fullscreen, underwater
from seafoam.planner.glsl import slot_pieces
from seafoam.planner.slots import GLARE, TONE
from seafoam.planner.surface import Scenery

_SAMPLES = "samples"
"""The target of all samples, in a square for each pixel."""
_WRITE = "output/frame.glsl@write"
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
    stages, linear = [before, scenery.stage(), Stage(after, targets={first: surface})], _SAMPLES
    if after:
        # Boats and drops have upright edges: they are drawn at full width.
        coarse = ViewportSize(scale=frame.side, part=frame.coarse)
        veil = Target(size=coarse, format="RGBA16F", filter="linear" if frame.coarse > 1 else "nearest")
        stages.append(Stage(targets={ABOVE: veil}))
    if after and not frame.narrow:
        drawn = fullscreen("what stands before the water", "compose", linear)
        files = ["output/frame.glsl@beneath", *frame.laid, _WRITE]
        stages.append(_alone(frame, drawn, files, ViewportSize(scale=frame.side)))
    if frame.narrow:
        # For who asks for light; the display reads the samples themselves.
        linear = "linear"
        stages.append(_alone(frame, fullscreen("finished frame", "finish", linear), [SlotRef("finished"), _WRITE]))
    if frame.side > 1:
        linear = "linear"
        drawn = fullscreen("mean of the samples", "resolve", linear)
        stages.append(_alone(frame, drawn, ["output/frame.glsl@resolve"], format="RGBA32F"))
    # Without light an additional sample costs less than its selection.
    if frame.quality.chosen_samples and frame.scene.light is not None:
        stages.append(additional_samples(frame, linear, "finished", scenery.redrawn(), _redrawn_overlays(frame)))
        linear = "finished"
    return Stage.joined(*stages, _display(frame)), linear


def _alone(
    frame: Frame,
    drawn: Pass,
    files: Sequence[Piece | SlotRef],
    size: ViewportSize | None = None,
    format: TargetFormat | None = None,
) -> Stage:
    """A pass with the target that it alone draws into, by default of the picture's size."""
    target = Target(size=size or ViewportSize(), format=format or frame.quality.target)
    return Stage([drawn], {drawn.program: frame.program(["lib/numbers.glsl", *files])}, {drawn.target: target})


def _redrawn_overlays(frame: Frame) -> tuple[Redrawn, ...]:
    found: list[Redrawn] = []
    for spec in frame.above:
        for drawn in frame.passes_of(spec):
            over = drawn.program == spec.program
            pieces = frame.pieces(spec.fragment if over else spec.under)
            found.append(Redrawn(drawn, tuple(pieces), over=over if spec.under else None))
    return tuple(found)


def _display(frame: Frame) -> Stage:
    """Passes that show the finished frame: those of effects, and tone mapping."""
    files = [*(piece for slot in (GLARE, TONE) for piece in slot_pieces(slot, frame.marched)), SlotRef("finished")]
    return Stage(
        passes=[*frame.effect_passes("finished"), fullscreen("tone", "present", "screen")],
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
