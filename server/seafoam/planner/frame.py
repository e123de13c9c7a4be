"""The frame's own programs, targets and passes: surface, land, sky, overlays, samples and tone mapping."""

import math
from collections.abc import Mapping, Sequence
from typing import Literal

from seafoam.effects.effect import ABOVE, BENEATH, FINISHED, PassSpec
from seafoam.effects.shader import Const, Piece, SlotFile, SlotRef
from seafoam.framegraph.passes import Fullscreen, Grid, Pass, State
from seafoam.framegraph.resources import Target, TargetInput, TextureInput, ViewportSize
from seafoam.framegraph.rules import Uniform
from seafoam.framegraph.shader import Program
from seafoam.planner.adaptive import PLACE, Redrawn, additional_samples
from seafoam.planner.collect import Collection
from seafoam.planner.files import marched_files, met_files, surface_files
from seafoam.planner.glsl import COMMON, FULLSCREEN, assemble, slot_pieces
from seafoam.planner.sides import FROM_OVER, OVER, from_under, one_sided
from seafoam.planner.slots import (
    GLARE,
    LAND_FOAM,
    NOW,
    ONLY_OVER,
    SKY_PASS_SLOTS,
    TONE,
    UNDER_SLOTS,
    WAVES,
    land_slots,
    slots_named,
    surface_slots,
)
from seafoam.quality import Quality
from seafoam.scene.models import Scene

START_SHARE = 0.25
"""Step length below which the search for a start distance ends, in heights of a tile at that distance."""

UNDERWATER = "surface, underwater"
"""Name of the surface's program for a camera under the water."""

BETWEEN = "surface, between"
"""Name of the program that draws it instead of a mesh for a camera over the water but not over all crests."""

_SAMPLED: tuple[Piece, ...] = (*COMMON, PLACE)
_LAND_DEPTH = -0.5
"""Clip-space depth of land: before the water."""
_HORIZON_DEPTH = 0.9999995
"""Clip-space depth of the sky: behind all water, before the cleared depth."""


