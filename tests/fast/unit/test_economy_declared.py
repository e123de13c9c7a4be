"""What effects declare of when they cannot be seen."""

import pytest

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.water import Water
from support.cases import cases_of


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_every_effect_says_when_it_cannot_be_seen(effect: Effect) -> None:
    assert bool(cases_of(effect).invisible) != bool(cases_of(effect).always_visible)


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_a_bound_that_is_not_small_keeps_the_effect(effect: Effect) -> None:
    """Some preset shows each effect, so leaving it out is not the rule; what only visitors add, a variant shows."""
    finer = TIERS["standard"].model_copy(update={"foam_relief": True})
    scenes = [load_preset(name).scene for name in preset_names()]
    if effect.fields == ("/touches",):
        assert not any(scene.touches for scene in scenes)
        scenes = list(cases_of(effect).variants)
    plans = [make_plan(scene, finer) for scene in scenes]
    assert any(effect.name in {note.name for note in plan.effects} for plan in plans)


def test_a_field_that_a_bound_hangs_on_is_not_live() -> None:
    """Raising the exposure may bring back what the plan left out, so the page must ask for a new plan."""
    deep = make_plan(Scene(water=Water(depth=500.0)), TIERS["standard"])
    assert "floor" in {note.name for note in deep.skipped}
    assert "/light/exposure" not in deep.live
    assert "/light/visibility" in deep.live
