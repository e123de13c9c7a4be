"""What test scenes of effects declare: hard cases whose guards stand where they are said to, and when nothing shows."""

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

import seafoam
from seafoam.effects import EFFECTS
from seafoam.planner import make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.water import Water
from support.cases import HardCase, cases_of
from support.exact import EXACT
from support.hard.cases import HARD, QUALITIES


def test_every_effect_has_hard_cases_and_says_when_it_cannot_be_seen() -> None:
    for effect in EFFECTS:
        found = cases_of(effect)
        assert found.hard, f"{effect.name} declares no hard case"
        assert bool(found.invisible) != bool(found.always_visible), effect.name
    for effect, case in HARD:
        assert all((case.guard, case.times)), case.name
        assert effect.contribute(case.scene, EXACT) is not None, f"{case.name} does not call for {effect.name}"
    assert not [one.name for (_, one), (_, other) in combinations(HARD, 2) if one.name == other.name]


def misplaced(case: HardCase) -> Iterator[str]:
    """What is not so of the files that a guard names: a guard in a shader that is not drawn guards nothing."""
    named = re.findall(r"[\w/]+\.(?:glsl(?:@\w+)?|py)", case.guard)
    modules = [name for name in named if name.endswith(".py")]
    for name in modules:
        if not any(Path(seafoam.__file__).parent.rglob(name)):
            yield f"{case.name}: no file {name}"
    for name in set(named) - set(modules):
        assert read_file(name)
    if named and not modules:
        plans = (make_plan(case.scene, quality) for quality in QUALITIES.values())
        shaders = (shader for plan in plans for one in plan.programs.values() for shader in (one.vertex, one.fragment))
        if not any(file.path in named for shader in shaders for file in shader.files):
            yield f"{case.name}: none of {named} is drawn"


def test_guards_stand_where_they_are_said_to() -> None:
    assert [fault for _, case in HARD for fault in misplaced(case)] == []


def test_a_bound_that_is_not_small_keeps_the_effect_and_what_it_hangs_on_is_not_live() -> None:
    """Some preset shows each effect, so leaving it out is not the rule; what only visitors add, a variant shows."""
    finer = TIERS["standard"].model_copy(update={"foam_relief": True})
    scenes = [load_preset(name).scene for name in preset_names()]
    assert not any(scene.touches for scene in scenes)
    for effect in EFFECTS:
        if effect.fields == ("/touches",):
            scenes += cases_of(effect).variants
    shown = {note.name for scene in scenes for note in make_plan(scene, finer).effects}
    assert {effect.name for effect in EFFECTS} <= shown
    # Raising the exposure may bring back what the plan left out, so the page must ask for a new plan.
    deep = make_plan(Scene(water=Water(depth=500.0)), TIERS["standard"])
    assert "floor" in {note.name for note in deep.skipped}
    assert "/light/exposure" not in deep.live
    assert "/light/visibility" in deep.live
