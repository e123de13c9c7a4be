"""A whole frame: surface and sky, what stands before them, the mean of the samples, and the picture on the screen."""

from seafoam.effects.effect import ABOVE, BENEATH, FINISHED
from seafoam.effects.shader import Piece, Source
from seafoam.framegraph.resources import Target, TargetInput, ViewportSize, target_inputs
from seafoam.planner.adaptive import Redrawn, additional_samples
from seafoam.planner.frame import Frame, Stage, fullscreen
from seafoam.planner.glsl import slot_pieces
from seafoam.planner.slots import GLARE, TONE
from seafoam.planner.surface import Scenery

_SAMPLES = "samples"
"""The target of all samples, in a square for each pixel."""
_ENLARGED = "output/enlarge.glsl@enlarged"


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
        stages.append(_enlarged(frame))
        linear = "enlarged"
    if frame.side > 1:
        stages.append(_mean(frame))
        linear = "linear"
    # Without light an additional sample costs less than its selection.
    if frame.quality.chosen_samples and frame.scene.light is not None:
        stages.append(additional_samples(frame, linear, "finished", scenery.redrawn(), _redrawn_overlays(frame)))
        linear = "finished"
    return Stage.joined(*stages, _display(frame, linear)), linear


def _composed(frame: Frame, beneath: str, target: str) -> Stage:
    """The pass that lays what stands before the scenery over it, which it enlarges if that is narrow."""
    size, read = ViewportSize(scale=frame.side), "u_beneath"
    under: Piece = "output/frame.glsl@beneath"
    if frame.narrow:
        read, under = "u_narrow", Source(_ENLARGED, (("enlarged", "beneath"),))
    reads = target_inputs({read: beneath, "u_above": ABOVE})
    return Stage(
        passes=[fullscreen("what stands before the water", "compose", target, reads)],
        programs={"compose": frame.program(["lib/numbers.glsl", under, "output/frame.glsl@compose"])},
        targets={ABOVE: Target(size=size, format="RGBA16F"), target: Target(size=size, format=frame.quality.target)},
    )


def _mean(frame: Frame) -> Stage:
    """The pass that averages each pixel's samples."""
    return Stage(
        passes=[fullscreen("mean of the samples", "resolve", "linear", target_inputs({"u_samples": _SAMPLES}))],
        programs={"resolve": frame.program(["output/frame.glsl@resolve"])},
        targets={"linear": Target(size=ViewportSize(), format="RGBA32F")},
    )


def _enlarged(frame: Frame) -> Stage:
    """The pass that enlarges a scenery that is drawn at a part of its width."""
    files = ["lib/numbers.glsl", _ENLARGED, "output/enlarge.glsl@picture"]
    return Stage(
        passes=[fullscreen("enlarged", "enlarge", "enlarged", target_inputs({"u_narrow": _SAMPLES}))],
        programs={"enlarge": frame.program(files)},
        targets={"enlarged": Target(size=ViewportSize(), format=frame.quality.target)},
    )


def _redrawn_overlays(frame: Frame) -> tuple[Redrawn, ...]:
    """The overlays as they are drawn again for selected pixels."""
    found: list[Redrawn] = []
    for spec in frame.above:
        for drawn in frame.passes_of(spec):
            over = drawn.program == spec.program
            pieces = frame.pieces(spec.fragment if over else spec.under)
            found.append(Redrawn(drawn, tuple(pieces), sided=frame.sided(over if spec.under else None)))
    return tuple(found)


def _display(frame: Frame, linear: str) -> Stage:
    """Passes that show the finished frame: those of effects, and tone mapping."""
    finished = []
    for drawn in frame.effect_passes("finished"):
        ends = {name for name, source in drawn.inputs.items() if source == TargetInput(target=FINISHED)}
        inputs = {**drawn.inputs, **target_inputs(dict.fromkeys(ends, linear))}
        finished.append(drawn.model_copy(update={"inputs": inputs}))
    inputs = {**frame.collection.inputs, **target_inputs({"u_linear": linear})}
    files = [piece for slot in (GLARE, TONE) for piece in slot_pieces(slot, frame.marched)]
    return Stage(
        passes=[*finished, fullscreen("tone", "present", "screen", inputs)],
        programs={"present": frame.program([*files, "output/frame.glsl@present"])},
    )
