"""Surface, land and sky: the passes that find what rays meet, and those that draw it."""

from collections.abc import Sequence
from functools import cached_property

from seafoam.effects.shader import COMMON, PLACE, Piece, SlotFile, SlotRef
from seafoam.effects.waves.sea import WHITECAP_WIND
from seafoam.framegraph.plan import Fullscreen, Grid, Pass, Program, State
from seafoam.framegraph.resources import Target
from seafoam.planner import slots
from seafoam.planner.adaptive import Redrawn
from seafoam.planner.frame import MARCH, MARCHED, OVER, PLANE, Frame, Stage, find, from_under, fullscreen, underwater
from seafoam.planner.glsl import PLACE_SHIFTED, slot_pieces

SURFACE, SKY = "surface", "sky"
"""Programs and passes."""
UNDERWATER = underwater(SURFACE)
"""The surface's program for a camera under the water."""
SAMPLES, LAND_SAMPLES = "surface samples", "land samples"
"""Programs and passes of the samples of water and land, where these are found by passes of their own, and the target of
both, which has the first's name."""
BETWEEN = "surface, between"
"""The program that draws it instead of a mesh for a camera over the water but not over all crests."""
COARSEST = 0.1
"""Greatest tolerance of the search with which one program finds samples and another lights them."""
_LAND_DEPTH = -0.5
"""Clip-space depth of land: before the water."""
_HORIZON_DEPTH = 0.9999995
"""Clip-space depth of the sky: behind all water, before the cleared depth."""


