"""Every preset once, small and at the cheapest tier: there is a picture. Part of ``make quick``."""

import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.parity import faults
from support.pictures import draw
from support.scenes import load_preset, preset_names

SIZE = (64, 36)


@pytest.mark.whole
@pytest.mark.parametrize("preset", preset_names())
def test_a_preset_draws(executor: Executor, preset: str) -> None:
    found = load_preset(preset)
    plan = make_plan(found.scene, TIERS["fast"])
    camera = found.scene.camera
    frame = draw(executor, plan, camera, time=found.time, size=SIZE, output="samples")
    assert not faults(frame)
