"""Only what the scene calls for: what a plan leaves out would change no pixel by more than its stated bound."""

import math
from itertools import product

import numpy as np
import pytest

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect
from seafoam.framegraph.visibility import drawn_passes
from seafoam.planner import make_plan
from seafoam.planner.collect import NEGLIGIBLE
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.cases import cases_of
from support.exact import EXACT, everywhere, whole_plan
from support.pictures import draw, levels
from support.report import Report
from support.scenes import Camera, Scene, load_preset, preset_names
from support.sweep import rested, spread

VIEWS = (
    Camera(position=(3.0, 6.0, -2.0), pitch=-0.15),
    Camera(position=(0.0, 2.0, 0.0), yaw=1.5, pitch=-0.02),
    Camera(position=(-40.0, 25.0, 7.0), yaw=-1.6, pitch=-math.pi / 2),
    Camera(position=(0.0, 1.5, 0.0), yaw=1.57, pitch=0.1),
)
ROUNDING = 2e-6
"""Two programs that compute the same do not round alike; of linear light, display white = 1."""

CASES = [
    pytest.param(effect, scene, id=f"{effect.name} {i}")
    for effect in EFFECTS
    for i, scene in enumerate(cases_of(effect).invisible)
]


@pytest.mark.parametrize(("effect", "scene"), rested(CASES, 4))
def test_what_cannot_be_seen_is_left_out_and_would_change_nothing(
    executor: Executor, report: Report, effect: Effect, scene: Scene
) -> None:
    lean, full = make_plan(scene, EXACT), whole_plan(scene, EXACT)
    (note,) = [note for note in lean.skipped if note.name == effect.name]
    assert note.bound is not None
    assert note.bound < NEGLIGIBLE
    assert note.why
    assert effect.name not in {one.name for one in lean.effects}
    assert effect.name in {one.name for one in full.effects}
    worst = 0.0
    for camera, time in product(VIEWS, (0.0, 31.7)):
        pictures = [draw(executor, plan, camera, time=time, size=(96, 64), output="linear") for plan in (lean, full)]
        worst = max(worst, levels(*pictures).max())
    # All that is left out together stays within the sum of its bounds.
    allowed = 255.0 * (sum(note.bound or 0.0 for note in lean.skipped) + ROUNDING)
    report.within(
        "Left out of the plan: bound and measured change, levels of 255",
        effect=effect.name,
        why=note.why[:60],
        measured=(worst, allowed),
    )


LOOKED_AT = (
    Camera(position=(3.0, 30.0, -2.0), pitch=math.pi / 2),
    Camera(position=(3.0, 30.0, -2.0), pitch=0.6, fov=0.5, roll=0.3),
    Camera(position=(3.0, 30.0, -2.0), pitch=-math.pi / 2),
    Camera(position=(3.0, 30.0, -2.0), pitch=-0.5, fov=0.8, yaw=2.0),
    Camera(position=(3.0, 30.0, -2.0), pitch=-0.5, fov=0.8, yaw=-1.0),
)
"""Sky alone, water alone, and to both sides."""


@pytest.mark.parametrize("preset", spread(preset_names(), 5))
def test_what_is_out_of_view_is_not_drawn_and_would_change_nothing(executor: Executor, preset: str) -> None:
    """To the last bit: what is left undrawn has no pixel in the picture."""
    scene = load_preset(preset).scene
    plan = make_plan(scene, TIERS["fast"])
    drawn = set()
    for camera in LOOKED_AT:
        lean, full = (
            draw(executor, one, camera, time=1.3, size=(64, 40), output="linear") for one in (plan, everywhere(plan))
        )
        assert np.array_equal(lean, full)
        drawn.add(frozenset(i for i, shows in drawn_passes(plan, camera, 64, 40, plan.linear).items() if shows))
    assert len(drawn) > 1 or scene.shore is not None
