"""What the bench compares draws the same: programs written by hand, and the one that holds every effect."""

from pathlib import Path

import bench
import pytest
from bench.drawn.economy import QUALITY, ByHand, by_hand, same_picture, with_surface
from bench.drawn.steps import steps
from bench.drawn.uber import uber_plan

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.scenes import load_preset

MINIMAL = Path(bench.__file__).with_name("minimal")


@pytest.mark.parametrize("case", by_hand(), ids=lambda case: case.name)
def test_programs_by_hand_draw_what_the_plan_draws(executor: Executor, case: ByHand) -> None:
    """Else the bench would compare two pictures; it raises there, and so does this."""
    plan = make_plan(case.scene, QUALITY)
    other = with_surface(plan, (MINIMAL / case.file).read_text(encoding="utf-8"))
    same_picture(executor, plan, other, case.scene.camera)


@pytest.mark.parametrize("name", ["default", "paper-threshold"])
def test_the_program_with_every_effect_draws_what_the_plan_draws(executor: Executor, name: str) -> None:
    scene = load_preset(name).scene
    # Groups, what becomes of foam, light in it, clouds and glare are none of the paper's effects.
    foam = scene.foam.lying_still().model_copy(update={"scattering": None})
    light = scene.light and scene.light.model_copy(update={"sky": None, "glare": 0.0})
    scene = scene.model_copy(update={"foam": foam, "light": light, "wave_groups": None})
    same_picture(executor, uber_plan(scene, QUALITY), make_plan(scene, QUALITY), scene.camera)


@pytest.mark.parametrize("name", ["default", "beach"])
def test_evaluations_of_waves_are_counted(executor: Executor, name: str) -> None:
    """A pixel of water takes at least one, and better tiers take more where most are taken."""
    scene = load_preset(name).scene
    found = [
        steps(executor, make_plan(scene, TIERS[tier]), time=2.7, camera=scene.camera, size=(64, 36))
        for tier in ("standard", "reference")
    ]
    assert 0.1 < found[0].water < 1.0
    assert 1.0 <= found[0].mean < found[0].most
    assert found[0].most < found[1].most
