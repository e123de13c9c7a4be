"""The contributions of a scene's effects to its plan."""

from collections.abc import Sequence
from dataclasses import replace

from seafoam.effects.effect import AssemblyError, Contribution, Effect, PassSpec, TextureUse, united
from seafoam.effects.shader import Const, Piece, SlotFile, SlotRef, path_of
from seafoam.framegraph.plan import EffectNote
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, TextureInput, ViewportSize
from seafoam.framegraph.rules import Uniform, afloat
from seafoam.planner.glsl import COMMON
from seafoam.quality import Quality
from seafoam.scene.models import Scene

NEGLIGIBLE = 0.5 / 255.0
"""Half a level of exposed linear light: effects that change all pixels by less are left out."""

START_TILE = 4
"""Side of the tiles of pixels whose rays share a start distance."""

WIDE_TILE = 16
"""Side of the tiles from whose start distances these are searched, where a search costs much."""

LOWEST = -100.0
"""Lowest camera height without a floor, m: nothing more is visible below."""


class Collection:
    """The joined contributions of a scene's effects.

    ``economy``: leave out effects whose bound is below :data:`NEGLIGIBLE`. ``scene``: without the parts of those.
    """

    def __init__(self, effects: Sequence[Effect], scene: Scene, quality: Quality, *, economy: bool) -> None:
        self.effects: list[EffectNote] = []
        self.skipped: list[EffectNote] = []
        self.slots: list[SlotFile] = []
        self.consts: dict[str, Const] = {}
        self.chosen_consts: dict[str, Const] = {}
        self.uniforms: dict[str, Uniform] = {}
        self.inputs: dict[str, TextureInput | TargetInput] = {}
        self.textures: dict[str, TextureUse] = {}
        self.targets: dict[str, Target] = {}
        self.passes: list[PassSpec] = []
        self.max_height = 0.0
        self.min_height = 0.0
        self.map_error = 0.0
        self.max_slope = 0.0
        self.bounds = [0.0, 0.0, 0.0]
        """Upper bounds of height, slope and curvature of the effects that do not measure their own."""
        self.min_ground = LOWEST
        self.march_factor = 1
        self.bound_fields: set[str] = set()
        self.readers: dict[str, str] = {}
        """Sampler -> name of the effect that adds it."""
        self.scene = scene
        if economy:
            for effect in effects:
                if effect.without is not None and self._skip(effect, effect.contribute(self.scene, quality)):
                    self.scene = effect.without(self.scene)
        for effect in effects:
            contribution = effect.contribute(self.scene, quality)
            if contribution is None and self.scene is not scene:
                self._drop(effect, effect.contribute(scene, quality))
            elif contribution is not None and not (economy and self._skip(effect, contribution)):
                self._add(effect.name, _afloat(contribution, effect, scene))

    def fills(self, slot: str) -> bool:
        """Whether an effect fills the slot."""
        return any(file.slot == slot for file in self.slots)

    def _skip(self, effect: Effect, contribution: Contribution | None) -> bool:
        """Whether an effect changes too little to be drawn, which is then noted."""
        bound = None if contribution is None else contribution.bound
        if bound is None or bound.value >= NEGLIGIBLE:
            return False
        self.skipped.append(EffectNote(name=effect.name, why=bound.why, bound=bound.value))
        self.bound_fields.update(bound.fields)
        return True

    def _drop(self, effect: Effect, contribution: Contribution | None) -> None:
        """Note an effect that is gone with one that was left out."""
        known = contribution is None or any(note.name == effect.name for note in self.skipped)
        if not known and not self._skip(effect, contribution):
            self.skipped.append(EffectNote(name=effect.name, why="it belongs to what is left out", bound=0.0))

    def _add(self, name: str, contribution: Contribution) -> None:
        pieces = [piece for file in contribution.slots for piece in (*file.needs, file.path)]
        pieces += [piece for spec in contribution.passes for piece in (*spec.vertex, *spec.fragment)]  # type: ignore[misc]
        paths = {path for path in map(path_of, pieces) if path is not None}
        self.effects.append(EffectNote(name=name, why=contribution.why, files=tuple(sorted(paths))))
        self.readers |= dict.fromkeys(contribution.inputs, name)
        replaced = {file.slot for file in contribution.slots if file.instead}
        self.slots = [file for file in self.slots if file.slot not in replaced] + [*contribution.slots]
        self.passes += contribution.passes
        self.max_height += contribution.max_height
        self.min_height += contribution.min_height
        self.map_error += contribution.map_error
        self.max_slope += contribution.max_slope
        if not any(file.slot == "bounds" for file in contribution.slots):
            bounds = (contribution.max_height, contribution.max_slope, contribution.max_curvature)
            self.bounds = [a + b for a, b in zip(self.bounds, bounds, strict=True)]
        if contribution.min_ground is not None:
            self.min_ground = contribution.min_ground
        self.march_factor = max(self.march_factor, contribution.march_factor)
        try:
            self.consts = united((self.consts, contribution.consts))
            self.chosen_consts = united((self.chosen_consts, contribution.chosen_consts))
            self.uniforms = united((self.uniforms, contribution.uniforms))
            self.inputs = united((self.inputs, contribution.inputs))
            self.textures = united((self.textures, contribution.textures))
            self.targets = united((self.targets, contribution.targets))
        except AssemblyError as error:
            raise AssemblyError(f"effect {name}: {error}") from None

    def add_starts(self, side: int) -> None:
        """Add the pass that finds the start distances to water and land of the rays of each tile of the picture.

        ``side``: samples along each side of a pixel.
        """
        waves, bounds = SlotRef("waves"), SlotRef("bounds")
        self.targets["start"] = Target(size=ViewportSize(scale=side, part=START_TILE), format="RGBA16F")
        self.inputs["u_start"] = TargetInput(target="start")
        if self.fills("bounds"):
            self.targets["surface_now"] = Target(size=FixedSize.square(1), format="RGBA16F")
            self.inputs["u_surface_now"] = TargetInput(target="surface_now")
            self.slots.append(SlotFile("now", "surface/bounds.glsl@now_measured"))
            self.passes.append(
                PassSpec(
                    name="bounds of the surface",
                    program="surface_now",
                    fragment=(*COMMON, waves, bounds, SlotRef("short bounds"), "surface/bounds.glsl@now_pass"),
                    target="surface_now",
                )
            )
        search = (*COMMON, waves, SlotRef("beyond"), bounds, SlotRef("start"))
        known: Piece = "surface/start.glsl@start_anew"
        # Maps that are measured in every frame are steep and searched in many steps: first for wider tiles.
        if self.fills("bounds"):
            wide = Target(size=ViewportSize(scale=side, part=WIDE_TILE), format="RGBA16F")
            self.targets["start, wide"] = wide
            self.passes.append(
                PassSpec(
                    name="where wide beams of rays begin",
                    program="start, wide",
                    fragment=(*search, known, "surface/start.glsl@pass"),
                    target="start, wide",
                )
            )
            known = "surface/start.glsl@start_within"
        self.passes.append(
            PassSpec(
                name="where rays begin",
                program="start",
                fragment=(*search, known, "surface/start.glsl@pass"),
                target="start",
                inputs={"u_start_wide": TargetInput(target="start, wide")} if self.fills("bounds") else {},
            )
        )


def _afloat(contribution: Contribution, effect: Effect, scene: Scene) -> Contribution:
    """The contribution with what of it floats carried by the scene's current."""
    velocity = (0.0, 0.0) if scene.current is None else scene.current.velocity
    if velocity == (0.0, 0.0):
        return contribution
    uniforms = {
        name: afloat(uniform, velocity) if name in effect.afloat else uniform
        for name, uniform in contribution.uniforms.items()
    }
    return replace(contribution, uniforms=uniforms)
