"""What the passes of a scene's frame share, and the passes that its effects add."""

import math
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace

from seafoam.effects.effect import ABOVE, PassSpec, Resources, drawn_map
from seafoam.effects.shader import (
    COMMON,
    MARCH_AHEAD,
    Const,
    Piece,
    SlotFile,
    SlotRef,
    Source,
    constant_function,
    refine,
)
from seafoam.framegraph.plan import Eyes, Fullscreen, Pass, Program, State
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, ViewportSize, source_of
from seafoam.framegraph.rules import Uniform
from seafoam.planner.collect import Collection
from seafoam.planner.glsl import FULLSCREEN, assemble, slot_pieces
from seafoam.planner.slots import APPROACH, GENTLER, slots_named
from seafoam.quality import Quality
from seafoam.scene import Scene

START_SHARE = 0.25
"""Step length below which the search for a start distance ends, in heights of a tile at that distance."""
STEP_WIDEST = 1.6
"""Tolerance of steps that a march reaches, where it begins from 0.1 or more: rays that brush crests take as many steps
as all others. ``standard`` takes 0.90 (boat-race) to 1 of the time, and errs as much; twice as much for hits was 1 to
3 % of the error for 1 to 4 % of the time. A step widens it by a quarter of the first, of ``fast`` by a tenth: by a
quarter it takes 1 to 5 % less, but ``default`` flickers 2.1 times as much as the mean of 64 samples."""
ROW_SHIFT, ROW_SHIFT_OF_FAST = 0.125, 0.25
"""Shift of the rows of wide pixels, to the left and to the right in turn, in their width: as a rule, and of those of a
quarter of the width. At a quarter two rows together have a sample for every half of a pixel; at an eighth a line that
runs down the rows is less of a zigzag, for 1 to 4 % less error."""
FOOTPRINT_X, FOOTPRINT_X_OF_CAUSTICS = 0.6, 0.7
"""Width of the footprint of a wide pixel's sample, in that of the pixel: as a rule, and over a floor's caustics."""
ROWS_SHARE, ROWS_SHARE_OF_CAUSTICS, ROWS_SHARE_OF_DOTS = 0.15, 0.2, 0.5
"""Share of the rows above and below in what is shown in the middle between two drawn pixels, at most: as a rule, over a
floor's caustics, and between two samples of which one is foam, black or white. None on calm water, whose glints are
rows of their own, and at a quarter of the width, where it buys 2 % of the error for 8 % of the time, but with a shore,
where it buys as much for 4 %."""
CALM = 0.01
"""Standard deviation of the ripples' slope below which the mirrored sun is a narrow column, upright in the picture."""
START_TILE, WIDE_TILE = 4, 24
"""Sides of the tiles of pixels whose rays share a start distance, and of those from whose start distances these are
searched where a search costs much: with 16 in place of 24 both passes of storm take a fifth longer, with 32 a tenth."""
OVER: Eyes = ("over", "between")
"""Camera heights over the water. Between the highest crest and the deepest trough the camera can be on either side:
there the passes for both are drawn, and vertex shaders of the wrong side place their triangles outside the picture."""
PLANE, MARCHED = "surface/march.glsl@plane", "surface/march.glsl@march"
"""Files that intersect rays with the surface: with level water, and by ray marching."""
MARCH = SlotFile(
    "marched", "surface/march.glsl@begin", needs=("surface/march.glsl@step", refine("refine_water", "waves", "vec3"))
)
_STARTS = ("surface/march.glsl@step", "surface/bounds.glsl@pyramid")
_MARCH_START = SlotFile("start", "surface/start.glsl@start", prefix="water", needs=_STARTS)


def is_calm(scene: Scene) -> bool:
    """Whether water mirrors the sun or the moon as a narrow column."""
    ripples = scene.water.ripples
    return scene.light is not None and ripples is not None and ripples.slope < CALM


def is_dotted(scene: Scene) -> bool:
    """Whether each sample of foam is black or white: of looks that compare the mask sample by sample."""
    return scene.foam is not None and scene.foam.look in ("halftone", "halftone_textured", "fading", "listing")


