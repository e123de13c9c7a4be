"""Adaptive sampling: passes that select pixels, draw their additional samples, and assemble the frame.

docs/formulae.md, section 1, has the error estimate and the limits. Passes count and list the selected pixels, so that
their samples are adjacent in a target twice as wide and high as the picture, and no other pixels are drawn again.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import chain

from seafoam.effects.shader import PLACE, Piece
from seafoam.framegraph.plan import Fullscreen, Pass, Program
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, ViewportSize
from seafoam.framegraph.rules import Uniform, Viewport, vector
from seafoam.planner.frame import Frame, Stage, fullscreen
from seafoam.planner.glsl import FULLSCREEN

RATIO = 3.5
"""Ratio of the contrast thresholds for 16 and for 4 samples. 4 samples leave a quarter of the squared error and 16 a
sixteenth: a sample reduces the error equally in both steps if the squared error is 12 times as large in the second."""
MAX_CONTRAST = 1.5
"""Contrast that hardly any pixel exceeds: the greatest threshold tried in the first round."""
ROUNDS = 3
"""Rounds of four thresholds each: those of the first reach :data:`MAX_CONTRAST`, those of the
next are between two of the last round."""
PARTS = 32
"""Number of parts along each side of the picture in which samples are counted."""
_KIND = "adaptive/choice.glsl@kind"
_BITS = "adaptive/choice.glsl@bits"
_AT_CHOSEN = (_KIND, "adaptive/choice.glsl@place")
_ROWS = (_KIND, "adaptive/list.glsl@rows_vertex")
_SAMPLES, _BENEATH, _ABOVE = "chosen samples", "chosen beneath", "chosen above"


@dataclass(frozen=True)
class Redrawn:
    """A pass that is drawn again for selected pixels: ``original``, with these pieces of a fragment shader.

    ``depth``: its depth in clip space; ``over``: the side of the water from which alone it is drawn, or either.
    """

    original: Pass
    pieces: tuple[Piece, ...]
    depth: float = 0.0
    over: bool | None = None


@dataclass
class _Additions:
    """What adaptive sampling adds to a plan, so far; ``frame`` has its constants."""

    frame: Frame
    programs: dict[str, Program] = field(default_factory=dict)
    targets: dict[str, Target] = field(default_factory=dict)
    passes: list[Pass] = field(default_factory=list)

    def add(
        self,
        name: str,
        target: str,
        files: tuple[str, ...],
        reads: Mapping[str, str] | None = None,
        *,
        size: FixedSize | ViewportSize | None = None,
        rows: bool = False,
        uniforms: Mapping[str, Uniform] | None = None,
    ) -> None:
        """Add a pass over the whole target, or the ``rows`` of selected pixels; its files name its program.

        ``size``: of a target that is new.
        """
        if size is not None:
            self.targets[target] = Target(size=size, format="RGBA32F")
        program = ", ".join(files)
        if program not in self.programs:
            self.programs[program] = self.frame.program(files, _ROWS if rows else FULLSCREEN)
        drawn = fullscreen(name, program, target, reads)
        self.passes.append(drawn.model_copy(update={"uniforms": dict(uniforms or {})}))

    def redrawn(self, again: Redrawn) -> str:
        """Return the name of the program of a pass that is drawn again."""
        program = f"{again.original.program}, chosen"
        if program not in self.programs:
            fragment = chain.from_iterable(_AT_CHOSEN if piece == PLACE else (piece,) for piece in again.pieces)
            self.programs[program] = self.frame.program(tuple(fragment), _ROWS, over=again.over, depth=again.depth)
        return program


def additional_samples(
    frame: Frame, means: str, linear: str, scene: tuple[Redrawn, ...], after: tuple[Redrawn, ...]
) -> Stage:
    """Return passes that read ``means``, a target with one value per pixel, and draw the final frame into ``linear``.

    ``scene``: surface and sky, in drawing order; ``after``: the passes blended over them.
    """
    quality, counts = frame.quality, frame.quality.chosen_samples
    consts = {
        **frame.collection.chosen_consts,
        "CHOOSE_FEW": 4 in counts,
        "CHOOSE_MANY": 16 in counts,
        "CHOOSE_RATIO": RATIO,
        "CHOOSE_LEAST": quality.samples_threshold,
        "CHOOSE_STEP": (MAX_CONTRAST / quality.samples_threshold) ** (1.0 / 3.0),
        "CHOOSE_BUDGET": quality.samples_budget,
    }
    added = _Additions(frame.with_consts(consts))
    _choose(added, means)
    drawn = _BENEATH if after else _SAMPLES
    finer = ViewportSize(scale=2)
    added.targets[drawn] = Target(size=finer, format=quality.target, depth=True)
    if after:
        added.targets[_ABOVE] = Target(size=finer, format="RGBA16F")
        added.targets[_SAMPLES] = Target(size=finer, format=quality.target)
    for count in counts:
        _draw(added, count, ((scene, drawn), (after, _ABOVE)), first=count == counts[0])
    files, reads = (_BITS, "adaptive/list.glsl@resolve"), {"u_frame": means, "u_samples": _SAMPLES}
    added.add("means of the samples", linear, files, reads, size=ViewportSize())
    sizes = {
        "u_target": Uniform(type="vec2", rules=(Viewport(),)),
        "u_picture": Uniform(type="vec2", rules=(Viewport(of="picture"),)),
    }
    return Stage(added.passes, added.programs, added.targets, sizes)


def _choose(added: _Additions, means: str) -> None:
    """Passes of contrast, of the threshold that the budget allows, and of the selection: bits and running sums."""
    parts, single, cells = FixedSize.square(PARTS), FixedSize.square(1), ViewportSize(part=4)
    groups, rows = ViewportSize(part=4, narrow=16), ViewportSize(part=4, narrow=1 << 14)
    added.targets["contrast"] = Target(size=ViewportSize(), format="RGBA16F")
    added.add("contrast", "contrast", ("adaptive/count.glsl@contrast",), {"u_frame": means})
    for k in range(ROUNDS):
        thresholds = "adaptive/choice.glsl@next_limits" if k else "adaptive/choice.glsl@first_limits"
        limits = {"u_limits": f"choice limits {k - 1}"} if k else {}
        count, limit = (thresholds, "adaptive/count.glsl@count"), (thresholds, "adaptive/count.glsl@limit")
        added.add(f"samples at limits {k}", "choice counts", count, limits, size=parts)
        limits |= {"u_counts": "choice counts"}
        added.add(f"limits {k}", f"choice limits {k}", limit, limits, size=single)
    files = ("adaptive/choice.glsl@choice", "adaptive/list.glsl@cells")
    added.add("choice of pixels", "choice", files, {"u_limit": f"choice limits {ROUNDS - 1}"}, size=cells)
    added.add("chosen by cell", "chosen cells", (_BITS, "adaptive/list.glsl@within"), size=cells)
    added.add("chosen by group", "chosen groups", (_BITS, "adaptive/list.glsl@groups"), size=groups)
    added.add("chosen by row", "chosen rows", ("adaptive/list.glsl@rows",), size=rows)


def _draw(added: _Additions, count: int, layers: tuple[tuple[tuple[Redrawn, ...], str], ...], *, first: bool) -> None:
    """Passes that list the pixels with ``count`` samples and draw these. ``first``: into cleared targets."""
    side = 2 if count == 4 else 4
    pixels = f"pixels of {count}"
    listed, size = {"u_chosen": vector((float(side), 1.0, 1.0))}, ViewportSize(part=side // 2)
    files = (_KIND, _BITS, "adaptive/list.glsl@pixels")
    added.add(f"list of {pixels} samples", pixels, files, size=size, rows=True, uniforms=listed)

    # Blocks of 4 samples fill the target's rows from the bottom, blocks of 16 from the top.
    uniforms = {
        "u_chosen": vector((float(side), float(side), 1.0 if side == 2 else -1.0)),
        "u_viewport": Uniform(type="vec2", rules=(Viewport(of="picture", times=side),)),
    }
    lists = {"u_chosen_pixels": TargetInput(target=pixels)}
    for group, target in layers:
        for redrawn in group:
            clear = first and redrawn.original.state.clear
            changes = {
                "name": f"{redrawn.original.name}, {count} samples",
                "program": added.redrawn(redrawn),
                "target": target,
                "mesh": Fullscreen(),
                "inputs": {**redrawn.original.inputs, **lists},
                "uniforms": {**redrawn.original.uniforms, **uniforms},
                "state": redrawn.original.state.model_copy(update={"clear": clear}),
            }
            added.passes.append(redrawn.original.model_copy(update=changes))
    if layers[1][0]:
        under_over = ("output/frame.glsl@beneath", "output/frame.glsl@above", "output/frame.glsl@laid")
        compose = ("lib/numbers.glsl", *under_over, "output/frame.glsl@composed", "output/frame.glsl@write")
        reads = {"u_beneath": _BENEATH, "u_above": _ABOVE}
        name = f"what stands before the water, {count} samples"
        added.add(name, _SAMPLES, compose, reads, rows=True, uniforms=uniforms)
