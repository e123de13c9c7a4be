"""Linear light, displayed, is what the executor sends to a screen."""

import numpy as np

from seafoam.accuracy import metrics


def test_displayed_pictures_are_what_the_screen_gets(executor):
    from seafoam.planner import make_plan
    from seafoam.quality import TIERS
    from seafoam.scene.presets import load_preset

    found = load_preset("default")
    plan = make_plan(found.scene, TIERS["draft"])
    shape = {"time": 0.0, "camera": found.scene.camera, "width": 32, "height": 18}
    linear = executor.render(plan, output="linear", **shape).pixels
    screen = executor.render(plan, output="rgba8", **shape).pixels
    assert np.abs(255.0 * metrics.displayed(linear) - screen[..., :3]).max() < 0.6
