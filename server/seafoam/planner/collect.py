"""The contributions of a scene's effects to its plan, and which effects are left out."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from seafoam.effects.effect import Contribution, Effect, Resources
from seafoam.effects.shader import SlotFile, path_of
from seafoam.framegraph.plan import EffectNote
from seafoam.framegraph.rules import afloat
from seafoam.quality import Quality
from seafoam.scene import Scene
from seafoam.sums import summed

NEGLIGIBLE = 0.5 / 255.0
"""Half a level of exposed linear light: effects that change all pixels by less are left out."""
LOWEST = -100.0
"""Lowest camera height without a floor, m: nothing more is visible below."""
_SUMMED, _GREATEST = ("max_height", "min_height", "max_slope", "map_error"), ("march_factor", "refine", "coarser")
"""Numbers of contributions that add up, and those of which the greatest counts."""


@dataclass(frozen=True, kw_only=True)
class Collection(Contribution):
    """The contributions of all effects of a scene, as one."""

    why: str = ""
    scene: Scene
    """Without the parts of effects that are left out."""
    effects: tuple[EffectNote, ...]
    skipped: tuple[EffectNote, ...]
    bound_fields: frozenset[str]
    """Live fields that the bounds of effects left out depend on."""
    bounds: tuple[float, float, float]
    """Upper bounds of height, slope and curvature of the effects that do not measure their own."""
    min_ground: float

    def fills(self, slot: str) -> bool:
        """Whether a file fills the slot."""
        return any(file.slot == slot for file in self.slots)


def collect(effects: Sequence[Effect], scene: Scene, quality: Quality) -> Collection:
    """Return what a scene's effects contribute, without those whose bound is below :data:`NEGLIGIBLE`."""
    whole, left_out = scene, _LeftOut()
    for effect in effects:
        if effect.without is not None and left_out.takes(effect, effect.contribute(scene, quality)):
            scene = effect.without(scene)
    given: list[tuple[str, Contribution]] = []
    for effect in effects:
        contribution = effect.contribute(scene, quality)
        if contribution is None and scene is not whole:
            left_out.takes_with_others(effect, effect.contribute(whole, quality))
        elif contribution is not None and not left_out.takes(effect, contribution):
            given.append((effect.name, _afloat(contribution, effect, whole)))
    return _joined(given, scene, left_out)


@dataclass
class _LeftOut:
    """Effects that are left out, by name, and the live fields that this depends on."""

    notes: dict[str, EffectNote] = field(default_factory=dict)
    fields: set[str] = field(default_factory=set)

    def takes(self, effect: Effect, contribution: Contribution | None) -> bool:
        """Whether an effect changes too little to be drawn, which is then noted."""
        bound = None if contribution is None else contribution.bound
        if bound is None or bound.value >= NEGLIGIBLE:
            return False
        self.notes[effect.name] = EffectNote(name=effect.name, why=bound.why, bound=bound.value)
        self.fields.update(bound.fields)
        return True

    def takes_with_others(self, effect: Effect, contribution: Contribution | None) -> None:
        """Note an effect that is gone with one that was left out. ``contribution``: to the whole scene."""
        if contribution is not None and effect.name not in self.notes and not self.takes(effect, contribution):
            note = EffectNote(name=effect.name, why="it belongs to what is left out", bound=0.0)
            self.notes[effect.name] = note


def _joined(given: Sequence[tuple[str, Contribution]], scene: Scene, left_out: _LeftOut) -> Collection:
    """The contributions of effects, with their names, as one. Raises :class:`AssemblyError` if two differ."""
    every, slots = [one for _, one in given], list[SlotFile]()
    for one in every:
        replaced = {file.slot for file in one.slots if file.instead}
        slots = [*(file for file in slots if file.slot not in replaced), *one.slots]
    bounded = [one for one in every if not any(file.slot == "bounds" for file in one.slots)]
    grounds = [one.min_ground for one in every if one.min_ground is not None]
    numbers: dict[str, Any] = {name: summed(getattr(one, name) for one in every) for name in _SUMMED}
    numbers |= {name: max(getattr(one, name) for one in (Contribution(why=""), *every)) for name in _GREATEST}
    return Collection(
        **numbers,
        **vars(replace(Resources().joined(*every), slots=tuple(slots))),
        scene=scene,
        effects=tuple(EffectNote(name=name, why=one.why, files=_files(one)) for name, one in given),
        skipped=tuple(left_out.notes.values()),
        bound_fields=frozenset(left_out.fields).union(*(one.depends for one in every)),
        bounds=(
            summed(one.max_height for one in bounded),
            summed(one.max_slope for one in bounded),
            summed(one.max_curvature for one in bounded),
        ),
        min_ground=grounds[-1] if grounds else LOWEST,
    )


def _files(contribution: Contribution) -> tuple[str, ...]:
    """The files of ``shaders/`` that an effect names, but for those of passes under water."""
    pieces = [piece for file in contribution.slots for piece in (*file.needs, file.path)]
    paths = {path_of(piece) for piece in pieces}
    paths |= {path_of(piece) for spec in contribution.passes for piece in (*spec.vertex, *spec.fragment)}
    return tuple(sorted(path for path in paths if path is not None))


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
