"""Plans whose masks are drawn: what they load, and what states their passes need."""

import pytest

from seafoam.framegraph.passes import State
from seafoam.planner import AssemblyError, PlanError, link, make_plan
from seafoam.quality import TIERS
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.models import Scene


def scene(mask: str) -> Scene:
    return Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="filtered", mask=mask), light=None)


def test_a_scene_with_the_look_loads_the_mask_and_not_the_atlas() -> None:
    plan = make_plan(scene("vac-24"), TIERS["standard"])
    assert {one.url for one in plan.textures.values()} == {
        "/api/textures/mask/vac-24/ranks",
        "/api/textures/mask/vac-24/quantiles",
    }
    made = [one for one in plan.passes if one.name.startswith("mask: ")]
    assert {one.when for one in made} == {"setup"}
    assert plan.kept.keys() == {"mask_atlas"}
    other = make_plan(scene("vac-12"), TIERS["standard"])
    assert other.kept != plan.kept


@pytest.mark.parametrize("state", [State(clear=True), State(blend="add"), State(depth=True)])
def test_whole_numbers_are_not_cleared_blended_or_tested(state: State) -> None:
    plan = make_plan(scene("vac-24"), TIERS["standard"])
    (atlas,) = [one for one in plan.passes if one.name == "mask: atlas"]
    link.refuse_integers(atlas, plan.targets)
    with pytest.raises(AssemblyError, match="integers"):
        link.refuse_integers(atlas.model_copy(update={"state": state}), plan.targets)


def test_a_mask_that_cannot_be_made_names_its_field() -> None:
    with pytest.raises(PlanError) as caught:
        make_plan(scene("blur:1:100:3"), TIERS["standard"])
    assert caught.value.pointer == "/foam/mask"