class FrameBuilder:
    """Programs, targets, uniforms and passes of a scene's frame.

    Each method adds what it needs to ``programs`` and ``targets`` and returns its passes; :meth:`passes` calls them in
    the order in which they are drawn.
    """

    def __init__(self, collection: Collection, scene: Scene, quality: Quality) -> None:
        self.collection, self.scene, self.quality = collection, scene, quality
        self.side = math.isqrt(quality.samples)
        self.level = collection.max_height == 0.0
        self.shore, self.below = collection.fills("shore"), collection.fills("below")
        # Land extends above the horizon, where the sea's mesh does not.
        self.mesh = quality.surface.method == "mesh" and not self.level and not self.shore
        if not self.level or self.shore:
            collection.add_starts(self.side)
        self.consts: dict[str, Const] = {
            **collection.consts,
            "SURFACE_FILTER": quality.surface.filter,
            "REFINE": quality.surface.refine,
            "MARCH_STEPS": quality.surface.steps * collection.march_factor,
            "MARCH_TOLERANCE": quality.surface.tolerance,
            "START_SHARE": START_SHARE,
            "SAMPLE_SIDE": self.side,
        }
        # A pass that only finds what rays meet has a texture more to spare than the others.
        self.marched, self.met = marched_files(collection.slots, self.level), met_files(collection.slots, self.level)
        self.chosen = surface_files(collection.slots, shore=self.shore, level=self.level, mesh=self.mesh)
        self.fragments = self._fragments()
        self.programs: dict[str, Program] = {}
        self.sided: dict[str, dict[str, Const]] = {}
        """Programs that draw from one side of the water, with the constants of their vertex shaders."""
        self.uniforms: dict[str, Uniform] = {}
        self.targets = {
            **collection.targets,
            "samples": Target(size=ViewportSize(scale=self.side), format=quality.target, depth=True),
        }
        self.drawn = "samples"
        """The target of surface, land and sky."""
        self.linear = "samples"
        """The target that holds the finished linear frame."""

    def passes(self) -> list[Pass]:
        """Every pass of the frame, in drawing order."""
        self._surface_programs()
        self._effect_programs()
        before = self._effect_passes("before")
        overlay = self._overlay()
        search, scenery = self._search(), self._scenery()
        resolve = self._resolve()
        more_samples = self._more_samples([drawn for drawn in scenery if drawn.name in ("surface", "sky")])
        return [*before, *search, *scenery, *overlay, *resolve, *more_samples, *self._display()]

    def _fragments(self) -> dict[str, list[Piece]]:
        """Pieces of the fragment shaders of surface and sky; ``surface, marched`` is for additional samples."""
        surface, marched, low = [*_SAMPLED], [*_SAMPLED], [*_SAMPLED]
        for slot in surface_slots(self._combine, self.shore):
            surface += slot_pieces(slot, self.chosen)
            pieces = slot_pieces(slot, self.marched)
            marched += pieces
            low += [] if slot in ONLY_OVER else pieces
        for slot in UNDER_SLOTS if self.below else ():
            low += slot_pieces(slot, self.marched)
        sky = [*_SAMPLED, *(piece for slot in SKY_PASS_SLOTS for piece in slot_pieces(slot, self.chosen))]
        return {"surface": surface, "surface, marched": marched, UNDERWATER: low, "sky": sky}

    @property
    def _combine(self) -> Literal["max", "product"]:
        return self.scene.foam.combine if self.scene.foam else "max"

    def _pieces(self, parts: Sequence[Piece | SlotRef], files: Sequence[SlotFile] | None = None) -> list[Piece]:
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

    def _program(
        self,
        name: str,
        fragment: Sequence[Piece | SlotRef],
        vertex: Sequence[Piece | SlotRef] = FULLSCREEN,
        *,
        over: bool | None = None,
        depth: float = 0.0,
    ) -> None:
        """Add a program; ``over``: it draws only if the camera is over the water, or under it, or whatever it is.

        ``depth``: in clip space, of what covers the target.
        """
        placed = self._pieces(vertex)
        if over is not None and self.below:
            self.sided[name] = {FROM_OVER: over}
            placed = one_sided(placed, self._waves)
        self.programs[name] = Program(
            vertex=assemble(placed, {**self.consts, "FULLSCREEN_DEPTH": depth, **self.sided.get(name, {})}),
            fragment=assemble(self._pieces(fragment), self.consts),
        )

    @property
    def _waves(self) -> tuple[Piece, ...]:
        return tuple(self._pieces([SlotRef("waves")]))

    def _up_to_horizon(self, side: str) -> list[Piece]:
        """Return the vertex shader of a triangle on one side of the line that rays to water do not cross."""
        rise = (
            ["vertex/vertex.glsl@rise_level"]
            if self.level
            else [*slot_pieces(NOW, self.marched), "vertex/vertex.glsl@rise"]
        )
        return [*COMMON, *self._waves, *rise, "vertex/vertex.glsl@horizon", side]

    def _surface_programs(self) -> None:
        falling, rising = (
            self._up_to_horizon(side) for side in ("vertex/vertex.glsl@falling", "vertex/vertex.glsl@rising")
        )
        if self.mesh:
            grid = [*COMMON, *slot_pieces(WAVES, self.chosen), "vertex/vertex.glsl@polar_grid"]
            self._program("surface", self.fragments["surface"], grid)
            if self.below:
                self._program(BETWEEN, self.fragments["surface, marched"], falling, over=True)
        else:
            self._program("surface", self.fragments["surface"], falling, over=True)
        self.programs["sky"] = Program(
            vertex=assemble(FULLSCREEN, {"FULLSCREEN_DEPTH": _HORIZON_DEPTH}),
            fragment=assemble(self.fragments["sky"], self.consts),
        )
        self._program(
            "present", [*slot_pieces(GLARE, self.chosen), *slot_pieces(TONE, self.chosen), "output/frame.glsl@present"]
        )
        if self.below:
            self._program(UNDERWATER, self.fragments[UNDERWATER], over=False)
        if self.shore:
            found = ("waves", "find", "land", "first")
            met = self._pieces([*_SAMPLED, *map(SlotRef, found)], self.met)
            land = [*_SAMPLED]
            for slot in land_slots(self._combine, self.collection.fills(LAND_FOAM.name)):
                land += slot_pieces(slot, self.marched)
            self._program("met", [*met, "surface/met.glsl@met_pass"], falling, over=True)
            self._program("met, rising", [*met, "surface/met.glsl@met_rising_pass"], rising, over=True)
            shown = [*_SAMPLED, "shore/land.glsl@land_shown_pass"]
            self._program("land, shown", shown, over=True, depth=_LAND_DEPTH)
            self._program("land", [*land, "shore/land.glsl@land_pass"], over=True, depth=_LAND_DEPTH)

    def _effect_programs(self) -> None:
        for spec in self.collection.passes:
            self._program(spec.program, spec.fragment, spec.vertex, over=True if spec.under else None)
            if self.below and spec.under:
                self._program(f"{spec.program}, underwater", spec.under, spec.vertex, over=False)

    def _effect_passes(self, stage: str) -> list[Pass]:
        return [drawn for spec in self.collection.passes if spec.stage == stage for drawn in self._passes_of(spec)]

    @property
    def _above(self) -> list[PassSpec]:
        """Passes that are blended over surface and sky; the first clears their target."""
        return [spec for spec in self.collection.passes if spec.stage == "after" and spec.target == ABOVE]

    def _passes_of(self, spec: PassSpec) -> list[Pass]:
        """Return the pass of a spec, or several if its shader differs for cameras over and under the water."""
        reads_slots = any(isinstance(part, SlotRef) for part in (*spec.vertex, *spec.fragment))
        always = Pass(
            name=spec.name,
            when="frame",
            program=spec.program,
            target=spec.target,
            mesh=spec.mesh,
            inputs={**self.collection.inputs, **spec.inputs} if reads_slots else spec.inputs,
            uniforms=spec.uniforms,
            view=spec.view,
            state=State(clear=spec.clear or spec in self._above[:1], blend=spec.blend),
        )
        if not self.below or not spec.under:
            return [always]
        low = always.model_copy(update={"program": f"{spec.program}, underwater"})
        return [always.model_copy(update={"eye": OVER}), *from_under(low, self.level)]

    def _fullscreen(self, name: str, program: str, target: str, reads: Mapping[str, str]) -> Pass:
        inputs: dict[str, TextureInput | TargetInput] = {
            key: TargetInput(target=source) for key, source in reads.items()
        }
        return Pass(name=name, when="frame", program=program, target=target, mesh=Fullscreen(), inputs=inputs)

    def _overlay(self) -> list[Pass]:
        """Passes that are blended over surface and sky, and the pass that blends them."""
        after = self._effect_passes("after")
        if not after:
            return []
        self.drawn = BENEATH
        self.targets[BENEATH] = self.targets["samples"]
        self.targets[ABOVE] = Target(size=ViewportSize(scale=self.side), format="RGBA16F")
        self.targets["samples"] = Target(size=ViewportSize(scale=self.side), format=self.quality.target)
        self.programs["compose"] = Program(
            vertex=assemble(FULLSCREEN, {"FULLSCREEN_DEPTH": 0.0}),
            fragment=assemble(["lib/numbers.glsl", "output/frame.glsl@compose"], {}),
        )
        return [
            *after,
            self._fullscreen(
                "what stands before the water", "compose", "samples", {"u_beneath": BENEATH, "u_above": ABOVE}
            ),
        ]

    def _surfaces(self) -> list[Pass]:
        """Passes that draw the surface, for all camera heights."""
        cells = self.quality.surface.cells
        own = Pass(
            name="surface",
            when="frame",
            # Land extends above the horizon.
            view="any" if self.shore else "falling",
            program="surface",
            target=self.drawn,
            mesh=Grid(rows=cells, columns=cells) if self.mesh else Fullscreen(),
            inputs=self.collection.inputs,
            # With a shore, the pass that tells where land shows has cleared.
            state=State(depth=True, clear=not self.shore),
        )
        if not self.below:
            return [own]
        over = [own.model_copy(update={"eye": OVER})]
        if self.mesh:
            between = {"eye": ("between",), "program": BETWEEN, "mesh": Fullscreen()}
            over = [own.model_copy(update={"eye": ("over",)}), own.model_copy(update=between)]
        low = own.model_copy(
            update={"program": UNDERWATER, "mesh": Fullscreen(), "state": State(depth=True, clear=True)}
        )
        return [*over, *from_under(low, self.level)]

    def _display(self) -> list[Pass]:
        """Passes that show the finished frame: those of effects, and tone mapping."""
        finished = [
            drawn.model_copy(
                update={
                    "inputs": {
                        name: TargetInput(target=self.linear) if source == TargetInput(target=FINISHED) else source
                        for name, source in drawn.inputs.items()
                    }
                }
            )
            for drawn in self._effect_passes("finished")
        ]
        tone = self._fullscreen("tone", "present", "screen", {"u_linear": self.linear})
        return [*finished, tone.model_copy(update={"inputs": {**self.collection.inputs, **tone.inputs}})]

    def _found_over(self, name: str, program: str, target: str, state: State) -> Pass:
        return Pass(
            name=name,
            when="frame",
            eye=OVER if self.below else "any",
            program=program,
            target=target,
            mesh=Fullscreen(),
            inputs=self.collection.inputs,
            state=state,
        )

    def _search(self) -> list[Pass]:
        """Passes that find whether a ray hits water or land first."""
        if not self.shore:
            return []
        self.targets["met"] = Target(size=ViewportSize(scale=self.side), format="RGBA32F")
        self.collection.inputs["u_met"] = TargetInput(target="met")
        return [
            self._found_over("what rising rays meet", "met, rising", "met", State()),
            self._found_over("what rays meet", "met", "met", State()),
        ]

    def _scenery(self) -> list[Pass]:
        """Surface, land and sky."""
        shown = self._found_over("where land shows", "land, shown", self.drawn, State(depth=True, clear=True))
        land = self._found_over("land", "land", self.drawn, State(depth=True, equal=True))
        sky = Pass(
            name="sky",
            when="frame",
            # A mesh ends before the horizon, and rays of a camera between crests may miss the water.
            view="any" if self.mesh else "rising",
            program="sky",
            target=self.drawn,
            mesh=Fullscreen(),
            state=State(depth=True),
        )
        return [shown, *self._surfaces(), land, sky] if self.shore else [*self._surfaces(), sky]

    def _resolve(self) -> list[Pass]:
        """The pass that averages each pixel's samples."""
        if self.side == 1:
            return []
        self.linear = "linear"
        self.targets[self.linear] = Target(size=ViewportSize(), format="RGBA32F")
        self._program("resolve", ["output/frame.glsl@resolve"])
        return [self._fullscreen("mean of the samples", "resolve", self.linear, {"u_samples": "samples"})]

    def _more_samples(self, scenery: Sequence[Pass]) -> list[Pass]:
        """Passes of adaptive sampling."""
        # Without light an additional sample costs less than its selection.
        if not self.quality.chosen_samples or self.scene.light is None:
            return []
        marched = self.fragments["surface, marched"]
        fragments = {**self.fragments, "surface": marched, BETWEEN: marched}
        depths = {"sky": _HORIZON_DEPTH}
        redrawn = tuple(
            Redrawn(
                # There the program finds land too.
                _cleared(drawn) if drawn.program in ("surface", BETWEEN) else drawn,
                tuple(fragments[drawn.program]),
                depths.get(drawn.program, 0.0),
                self.sided.get(drawn.program),
            )
            for drawn in scenery
        )
        consts = self.consts | self.collection.chosen_consts
        added = additional_samples(
            self.quality, self.linear, "finished", redrawn, self._redrawn_overlays(), consts, self._waves
        )
        self.programs |= added.programs
        self.targets |= added.targets
        self.uniforms |= added.uniforms
        self.linear = "finished"
        return [*added.passes]

    def _redrawn_overlays(self) -> tuple[Redrawn, ...]:
        """Return the overlays as they are drawn again for selected pixels."""
        return tuple(
            Redrawn(
                drawn,
                tuple(self._pieces(spec.fragment if drawn.program == spec.program else spec.under)),
                sided=self.sided.get(drawn.program),
            )
            for spec in self._above
            for drawn in self._passes_of(spec)
        )


def _cleared(drawn: Pass) -> Pass:
    """Return the pass with its target cleared first."""
    return drawn.model_copy(update={"state": drawn.state.model_copy(update={"clear": True})})