def _step_widest(tolerance: float) -> float:
    """By how much the tolerance of a march's steps grows, over the first."""
    return STEP_WIDEST / tolerance - 1.0 if tolerance >= 0.1 else 0.0


def _rows_share(collection: Collection, width: int) -> float:
    scene = collection.scene
    if is_dotted(scene):
        return ROWS_SHARE_OF_DOTS
    if is_calm(scene) or (width > 3 and not collection.fills("shore")):
        return 0.0
    return ROWS_SHARE_OF_CAUSTICS if collection.fills("caustics") else ROWS_SHARE


@dataclass(frozen=True)
class Stage:
    """Passes in drawing order, and the programs, targets and uniforms that they need."""

    passes: Sequence[Pass] = ()
    programs: Mapping[str, Program] = field(default_factory=dict)
    targets: Mapping[str, Target] = field(default_factory=dict)
    uniforms: Mapping[str, Uniform] = field(default_factory=dict)

    def joined(self, *others: "Stage") -> "Stage":
        """Return this stage and then the others as one."""
        stages = (self, *others)
        return Stage(
            [drawn for stage in stages for drawn in stage.passes],
            {name: program for stage in stages for name, program in stage.programs.items()},
            {name: target for stage in stages for name, target in stage.targets.items()},
            {name: uniform for stage in stages for name, uniform in stage.uniforms.items()},
        )


