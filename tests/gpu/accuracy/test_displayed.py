"""Linear light, displayed, is what the executor sends to a screen."""

import numpy as np
import pytest

from seafoam.accuracy import metrics
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.scenes import ToneCurve, load_preset


@pytest.mark.parametrize("curve", ["filmic", "photographic"])
def test_displayed_pictures_are_what_the_screen_gets(executor: Executor, curve: ToneCurve) -> None:
    scene = load_preset("default").scene
    light = scene.light.model_copy(update={"tone": curve, "glare": 0.0})
    plan = make_plan(scene.model_copy(update={"light": light}), TIERS["fast"])
    shape = {"time": 0.0, "camera": scene.camera, "width": 32, "height": 18}
    linear = executor.render(plan, output="linear", **shape).pixels
    screen = executor.render(plan, output="rgba8", **shape).pixels
    assert np.abs(255.0 * metrics.displayed(linear, curve) - screen[..., :3]).max() < 0.6
