"""Touches of the water: what a scene accepts, what a plan is without them, and a list that changes within a plan."""

import json
from typing import Any

import pytest

from seafoam.effects.effect import PlanError
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.waves.rings import touch_set
from seafoam.scene import TOUCHES_MOST, Current, Ring, Scene, Touch, load_preset, preset_names
from support.sweep import spread

STANDARD = TIERS["standard"]
SOME = (Touch(place=(1.25, -7.5), time=2.0), Touch(place=(-3.0, -9.0), time=2.5, strength=0.1))
OTHERS = (
    Touch(place=(4.0, -2.0), time=-1.0, strength=0.3),
    Touch(place=(0.1, 0.2), time=1e6),
    Touch(place=(-1e7, 1e7), time=-1e9, strength=0.0),
)


def test_every_strength_is_a_ring() -> None:
    for strength in (0.0, 1e-4, 0.01, 0.5):
        ring = Touch(strength=strength).ring
        assert ring.life < 8.0
        assert ring.wavelength >= 0.05
        assert 2.0 * 3.1416 * ring.amplitude / ring.wavelength < 0.4


@pytest.mark.parametrize("preset", spread(preset_names(), 4))
def test_no_preset_has_touches_and_every_preset_takes_them(preset: str) -> None:
    """Untouched, no file or number of touches is in a plan; touched, all that was there still is."""
    scene = load_preset(preset).scene
    plain = make_plan(scene, STANDARD)
    assert b"u_touch" not in plain.canonical_json()
    assert b"TOUCH_" not in plain.canonical_json()
    try:
        touched = make_plan(scene.model_copy(update={"touches": SOME}), STANDARD)
    except PlanError as refused:
        raise AssertionError(f"{preset}: {refused}") from refused
    notes = {note.name for note in touched.effects}
    assert {note.name for note in plain.effects} <= notes
    if scene.light is None:
        assert "touch" in {note.name for note in touched.skipped}
        return
    assert "touch" in notes
    assert touched.live == tuple(sorted({*plain.live, "/touches"}))
    assert (touched.top, touched.bottom) == (plain.top, plain.bottom)
    assert len(touched.passes) == len(plain.passes)


def at(document: Any, pointer: str) -> Any:
    """The value at a JSON pointer; None where there is none."""
    for step in pointer.split("/")[1:]:
        if isinstance(document, list) and int(step) >= len(document):
            return None
        document = document[int(step) if isinstance(document, list) else step]
    return document


def patched(plan: FramePlan, scene: Scene) -> Any:
    """The plan as a client draws it for another list of touches."""
    document, of = json.loads(plan.canonical_json()), scene.model_dump(mode="json")
    for rule in document["uniforms"]["u_touch"]["rules"]:
        if rule["rule"] == "constant":
            value = at(of, rule["field"])
            rule["value"] = rule["absent"] if value is None else [value]
        elif all(at(of, term["field"]) is not None for term in rule["terms"]):
            rule["offset"] = sum(term["factor"] * at(of, term["field"]) for term in rule["terms"])
    return document


@pytest.mark.parametrize("current", [None, Current(speed=2.0, direction=0.7)], ids=["still", "river"])
@pytest.mark.parametrize(("before", "after"), [(SOME, OTHERS), (OTHERS, SOME), (SOME, ()), (SOME[:1], SOME * 12)])
def test_another_list_of_touches_is_the_same_plan_with_other_numbers(
    before: tuple[Touch, ...], after: tuple[Touch, ...], current: Current | None
) -> None:
    scene = Scene(current=current, touches=after)
    drawn = patched(make_plan(Scene(current=current, touches=before), STANDARD), scene)
    if not after:
        # A plan without touches has none of their shader; the one at hand draws none.
        assert all(rule["value"] == [0.0] for rule in drawn["uniforms"]["u_touch"]["rules"] if "value" in rule)
        return
    asked = json.loads(make_plan(scene, STANDARD).canonical_json())
    assert len(asked["uniforms"]["u_touch"]["rules"]) == 4 * TOUCHES_MOST
    for document in (drawn, asked):
        for rule in document["uniforms"]["u_touch"]["rules"]:
            # Where nothing was touched, only the strength counts.
            if rule["rule"] == "clamp" and _beyond(rule, len(after)):
                del rule["offset"]
    assert drawn == asked


def _beyond(rule: Any, count: int) -> bool:
    return int(rule["terms"][0]["field"].split("/")[2]) >= count


def test_a_river_carries_a_ring_of_a_touch_and_none_of_a_blast() -> None:
    scene = Scene(current=Current(speed=2.0), touches=(Touch(place=(3.0, -4.0), time=1e6),))
    (young,) = touch_set(scene, 1e6 + 0.001, (0.0, 0.0)).rings
    (older,) = touch_set(scene, 1e6 + 2.0, (1.0, 0.0)).rings
    assert (young.x, young.z) == pytest.approx((3.002, -4.0))
    assert (older.x, older.z) == pytest.approx((6.0, -4.0))
    assert touch_set(scene, 1e6 - 1.0, (0.0, 0.0)).rings == ()
    with pytest.raises(PlanError, match="rings cannot be combined with a current"):
        make_plan(Scene(current=Current(), rings=(Ring(),), touches=SOME), STANDARD)
