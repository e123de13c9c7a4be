"""The atlas that passes make of a mask is the one that Python makes, to the last bit."""

import numpy as np
import pytest

from seafoam.framegraph.passes import State
from seafoam.masks import load_catalogue
from seafoam.masks.families import SIZES
from seafoam.planner import AssemblyError, PlanError, link, make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.models import Scene
from seafoam.textures import MaskTexture, texture

CUSTOM = [f"blur:1:{size}:3" for size in SIZES if size < 512]


def scene(mask: str) -> Scene:
    return Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="filtered", mask=mask), light=None)


@pytest.mark.parametrize("mask", [*load_catalogue(), *CUSTOM])
def test_the_drawn_atlas_is_the_made_one(mask: str, executor: Executor) -> None:
    plan = make_plan(scene(mask), TIERS["standard"])
    executor.render(plan, time=0.0, camera=Camera(pitch=-1.0), width=16, height=9)
    framebuffer, *_ = executor._static.get(plan.kept["mask_atlas"])
    made = texture(MaskTexture(masks=(mask,), table="atlas"))
    drawn = np.frombuffer(framebuffer.read(components=2, dtype="u4", alignment=1), np.uint32)
    assert (framebuffer.width, framebuffer.height) == (made.width, made.height)
    assert np.array_equal(drawn, np.frombuffer(made.data, np.uint32))


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