class Scenery:
    """Surface, land and sky of a frame, drawn into ``target``."""

    def __init__(self, frame: Frame, target: str) -> None:
        self.frame, self.target = frame, target
        self.sampled: tuple[Piece, ...] = (*COMMON, PLACE_SHIFTED if frame.narrow else PLACE)
        # Land extends above the horizon, where the sea's mesh does not.
        self.mesh = frame.quality.surface.method == "mesh" and not frame.level and not frame.shore
        self.files = self._files()
        self.combine: slots.Combine = frame.scene.foam.combine if frame.scene.foam else "max"
        self.slots = slots.surface_slots(self.combine, frame.shore)
        self.kept = not self.mesh and _in_two(frame)
        """Whether a pass finds the water's samples and another lights them."""

    def stage(self) -> Stage:
        size, targets = self.frame.sampled, {}
        if self.frame.shore:
            targets["met"] = Target(size=size, format="RGBA32F")
        if self.kept:
            targets[SAMPLES] = Target(size=size, format="RGBA32F", layers=3, depth=self.frame.shore)
        return Stage(
            passes=self._passes(),
            programs={**self._surface_programs(), **(self._land_programs() if self.frame.shore else {})},
            targets=targets,
        )

    def redrawn(self) -> tuple[Redrawn, ...]:
        """Return surface and sky as they are drawn again for selected pixels: by ray marching, land with the water."""
        found: list[Redrawn] = []
        for drawn in self._surfaces():
            low = drawn.program == UNDERWATER
            state = drawn.state if low else drawn.state.model_copy(update={"clear": True})
            over = None if self.mesh and drawn.program == SURFACE else not low
            pieces = self._under if low else self._marched
            found.append(Redrawn(drawn.model_copy(update={"state": state}), pieces, over=over))
        return (*found, Redrawn(self._sky_pass, self._sky, depth=_HORIZON_DEPTH))

    def _files(self) -> list[SlotFile]:
        shore, given = self.frame.shore, self.frame.collection.slots
        intersection = MARCHED
        if shore:
            intersection = "surface/met.glsl@met"
        elif self.frame.level:
            intersection = PLANE
        elif self.mesh:
            intersection = "surface/march.glsl@newton"
        # With land, a pass before the surface's finds whether a ray hits water or land first.
        of_land = (slots.APPROACH, slots.LAND, slots.LAND_SOIL, slots.LAND_COLOR, slots.LAND_FOAM) if shore else ()
        left_out = {slot.name for slot in (*of_land, slots.GENTLER)}
        files = [*(file for file in given if file.slot not in left_out), find(intersection)]
        return [*files, MARCH] if intersection == MARCHED else files

    def _of_slots(self, filled: Sequence[slots.Slot], files: Sequence[SlotFile]) -> tuple[Piece, ...]:
        return (*self.sampled, *(piece for slot in filled for piece in slot_pieces(slot, files)))

    @cached_property
    def _marched(self) -> tuple[Piece, ...]:
        return self._of_slots(self.slots, self.frame.marched)

    @cached_property
    def _under(self) -> tuple[Piece, ...]:
        own = (slot for slot in self.slots if slot not in slots.ONLY_OVER)
        return self._of_slots((*own, *slots.UNDER_SLOTS), self.frame.marched)

    def _samples(self, *, low: bool) -> tuple[Piece, ...]:
        """Return what finds the samples that the next pass lights; ``low``: of a camera under the water."""
        finds = slots.sample_slots(self.combine, self.frame.shore)
        if low:
            own = (slot for slot in finds if slot not in slots.ONLY_OVER)
            files = self._of_slots((*own, slots.UNDERSIDE, *slots.FOUND_BELOW), self.frame.marched)
        else:
            files = self._of_slots((*finds, slots.LAND, slots.FIRST, *slots.FOUND), self.files)
        return (*files, slots.SAMPLES_PASS)

    def _lit(self, *, low: bool) -> tuple[Piece, ...]:
        """Return what lights the samples that the pass before has found."""
        # A shore's floor is among its waves.
        lit = (*((slots.OPEN_WAVES, slots.SHORE) if self.frame.shore else ()), *slots.LIGHT_SLOTS)
        if low:
            own = (slot for slot in lit if slot not in slots.ONLY_OVER)
            under = (slots.REACH, slots.UNDER_BED, *slots.KEPT, slots.BELOW)
            return self._of_slots((*own, *under), self.frame.marched)
        return self._of_slots((*lit, slots.LAND, *slots.KEPT, slots.MAIN), self.files)

    @cached_property
    def _sky(self) -> tuple[Piece, ...]:
        return self._of_slots(slots.SKY_PASS_SLOTS, self.files)

    def _up_to_horizon(self, side: Piece) -> list[Piece]:
        """Return the vertex shader of a triangle on one side of the line that rays to water do not cross."""
        rise: list[Piece] = ["vertex/vertex.glsl@rise_level"]
        if not self.frame.level:
            rise = [*slot_pieces(slots.NOW, self.frame.marched), "vertex/vertex.glsl@rise"]
        return [*COMMON, *self.frame.waves, *rise, "vertex/vertex.glsl@horizon", side]

    def _surface_programs(self) -> dict[str, Program]:
        frame, falling = self.frame, self._up_to_horizon("vertex/vertex.glsl@falling")
        surface = self._lit(low=False) if self.kept else self._of_slots(self.slots, self.files)
        programs = {SKY: frame.program(self._sky, depth=_HORIZON_DEPTH)}
        if self.mesh:
            grid = [*COMMON, *slot_pieces(slots.WAVES, self.files), "vertex/vertex.glsl@polar_grid"]
            programs[SURFACE] = frame.program(surface, grid)
            if frame.below:
                programs[BETWEEN] = frame.program(self._marched, falling, over=True)
        else:
            programs[SURFACE] = frame.program(surface, falling, over=True)
        if frame.below:
            programs[UNDERWATER] = frame.program(self._lit(low=True) if self.kept else self._under, over=False)
        if self.kept:
            programs[SAMPLES] = frame.program(self._samples(low=False), falling, over=True)
        if self.kept and frame.below:
            programs[underwater(SAMPLES)] = frame.program(self._samples(low=True), over=False)
        return programs

    def _land_programs(self) -> dict[str, Program]:
        frame, shown = self.frame, [*self.sampled, "shore/land.glsl@land_shown_pass"]
        falling, rising = map(self._up_to_horizon, ("vertex/vertex.glsl@falling", "vertex/vertex.glsl@rising"))
        met = frame.pieces([*self.sampled, *map(SlotRef, ("waves", "find", "land", "first"))], frame.met)
        matter, light = slots.land_slots(self.combine, frame.collection.fills(slots.LAND_FOAM.name))
        shore, found = (slots.OPEN_WAVES, slots.SHORE), {}
        lit = (*shore, *light, *(slots.SOIL_KEPT if self.kept else matter), slots.LAND_COLOR)
        if self.kept:
            kept = [*self._of_slots((*shore, *matter), frame.marched), "shore/land.glsl@land_samples_pass"]
            found[LAND_SAMPLES] = frame.program(kept, over=True, depth=_LAND_DEPTH)
        return {
            **found,
            "met": frame.program([*met, "surface/met.glsl@met_pass"], falling, over=True),
            "met, rising": frame.program([*met, "surface/met.glsl@met_rising_pass"], rising, over=True),
            "land, shown": frame.program(shown, over=True, depth=_LAND_DEPTH),
            "land": frame.program(
                [*self._of_slots(lit, frame.marched), "shore/land.glsl@land_pass"], over=True, depth=_LAND_DEPTH
            ),
        }

    def _passes(self) -> list[Pass]:
        """Surface, land and sky; with land, first what rays meet."""
        lit, found = self._surfaces(), []
        if self.kept:
            found = [self._samples_pass(drawn) for drawn in lit]
        if not self.frame.shore:
            return [*found, *lit, self._sky_pass]

        over, first, equal = self.frame.found_over, State(depth=True, clear=True), State(depth=True, equal=True)
        if self.kept:
            shown = over(f"where land shows, {LAND_SAMPLES}", "land, shown", SAMPLES, first)
            found = [shown, *found, over(LAND_SAMPLES, LAND_SAMPLES, SAMPLES, equal)]
        return [
            over("what rising rays meet", "met, rising", "met", State()),
            over("what rays meet", "met", "met", State()),
            *found,
            over("where land shows", "land, shown", self.target, first),
            *lit,
            over("land", "land", self.target, equal),
            self._sky_pass,
        ]

    @property
    def _sky_pass(self) -> Pass:
        # A mesh ends before the horizon, and rays of a camera between crests may miss the water.
        view = "any" if self.mesh else "rising"
        return fullscreen(SKY, SKY, self.target).model_copy(update={"view": view, "state": State(depth=True)})

    def _surfaces(self) -> list[Pass]:
        frame, cells = self.frame, self.frame.quality.surface.cells
        own = Pass(
            name=SURFACE,
            when="frame",
            # Land extends above the horizon.
            view="any" if frame.shore else "falling",
            program=SURFACE,
            target=self.target,
            mesh=Grid(rows=cells, columns=cells) if self.mesh else Fullscreen(),
            # With a shore, the pass that tells where land shows has cleared.
            state=State(depth=True, clear=not frame.shore),
        )
        if not frame.below:
            return [own]
        over = [own.model_copy(update={"eye": OVER})]
        if self.mesh:
            between = {"eye": ("between",), "program": BETWEEN, "mesh": Fullscreen()}
            over = [own.model_copy(update={"eye": ("over",)}), own.model_copy(update=between)]
        low = own.model_copy(
            update={"program": UNDERWATER, "mesh": Fullscreen(), "state": State(depth=True, clear=True)}
        )
        return [*over, *from_under(low, frame.level)]

    def _samples_pass(self, lit: Pass) -> Pass:
        program = underwater(SAMPLES) if lit.program == UNDERWATER else SAMPLES
        state = lit.state if self.frame.shore else State()
        return lit.model_copy(update={"name": SAMPLES, "program": program, "target": SAMPLES, "state": state})


def _in_two(frame: Frame) -> bool:
    """Whether one program for a sample and its light would be large: seas that break, boats or a shore, and light.

    On a GPU two programs then need half to three quarters of its registers; on a processor they take 0 to 5 % longer,
    9 with a shore: not where the search is as coarse as for what a processor draws in motion. Nor for several samples a
    pixel, whose kept samples would take too much memory.
    """
    scene, quality = frame.scene, frame.quality
    breaks = scene.sea is not None and scene.sea.wind_speed >= WHITECAP_WIND
    alone = quality.samples == 1 and not quality.chosen_samples and not quality.foam_relief
    fine = quality.surface.tolerance <= COARSEST
    return alone and fine and scene.light is not None and (frame.shore or breaks or bool(scene.boats))
