"""Plans of chosen pixels: their kinds, and the size of their targets."""

import pytest

from seafoam.framegraph.resources import ViewportSize
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene.presets import load_preset, preset_names

STANDARD = TIERS["standard"]


def quality(base: Quality = STANDARD, **changes: object) -> Quality:
    return base.model_copy(update=changes)


def test_no_target_is_larger_than_four_pictures() -> None:
    for preset in preset_names():
        for most in (4, 16):
            scene = load_preset(preset).scene
            plan = make_plan(scene, quality(samples_max=most))
            scales = [one.size.scale for one in plan.targets.values() if isinstance(one.size, ViewportSize)]
            # Without light a sample costs less than its choice.
            assert max(scales) == (1 if scene.light is None else 2)


@pytest.mark.parametrize(("samples", "most", "kinds"), [(1, 1, ()), (1, 4, (4,)), (1, 16, (4, 16)), (4, 16, (16,))])
def test_kinds_of_choice(samples: int, most: int, kinds: tuple[int, ...]) -> None:
    how = quality(samples=samples, samples_max=most)
    assert how.chosen_samples == kinds
    names = {one.name for one in make_plan(load_preset("default").scene, how).passes}
    assert {f"surface, {count} samples" in names for count in kinds} <= {True}
    assert ("contrast" in names) == bool(kinds)


def test_more_samples_than_the_greatest_number_are_no_choice() -> None:
    scene = load_preset("default").scene
    assert make_plan(scene, quality(samples=16, samples_max=16)) == make_plan(scene, quality(samples=16))
