"""Each effect alone: it can be switched on in the default scene, and switched off nothing of it is left in the plan."""

import json
from functools import reduce
from operator import getitem
from typing import Any

import pytest
from bench.drawn import isolation
from bench.drawn.isolation import Switch, running, switch

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect
from seafoam.planner import make_plan, planner
from seafoam.quality import TIERS, Quality
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from support.cases import cases_of

STANDARD = TIERS["standard"].model_copy(update={"foam_relief": True})
"""Draws all effects: shades of foam are of the finer tiers."""
DEFAULT = load_preset("default").scene


@pytest.fixture(scope="module")
def switches() -> dict[str, Switch | None]:
    return {effect.name: switch(effect, DEFAULT, STANDARD) for effect in EFFECTS}


def without(monkeypatch: pytest.MonkeyPatch, scene: Scene, effect: Effect, quality: Quality = STANDARD) -> bytes:
    """The scene's plan by a planner that has never heard of the effect."""
    others = tuple(one for one in EFFECTS if one.name != effect.name)
    with monkeypatch.context() as patched:
        patched.setattr(planner, "EFFECTS", others)
        # Past the cache, which does not know which effects there were.
        return make_plan.__wrapped__(scene, quality).canonical_json()


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_every_effect_has_a_switch_in_the_default_scene(effect: Effect, switches: dict[str, Switch | None]) -> None:
    found = switches[effect.name]
    assert found is not None, f"no preset and no hard case has fields that switch {effect.name} on there"
    assert effect.name in running(found.on, STANDARD)
    assert effect.name not in running(found.off, STANDARD)
    assert found.on == DEFAULT if found.given else (found.off == DEFAULT) == (not found.needs)
    assert found.on.camera == found.off.camera
    assert effect.name in {note.name for note in make_plan(found.on, STANDARD).effects}
    assert found.fields


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_switched_off_a_plan_is_that_of_a_scene_that_never_named_it(
    monkeypatch: pytest.MonkeyPatch, effect: Effect, switches: dict[str, Switch | None]
) -> None:
    """Byte for byte: on, off again in JSON as a page would send it, and by a planner without the effect."""
    found = switches[effect.name]
    plan = make_plan(found.off, STANDARD)
    if effect.name in {note.name for note in plan.skipped}:
        # The scene still names what it shows, and a bound leaves it out.
        assert _but_for_notes(plan.canonical_json()) == _but_for_notes(without(monkeypatch, found.off, effect))
        return
    on, off = (one.model_dump(mode="json") for one in (found.on, found.off))
    for pointer in found.fields:
        _put(on, pointer, _got(off, pointer))
    again = Scene.model_validate(json.loads(json.dumps(on)))
    assert make_plan(found.on, STANDARD).canonical_json() != plan.canonical_json()
    assert make_plan(again, STANDARD).canonical_json() == plan.canonical_json()
    never = Scene.model_validate(_named(off))
    assert make_plan.__wrapped__(never, STANDARD).canonical_json() == plan.canonical_json()
    for quality in (TIERS["fast"], STANDARD):
        assert without(monkeypatch, found.off, effect, quality) == make_plan(found.off, quality).canonical_json()


def test_what_a_bound_leaves_out_leaves_a_note_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scenes that name an effect and cannot show it: but for the note, the plan of a planner without it."""
    compared = 0
    for effect in EFFECTS:
        for scene in cases_of(effect).invisible:
            lean = make_plan(scene, STANDARD)
            if {note.name for note in lean.skipped} == {effect.name}:
                other = without(monkeypatch, scene, effect)
                assert _but_for_notes(lean.canonical_json()) == _but_for_notes(other), effect.name
                compared += 1
    assert compared > 5


def test_fields_that_are_not_scenes_do_not_stop_the_search() -> None:
    assert isolation.switch(EFFECTS[0], Scene(), STANDARD) is not None


def _but_for_notes(plan: bytes) -> Any:
    """A plan without its notes of what is left out, and without the fields that those take out of the live ones."""
    return {**json.loads(plan), "skipped": [], "live": []}


def _got(document: Any, pointer: str) -> Any:
    return reduce(getitem, pointer.split("/")[1:], document)


def _put(document: Any, pointer: str, value: Any) -> None:
    above, _, last = pointer.rpartition("/")
    _got(document, above)[last] = value


def _named(document: dict[str, Any]) -> dict[str, Any]:
    """The scene without what is absent, anywhere in it; no light has to be named, since there is one otherwise."""

    def bare(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: bare(held) for name, held in value.items() if held is not None or name == "light"}
        return [bare(item) for item in value] if isinstance(value, list) else value

    named: dict[str, Any] = bare(document)
    return {name: held for name, held in named.items() if held != []}
