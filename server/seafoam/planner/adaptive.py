"""More samples where a pixel needs them: passes that choose pixels, draw their samples, and put the frame together.

docs/formulae.md, section 1, has the estimate and the limits. Chosen pixels are counted and listed in passes of their
own, so that their samples lie side by side in a target twice as wide and high as the picture, and nothing else is drawn
again.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from seafoam.effects.effect import Const, Piece
from seafoam.framegraph.passes import Fullscreen, Pass
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, TextureInput, ViewportSize
from seafoam.framegraph.rules import Uniform, Viewport, vector
from seafoam.framegraph.shader import Program
from seafoam.planner.glsl import assemble
from seafoam.quality import Quality

PLACE = "common/place.glsl"
"""The file that says which sample of the picture a fragment is."""
SPREAD = ("common/numbers.glsl", "common/camera.glsl", PLACE, "adaptive/spread_pass.glsl")
"""The fragment shader of points that were drawn over the whole picture, read as ``u_points``."""

RATIO = 3.5
"""Contrast from which on a pixel gets 16 samples, over that from which on it gets 4. Of a squared error 4 samples leave
a quarter and 16 a sixteenth: a sample gains as much in either step where the squared error is 12 times as large."""
GREATEST = 1.5
"""Contrast that hardly a pixel has: the greatest limit that is tried at first."""
ROUNDS = 3
"""Rounds of four limits each: the first reach :data:`GREATEST`, the next ones lie between two of them."""
PARTS = 32
"""Parts along each side of the picture in which samples are counted."""

_KIND = "adaptive/kind.glsl"
_BITS = "adaptive/bits.glsl"
_AT_CHOSEN = (_KIND, "adaptive/place.glsl")
_ROWS = (_KIND, "adaptive/rows_vertex.glsl")
_FULL = "vertex/fullscreen.glsl"
_SAMPLES, _BENEATH, _ABOVE = "chosen samples", "chosen beneath", "chosen above"
_LISTS = {"u_chosen_cells": "chosen cells", "u_chosen_groups": "chosen groups", "u_chosen_rows": "chosen rows"}


@dataclass(frozen=True)
class Seen:
    """A pass of the picture, as chosen pixels draw it again: ``model``, but with these pieces of a fragment shader.

    ``depth``: of what it draws, in clip space.
    """

    model: Pass
    pieces: tuple[Piece, ...]
    depth: float = 0.0


@dataclass
class Spent:
    """What more samples add to a plan."""

    consts: dict[str, Const]
    programs: dict[str, Program] = field(default_factory=dict)
    targets: dict[str, Target] = field(default_factory=dict)
    passes: list[Pass] = field(default_factory=list)
    uniforms: dict[str, Uniform] = field(default_factory=dict)

    def add(
        self,
        name: str,
        target: str,
        files: tuple[str, ...],
        reads: Mapping[str, str],
        *,
        rows: bool = False,
        uniforms: Mapping[str, Uniform] | None = None,
    ) -> None:
        """A pass over the whole target, or over the ``rows`` that chosen pixels fill; its files name its program."""
        program = ", ".join(files)
        if program not in self.programs:
            self.programs[program] = self.program(_ROWS if rows else (_FULL,), files)
        inputs: dict[str, TextureInput | TargetInput] = {key: TargetInput(target=one) for key, one in reads.items()}
        self.passes.append(
            Pass(
                name=name,
                when="frame",
                program=program,
                target=target,
                mesh=Fullscreen(),
                inputs=inputs,
                uniforms=dict(uniforms or {}),
            )
        )

    def program(self, vertex: tuple[str, ...], fragment: Iterable[Piece], depth: float = 0.0) -> Program:
        """A program with the constants of the choice."""
        return Program(
            vertex=assemble(vertex, {**self.consts, "FULLSCREEN_DEPTH": depth}),
            fragment=assemble(fragment, self.consts),
        )


def spend(
    quality: Quality,
    frame: str,
    linear: str,
    scene: tuple[Seen, ...],
    after: tuple[Seen, ...],
    consts: Mapping[str, Const],
) -> Spent:
    """Passes that read the target ``frame``, of a value a pixel, and draw the finished frame into ``linear``.

    ``scene``: surface and sky, in their order; ``after``: what is laid over them.
    """
    kinds = quality.chosen_samples
    spent = Spent(
        consts={
            **consts,
            "CHOOSE_FEW": 4 in kinds,
            "CHOOSE_MANY": 16 in kinds,
            "CHOOSE_RATIO": RATIO,
            "CHOOSE_LEAST": quality.samples_threshold,
            "CHOOSE_STEP": (GREATEST / quality.samples_threshold) ** (1.0 / 3.0),
            "CHOOSE_BUDGET": quality.samples_budget,
        },
        uniforms={
            "u_target": Uniform(type="vec2", rules=(Viewport(),)),
            "u_picture": Uniform(type="vec2", rules=(Viewport(of="picture"),)),
        },
    )
    _choose(spent, frame)
    drawn = _BENEATH if after else _SAMPLES
    finer = ViewportSize(scale=2)
    spent.targets[drawn] = Target(size=finer, format=quality.target, depth=True)
    if after:
        spent.targets[_ABOVE] = Target(size=finer, format="RGBA16F")
        spent.targets[_SAMPLES] = Target(size=finer, format=quality.target)
    for count in kinds:
        _draw(spent, count, ((scene, drawn), (after, _ABOVE)), first=count == kinds[0])
    spent.targets[linear] = Target(size=ViewportSize(), format="RGBA32F")
    files = (_BITS, "adaptive/resolve_pass.glsl")
    spent.add("means of the samples", linear, files, {"u_frame": frame, "u_samples": _SAMPLES, **_LISTS})
    return spent


def _choose(spent: Spent, frame: str) -> None:
    """Contrast, the limit that the budget allows, and which pixels are over it: bits, and counts of those before."""
    parts, one = FixedSize(width=PARTS, height=PARTS), FixedSize(width=1, height=1)
    cells, groups = ViewportSize(part=4), ViewportSize(part=4, narrow=16)
    rows = ViewportSize(part=4, narrow=1 << 14)
    spent.targets |= {
        "contrast": Target(size=ViewportSize(), format="RGBA16F"),
        "choice counts": Target(size=parts, format="RGBA32F"),
        **{f"choice limits {k}": Target(size=one, format="RGBA32F") for k in range(ROUNDS)},
        "choice": Target(size=cells, format="RGBA32F"),
        "chosen cells": Target(size=cells, format="RGBA32F"),
        "chosen groups": Target(size=groups, format="RGBA32F"),
        "chosen rows": Target(size=rows, format="RGBA32F"),
    }
    contrast, counts = {"u_contrast": "contrast"}, {"u_counts": "choice counts"}
    spent.add("contrast", "contrast", ("adaptive/contrast_pass.glsl",), {"u_frame": frame})
    for k in range(ROUNDS):
        tried = f"adaptive/{'next' if k else 'first'}_limits.glsl"
        limits = {"u_limits": f"choice limits {k - 1}"} if k else {}
        spent.add(f"samples at limits {k}", "choice counts", (tried, "adaptive/count_pass.glsl"), contrast | limits)
        spent.add(f"limits {k}", f"choice limits {k}", (tried, "adaptive/limit_pass.glsl"), counts | limits)
    files = ("adaptive/choice.glsl", "adaptive/cells_pass.glsl")
    spent.add("choice of pixels", "choice", files, contrast | {"u_limit": f"choice limits {ROUNDS - 1}"})
    spent.add("chosen by cell", "chosen cells", (_BITS, "adaptive/within_pass.glsl"), {"u_choice": "choice"})
    files = (_BITS, "adaptive/groups_pass.glsl")
    spent.add("chosen by group", "chosen groups", files, {"u_chosen_cells": "chosen cells"})
    spent.add("chosen by row", "chosen rows", ("adaptive/rows_pass.glsl",), {"u_chosen_groups": "chosen groups"})


def _draw(spent: Spent, count: int, layers: tuple[tuple[tuple[Seen, ...], str], ...], *, first: bool) -> None:
    """The list of the pixels that are given ``count`` samples, and these samples. ``first``: into cleared targets."""
    side = 2 if count == 4 else 4
    pixels = f"pixels of {count}"
    spent.targets[pixels] = Target(size=ViewportSize(part=side // 2), format="RGBA32F")
    listed = {"u_chosen": vector((float(side), 1.0, 1.0))}
    files = (_KIND, _BITS, "adaptive/pixels_pass.glsl")
    spent.add(f"list of {pixels} samples", pixels, files, _LISTS, rows=True, uniforms=listed)

    # Blocks of 4 samples lie in rows from below, those of 16 in rows from above.
    uniforms = {
        "u_chosen": vector((float(side), float(side), 1.0 if side == 2 else -1.0)),
        "u_viewport": Uniform(type="vec2", rules=(Viewport(of="picture", times=side),)),
    }
    lists = {"u_chosen_rows": TargetInput(target="chosen rows"), "u_chosen_pixels": TargetInput(target=pixels)}
    for group, target in layers:
        for seen in group:
            program = f"{seen.model.program}, chosen"
            if program not in spent.programs:
                pieces = (_AT_CHOSEN if one == PLACE else (one,) for one in seen.pieces)
                fragment = [one for some in pieces for one in some]
                vertex = _ROWS
                spent.programs[program] = spent.program(vertex, fragment, seen.depth)
            clear = first and seen.model.name == group[0].model.name
            changes = {
                "name": f"{seen.model.name}, {count} samples",
                "program": program,
                "target": target,
                "mesh": Fullscreen(),
                "inputs": {**seen.model.inputs, **lists},
                "uniforms": {**seen.model.uniforms, **uniforms},
                "state": seen.model.state.model_copy(update={"clear": clear}),
            }
            spent.passes.append(seen.model.model_copy(update=changes))
    if layers[1][0]:
        compose = ("common/numbers.glsl", "output/compose.glsl")
        reads = {"u_beneath": _BENEATH, "u_above": _ABOVE, "u_chosen_rows": "chosen rows"}
        name = f"what stands before the water, {count} samples"
        spent.add(name, _SAMPLES, compose, reads, rows=True, uniforms=uniforms)
