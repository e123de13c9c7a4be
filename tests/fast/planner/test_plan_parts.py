"""What parts of a scene and of a quality bring to a plan: shores, masks that are drawn, chosen pixels."""

from typing import Any

import pytest

from seafoam.framegraph.passes import State
from seafoam.framegraph.resources import Target, ViewportSize
from seafoam.planner import AssemblyError, link, make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene.foam import Foam, HeightSaturation, SurfSaturation
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.water import Water
from seafoam.scene.waves import ParametricWave
from support.sweep import spread

STANDARD = TIERS["standard"]


def test_without_a_coast_in_reach_the_shore_is_left_out() -> None:
    plan = make_plan(Scene(waves=(ParametricWave(),), shore=Shore(level=-900.0)), STANDARD)
    assert {note.name for note in plan.skipped} >= {"shore"}
    assert not [one for one in plan.passes if one.name.startswith("shore")]
    assert "shore" not in plan.programs["surface"].fragment.text
    # A bank that waves feel stays, and so does one that is seen.
    for level in (-4.0, -30.0):
        near = make_plan(Scene(shore=Shore(level=level)), STANDARD)
        assert "shore" in {note.name for note in near.effects}


def test_surf_foam_needs_surf_and_a_shore_has_a_floor_of_its_own() -> None:
    foam = Foam(saturation=(SurfSaturation(),))
    for scene in (Scene(foam=foam), Scene(foam=foam, shore=Shore(surf=Surf(height=0.0)))):
        assert {"surf foam", "foam look"} <= {note.name for note in make_plan(scene, STANDARD).skipped}
    both = make_plan(Scene(foam=foam, shore=Shore()), STANDARD)
    assert {"surf foam", "foam look"} <= {note.name for note in both.effects}
    plan = make_plan(Scene(shore=Shore(), water=Water(depth=3.0)), STANDARD)
    assert "floor" not in {note.name for note in (*plan.effects, *plan.skipped)}


def masked(mask: str) -> Scene:
    return Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="filtered", mask=mask), light=None)


def test_a_scene_with_the_look_loads_the_mask_and_not_the_atlas() -> None:
    plan = make_plan(masked("vac-24"), STANDARD)
    assert {one.url for one in plan.textures.values()} == {
        "/api/textures/mask/vac-24/ranks",
        "/api/textures/mask/vac-24/quantiles",
    }
    made = [one for one in plan.passes if one.name.startswith("mask: ")]
    assert {one.when for one in made} == {"setup"}
    assert plan.kept.keys() == {"mask_atlas"}
    other = make_plan(masked("vac-12"), STANDARD)
    assert other.kept != plan.kept


@pytest.mark.parametrize("more", [{"depth": True}, {"filter": "linear_mipmap_linear"}])
def test_a_target_with_layers_has_neither_depth_nor_mip_levels(more: dict[str, Any]) -> None:
    plain = {"size": ViewportSize(), "format": "RGBA16F"}
    Target(**plain, layers=4)
    Target(**plain, **more)
    with pytest.raises(ValueError, match="layers"):
        Target(**plain, **more, layers=2)


def test_whole_numbers_are_not_cleared_blended_or_tested() -> None:
    plan = make_plan(masked("vac-24"), STANDARD)
    (atlas,) = [one for one in plan.passes if one.name == "mask: atlas"]
    link.refuse_integers(atlas, plan.targets)
    for state in (State(clear=True), State(blend="add"), State(depth=True)):
        with pytest.raises(AssemblyError, match="integers"):
            link.refuse_integers(atlas.model_copy(update={"state": state}), plan.targets)


def chosen(**changes: int) -> Quality:
    return STANDARD.model_copy(update=changes)


@pytest.mark.parametrize("preset", spread(preset_names(), 8))
def test_no_target_is_larger_than_four_pictures(preset: str) -> None:
    for most in (4, 16):
        scene = load_preset(preset).scene
        plan = make_plan(scene, chosen(samples_max=most))
        scales = [one.size.scale for one in plan.targets.values() if isinstance(one.size, ViewportSize)]
        # Without light a sample costs less than its choice.
        assert max(scales) == (1 if scene.light is None else 2)


def test_kinds_of_choice_and_fewer_samples_are_none() -> None:
    scene = load_preset("default").scene
    assert make_plan(scene, chosen(samples=16, samples_max=16)) == make_plan(scene, chosen(samples=16))
    for samples, most, kinds in ((1, 1, ()), (1, 4, (4,)), (1, 16, (4, 16)), (4, 16, (16,))):
        how = chosen(samples=samples, samples_max=most)
        assert how.chosen_samples == kinds
        names = {one.name for one in make_plan(load_preset("default").scene, how).passes}
        assert {f"surface, {count} samples" for count in kinds} <= names
        assert ("contrast" in names) == bool(kinds)


@pytest.mark.parametrize(
    ("preset", "asked", "drawn"),
    [
        ("default", 2, 2),
        ("default", 4, 4),
        ("boat-race", 4, 3),
        ("spray-on-rocks", 4, 3),
        ("storm", 4, 4),
        ("pool-caustics", 4, 1),
        ("drift-vortices", 4, 2),
        ("lake-calm", 2, 1),
        ("lake-calm", 4, 2),
        ("lake-sunset", 4, 4),
    ],
)
def test_pixels_are_less_wide_where_rows_have_detail(preset: str, asked: int, drawn: int) -> None:
    scene = load_preset(preset).scene
    assert make_plan(scene, chosen(pixel_width=asked)).targets["samples"].size == ViewportSize(narrow=drawn)
    several = make_plan(scene, chosen(pixel_width=asked, samples=4))
    assert several == make_plan(scene, chosen(pixel_width=1, samples=4))
