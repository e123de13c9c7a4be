"""What effects declare of their hard cases: some, with guards that stand where they are said to."""

import re
from pathlib import Path

import pytest

import seafoam
from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect
from seafoam.planner import make_plan
from seafoam.planner.glsl import read_file
from support.cases import HardCase, cases_of
from support.exact import EXACT
from support.hard_cases import CASES, QUALITIES


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_every_effect_has_hard_cases(effect: Effect) -> None:
    assert cases_of(effect).hard, f"{effect.name} declares no hard case"
    for case in cases_of(effect).hard:
        assert case.guard
        assert case.without
        assert case.times
        assert effect.contribute(case.scene, EXACT) is not None, f"{case.name} does not call for it"


@pytest.mark.parametrize(("effect", "case"), CASES)
def test_guards_stand_where_they_are_said_to(effect: Effect, case: HardCase) -> None:
    """Files that a guard names exist, and a shader among them is drawn: a guard in another file guards nothing here."""
    named = re.findall(r"[\w/]+\.(?:glsl(?:@\w+)?|py)", case.guard)
    for name in named:
        if name.endswith(".py"):
            assert any(Path(seafoam.__file__).parent.rglob(name)), f"no file {name}"
        else:
            assert read_file(name)
    if named and not any(name.endswith(".py") for name in named):
        plans = (make_plan(case.scene, quality) for quality in QUALITIES.values())
        shaders = (shader for plan in plans for one in plan.programs.values() for shader in (one.vertex, one.fragment))
        assert any(file.path in named for shader in shaders for file in shader.files), f"none of {named} is drawn"


def test_names_tell_cases_apart() -> None:
    names = [case.name for effect in EFFECTS for case in cases_of(effect).hard]
    assert len(set(names)) == len(names)
