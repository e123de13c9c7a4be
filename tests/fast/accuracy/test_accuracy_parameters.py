"""Quality parameters and points: every field of the quality belongs to one, and what is measured has its own plan."""

import pytest
from pydantic import BaseModel, ValidationError

from seafoam.accuracy.points import (
    SPINE_KNOBS,
    all_parameters,
    chains,
    every_parameter,
    idealised,
    points_of,
    value_at,
    with_value,
)
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from support.sweep import spread


def fields(model: type[BaseModel], path: str = "") -> list[str]:
    found = []
    for name, info in model.model_fields.items():
        inner = info.annotation
        nested = isinstance(inner, type) and issubclass(inner, BaseModel)
        found += fields(inner, f"{path}/{name}") if nested else [f"{path}/{name}"]
    return found


def test_every_field_of_quality_is_covered_by_one_parameter_and_bad_values_are_refused():
    pointers = [parameter.pointer for _, parameter in every_parameter()]
    assert sorted(pointers) == sorted(fields(Quality))
    with pytest.raises(ValidationError):
        with_value(TIERS["standard"], "/surface/steps", 0)
    with pytest.raises(KeyError):
        with_value(TIERS["standard"], "/surface/nope", 0)


@pytest.mark.parametrize(
    "parameter", [parameter for _, parameter in every_parameter()], ids=lambda parameter: parameter.pointer
)
def test_steps_are_valid_qualities(parameter):
    made = [with_value(TIERS["standard"], parameter.pointer, step) for step in parameter.steps]
    assert len(set(made)) == len(made) >= 2
    assert [value_at(one, parameter.pointer) for one in made] == list(parameter.steps)
    assert TIERS["standard"] in made
    assert parameter.title


def test_effects_that_do_not_run_bring_no_parameters_and_no_points():
    assert {owner for owner, _ in all_parameters(Scene())} == {"frame"}
    assert len(all_parameters(Scene())) == len(SPINE_KNOBS)
    assert {owner for owner, _ in all_parameters(load_preset("default").scene)} > {"frame", "ripples", "foam look"}
    assert not [point for point in points_of(Scene()) if point.parameter and point.parameter.owner == "ripples"]


# Those of test_reports.py, which makes the same plans.
@pytest.mark.parametrize("preset", spread(preset_names(), 12, 4))
def test_points_have_plans_of_their_own(preset):
    scene = load_preset(preset).scene
    points = points_of(scene)
    # On level water without ripples no two qualities have one plan but for the width of pixels.
    tiers = [point.tier for point in points if point.tier]
    assert tiers == [tier for tier in TIERS if tier in tiers]
    assert len(tiers) == 4
    assert len({point.plan for point in points}) == len({point.id for point in points}) == len(points) > 6
    assert points[-1].plan == make_plan(scene, points[-1].quality).sha256
    for point in points:
        if point.parameter:
            assert point.quality == with_value(TIERS["standard"], point.parameter.pointer, point.parameter.value)
    names = {point.id for point in points}
    links = chains(scene, points)
    assert len(links) > 3
    for before, after, first, second in links:
        assert {first, second} <= names
        assert before.pointer == after.pointer
        assert first != second


def test_idealising_one_cause_leaves_the_others():
    made = idealised(TIERS["fast"], "filtering")
    assert made.samples == TIERS["reference"].samples
    assert made.surface.filter is TIERS["reference"].surface.filter
    assert made.surface.tolerance == TIERS["fast"].surface.tolerance
    assert made.target == TIERS["fast"].target
    for cause in ("geometry", "filtering", "precision"):
        made = idealised(made, cause)
    ideal = make_plan(load_preset("default").scene, made).sha256
    assert ideal == make_plan(load_preset("default").scene, TIERS["reference"]).sha256
