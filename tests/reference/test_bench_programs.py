"""What the bench compares draws the same: programs written by hand, and the one that holds every effect."""

from pathlib import Path

import bench
import pytest
from bench.economy import QUALITY, ByHand, by_hand, same_picture, with_surface
from bench.uber import uber_plan

from seafoam.plan import make_plan
from seafoam.render.executor import Executor
from seafoam.scene.presets import load_preset

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
    same_picture(executor, uber_plan(scene, QUALITY), make_plan(scene, QUALITY), scene.camera)
