"""What a shore brings to a plan, and that nothing of it is there without one."""

import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.foam import Foam, SurfSaturation
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.water import Water
from seafoam.scene.waves import ParametricWave

STANDARD = TIERS["standard"]


@pytest.mark.parametrize("preset", [name for name in preset_names() if load_preset(name).scene.shore is None])
@pytest.mark.parametrize("tier", TIERS)
def test_a_scene_without_a_shore_has_nothing_of_it(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene, TIERS[tier])  # type: ignore[index]
    assert "shore" not in plan.canonical_json().decode().lower()


def test_a_shore_draws_its_map_before_the_sea() -> None:
    plan = make_plan(Scene(shore=Shore()), STANDARD)
    names = [one.name for one in plan.passes]
    drawn = [name for name in names if name.startswith("shore")]
    steps = [name for name in drawn if "flood" in name]
    assert [int(name.split()[-2]) for name in steps] == [1, 128, 64, 32, 16, 8, 4, 2, 1]
    assert drawn[:3] == ["shore: highest land", "shore: highest land around", "shore: seed"]
    assert drawn[-1] == "shore: map"
    assert names.index("shore: map") < names.index("surface")
    assert plan.targets["shore_map"].format == "RGBA32F"


def test_the_map_is_as_large_as_the_quality_says() -> None:
    quality = STANDARD.model_copy(update={"shore_map": 64, "shore_floor": 128, "shore_profile": 32})
    plan = make_plan(Scene(shore=Shore()), quality)
    assert plan.targets["shore_map"].size.width == 64  # type: ignore[union-attr]
    assert plan.textures["shore_floor"].width == 128
    assert plan.textures["shore_profiles"].width == 32


def test_without_a_coast_in_reach_the_shore_is_left_out() -> None:
    plan = make_plan(Scene(waves=(ParametricWave(),), shore=Shore(level=-900.0)), STANDARD)
    assert {note.name for note in plan.skipped} >= {"shore"}
    assert not [one for one in plan.passes if one.name.startswith("shore")]
    assert "shore" not in plan.programs["surface"].fragment.text
    # A bank that waves feel stays, and so does one that is seen.
    for level in (-4.0, -30.0):
        near = make_plan(Scene(shore=Shore(level=level)), STANDARD)
        assert "shore" in {note.name for note in near.effects}


def test_surf_foam_needs_surf() -> None:
    foam = Foam(saturation=(SurfSaturation(),))
    for scene in (Scene(foam=foam), Scene(foam=foam, shore=Shore(surf=Surf(height=0.0)))):
        assert {"surf foam", "foam look"} <= {note.name for note in make_plan(scene, STANDARD).skipped}
    both = make_plan(Scene(foam=foam, shore=Shore()), STANDARD)
    assert {"surf foam", "foam look"} <= {note.name for note in both.effects}


def test_a_shore_has_a_floor_of_its_own() -> None:
    plan = make_plan(Scene(shore=Shore(), water=Water(depth=3.0)), STANDARD)
    assert "floor" not in {note.name for note in (*plan.effects, *plan.skipped)}