class Frame:
    """A scene's contributions at a quality: the files that fill the slots of its shaders, and their constants."""

    def __init__(self, collection: Collection, quality: Quality) -> None:
        self.scene, self.quality = collection.scene, quality
        self.side = math.isqrt(quality.samples)
        """Samples along each side of a drawn pixel."""
        self.narrow = quality.pixel_width > 1
        """Whether water, land and sky are drawn at a part of the picture's width."""
        self.sampled = ViewportSize(scale=self.side, narrow=quality.pixel_width)
        """Size of what is drawn sample by sample."""
        self.level = collection.max_height == 0.0
        self.shore, self.below = collection.fills("shore"), collection.fills("below")
        if not self.level or self.shore:
            collection = collection.joined(_starts(self.sampled, measured=collection.fills("bounds")))
        self.collection = collection
        footprint = FOOTPRINT_X_OF_CAUSTICS if collection.fills("caustics") else FOOTPRINT_X
        self.consts: dict[str, Const] = {
            **collection.consts,
            "SURFACE_FILTER": quality.surface.filter,
            "REFINE": max(quality.surface.refine, collection.refine),
            "MARCH_STEPS": quality.surface.steps * collection.march_factor,
            "MARCH_TOLERANCE": quality.surface.tolerance * collection.coarser,
            "MARCH_STEP_WIDENS": 0.25 if quality.surface.tolerance <= 0.1 else 0.1,
            "MARCH_STEP_WIDEST": _step_widest(quality.surface.tolerance),
            "START_SHARE": START_SHARE,
            "SAMPLE_SIDE": self.side,
            "PIXEL_WIDTH": float(quality.pixel_width),
            "ROW_SHIFT": ROW_SHIFT_OF_FAST if quality.pixel_width > 3 else ROW_SHIFT,
            "ROWS_SHARE": _rows_share(collection, quality.pixel_width),
            "DOTTED": is_dotted(collection.scene),
            "FOOTPRINT_X": footprint if self.narrow else 1.0,
            # Of a frame that is drawn narrow, as many as lie in a block; what stands before it has more.
            "BLOCK_COLUMNS": 4
            if self.coarse == 1 and any(spec.shines for spec in self.above)
            else -(-4 // quality.pixel_width),
        }
        self.met = [*_met_files(collection.slots, self.level), *(self._finished() if self.narrow else ())]
        """Files of a pass that only finds what rays meet: it has a texture more to spare than others."""
        self.marched = [file for file in self.met if file.slot != GENTLER.name]
        """Files of passes, and for cameras that are not over all crests, which use no mesh."""
        self.waves = tuple(self.pieces([SlotRef("waves")]))

    def with_consts(self, consts: Mapping[str, Const]) -> "Frame":
        """Return the same frame with other or more constants."""
        other = copy(self)
        other.consts = {**self.consts, **consts}
        return other

    def pieces(self, parts: Sequence[Piece | SlotRef], files: Sequence[SlotFile] | None = None) -> list[Piece]:
        """Return the pieces of a shader, with each slot replaced by those of ``files`` that fill it.

        The default is the files for ray marching.
        """
        pieces: list[Piece] = []
        for part in parts:
            if isinstance(part, SlotRef):
                for slot in slots_named(part.slot, self.shore):
                    pieces += slot_pieces(slot, self.marched if files is None else files)
            else:
                pieces.append(part)
        return pieces

    def program(
        self,
        fragment: Sequence[Piece | SlotRef],
        vertex: Sequence[Piece | SlotRef] = FULLSCREEN,
        *,
        over: bool | None = None,
        depth: float = 0.0,
    ) -> Program:
        """Return a program; ``over``: it draws only if the camera is over the water, or under it, or whatever it is.

        ``depth``: in clip space, of what covers the target.
        """
        placed, consts = self.pieces(vertex), {**self.consts, "FULLSCREEN_DEPTH": depth}
        if self.below and over is not None:
            placed, consts["FROM_OVER"] = one_sided(placed, self.waves), over
        return Program(vertex=assemble(placed, consts), fragment=assemble(self.pieces(fragment), self.consts))

    def found_over(self, name: str, program: str, target: str, state: State) -> Pass:
        """Return a pass over the whole target for a camera over the water."""
        eye = OVER if self.below else "any"
        return fullscreen(name, program, target).model_copy(update={"eye": eye, "state": state})

    def effect_programs(self) -> dict[str, Program]:
        programs: dict[str, Program] = {}
        for spec in self.collection.passes:
            programs[spec.program] = self.program(spec.fragment, spec.vertex, over=True if spec.under else None)
            if self.below and spec.under:
                programs[underwater(spec.program)] = self.program(spec.under, spec.vertex, over=False)
        return programs

    def effect_passes(self, stage: str) -> list[Pass]:
        return [drawn for spec in self.collection.passes if spec.stage == stage for drawn in self.passes_of(spec)]

    @property
    def above(self) -> list[PassSpec]:
        """Passes that are blended over surface and sky; the first clears their target."""
        return [spec for spec in self.collection.passes if spec.stage == "after" and spec.target == ABOVE]

    @property
    def coarse(self) -> int:
        """How many pixels are as wide and as high as one of what stands before surface and sky."""
        return min((spec.part for spec in self.above), default=1)

    @property
    def laid(self) -> tuple[Piece, ...]:
        """Files that lay what stands before surface and sky over ``beneath()``, if anything does."""
        coarse = ("output/frame.glsl@viewport", "output/frame.glsl@above_coarse")
        over = coarse if self.coarse > 1 else ("output/frame.glsl@above",)
        return (*over, "output/frame.glsl@laid", "output/frame.glsl@composed") if self.above else ()

    def _finished(self) -> list[SlotFile]:
        """Files that read the finished frame where it is drawn narrow: no picture of its full size is written."""
        first = ("lib/numbers.glsl", "output/frame.glsl@viewport")
        above = self.laid[:-1]
        seen = "laid(under, above(pixel))" if above else "under"
        over = constant_function("vec4", "over_narrow", "vec4 under, vec2 pixel", seen)
        under = "beneath" if above else "finished"
        *drawn, last = Source("output/enlarge.glsl@enlarged", (("enlarged", under),)), *self.laid
        return [
            SlotFile("block mean", "output/glare.glsl@mean_narrow", needs=(*first, *above, over)),
            SlotFile("finished", last, needs=(*first, *drawn)),
        ]

    def passes_of(self, spec: PassSpec) -> list[Pass]:
        """Return the pass of a spec, or several if its shader differs for cameras over and under the water."""
        always = Pass(
            name=spec.name,
            when="frame",
            program=spec.program,
            target=spec.target,
            mesh=spec.mesh,
            inputs={sampler: source_of(name, self.collection.textures) for sampler, name in spec.read.items()},
            uniforms=spec.uniforms,
            view=spec.view,
            state=State(clear=spec.clear or spec in self.above[:1], blend=spec.blend),
        )
        if not self.below or not spec.under:
            return [always]
        low = always.model_copy(update={"program": underwater(spec.program)})
        return [always.model_copy(update={"eye": OVER}), *from_under(low, self.level)]


def underwater(program: str) -> str:
    return f"{program}, underwater"


def fullscreen(name: str, program: str, target: str, reads: Mapping[str, str] | None = None) -> Pass:
    """Return a pass over the whole target. ``reads``: sampler -> the target that it reads, if not that of its name."""
    inputs = {sampler: TargetInput(target=name) for sampler, name in (reads or {}).items()}
    return Pass(name=name, when="frame", program=program, target=target, mesh=Fullscreen(), inputs=inputs)


def one_sided(vertex: Sequence[Piece], waves: Sequence[Piece]) -> list[Piece]:
    """Return a vertex shader that draws nothing from the other side of the water than ``FROM_OVER`` names.

    ``vertex``: the pieces of a vertex shader, its ``main`` in the last; ``waves``: the surface's.
    """
    *before, last = vertex
    source = Source(last) if isinstance(last, str) else last
    assert isinstance(source, Source)
    main = replace(source, rename=(*source.rename, ("main", "place_corner")))
    first = (*COMMON, *waves)
    return [*first, *(piece for piece in before if piece not in first), main, "vertex/vertex.glsl@side"]


def from_under(drawn: Pass, level: bool) -> list[Pass]:
    """Return a pass for a camera under the water: where it can be on either side, the pass for over it has cleared.

    ``level``: whether the water is, so that there is no between.
    """
    either = drawn.model_copy(update={"eye": ("between",), "state": drawn.state.model_copy(update={"clear": False})})
    under = drawn.model_copy(update={"eye": ("under",)})
    return [under] if level else [either, under]


def find(intersection: str) -> SlotFile:
    return SlotFile("find", intersection, needs=(MARCH_AHEAD,) if intersection == MARCHED else ())


def _met_files(given: Sequence[SlotFile], level: bool) -> list[SlotFile]:
    """Return the files of a pass that only finds what rays meet. ``level``: whether the water is."""
    left_out = (APPROACH.name, GENTLER.name) if level else ()
    return [
        *(file for file in given if file.slot not in left_out),
        find(PLANE if level else MARCHED),
        SlotFile("underside", "water/underside.glsl@plane" if level else "water/underside.glsl@find"),
        SlotFile("bounds", "surface/bounds.glsl@declared", prefix="declared"),
        *(() if level else (MARCH, _MARCH_START)),
    ]


def _starts(sampled: ViewportSize, *, measured: bool) -> Resources:
    """The passes that find the start distances to water and land of the rays of each tile of the picture.

    ``measured``: maps of waves are, in every frame.
    """

    def tiles(side: int) -> Target:
        size = sampled.model_copy(update={"part": sampled.part * side, "odd": True})
        return Target(size=size, format="RGBA16F")

    search: tuple[Piece | SlotRef, ...] = (*COMMON, *map(SlotRef, ("waves", "beyond", "bounds", "start")))
    near = PassSpec("where rays begin", "start", (*search, "surface/start.glsl@start_anew", "surface/start.glsl@pass"))
    if not measured:
        return drawn_map(near, tiles(START_TILE))
    slots = map(SlotRef, ("waves", "bounds", "short bounds"))
    now = PassSpec("bounds of the surface", "surface_now", (*COMMON, *slots, "surface/bounds.glsl@now_pass"))
    # Measured maps are steep and searched in many steps: first for wider tiles.
    wide = replace(near, name="where wide beams of rays begin", program="start, wide", target="start, wide")
    files = (*search, "surface/start.glsl@start_within", "surface/start.glsl@pass")
    within = replace(near, fragment=files)
    return Resources(slots=(SlotFile("now", "surface/bounds.glsl@now_measured"),)).joined(
        drawn_map(now, Target(size=FixedSize.square(1), format="RGBA16F")),
        drawn_map(wide, tiles(WIDE_TILE)),
        drawn_map(within, tiles(START_TILE)),
    )
