"""Section 17: a plunging crest as both executors draw it, against float64."""

import numpy as np
import pytest

from cases.waves.breaker import CREST, EYE, LEFT, PLUNGING
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import colours, draw, levels, samples
from support.report import Report
from support.scenes import Camera, Scene, load_preset

SIZE = (64, 36)
OTHER_WAY = PLUNGING.model_copy(update={"breaker": CREST.model_copy(update={"peels": "left", "place": (-16.0, 24.0)})})
SERIES = PLUNGING.model_copy(update={"breaker": CREST.model_copy(update={"every": 3.0}), "foam": LEFT})
HALFTONE = SERIES.model_copy(update={"foam": LEFT.model_copy(update={"look": "halftone"})})
VIEWS: dict[str, tuple[Scene, Camera, float]] = {
    "the shoulder": (PLUNGING, EYE, 2.3),
    "the barrel": (PLUNGING, Camera(position=(1.5, 0.7, -7.0), yaw=-0.2, fov=1.2), 2.3),
    "the back": (PLUNGING, Camera(position=(-16.0, 3.0, -8.0), yaw=1.2, pitch=-0.1), 2.3),
    "from above": (PLUNGING, Camera(position=(-2.0, 20.0, -12.0), pitch=-1.5, fov=0.9), 2.3),
    "the shoulder, to the left": (
        OTHER_WAY,
        Camera(position=(7.0, 1.4, -2.0), yaw=-2.6, fov=0.8),
        2.3,
    ),
    "the front": (PLUNGING, Camera(position=(16.0, 0.5, -14.0), yaw=-1.5), 2.3),
    "the bore": (PLUNGING, EYE, 4.5),
    "crests from behind": (SERIES, Camera(position=(-40.0, 4.0, -12.0), yaw=1.4, pitch=-0.1), 6.0),
    "crests from before": (SERIES, Camera(position=(40.0, 2.2, 0.0), yaw=-1.3, fov=0.6), 5.6),
    "crests from between": (SERIES, Camera(position=(7.0, 1.6, 2.0), yaw=-0.3, fov=1.6), 6.6),
    "foam left behind": (SERIES, Camera(position=(-10.0, 6.0, 4.0), yaw=0.5, pitch=-0.2, fov=0.8), 7.0),
    "foam left behind, unfiltered": (HALFTONE, Camera(position=(-2.0, 20.0, -8.0), pitch=-1.5, fov=0.9), 7.0),
    "the preset": (load_preset("breaker").scene, load_preset("breaker").scene.camera, 5.0),
}


@pytest.mark.whole
@pytest.mark.parametrize("view", list(VIEWS))
def test_frames_are_the_float64_ones(executor: Executor, report: Report, view: str) -> None:
    scene, camera, time = VIEWS[view]
    truth = render(scene, time=time, width=SIZE[0], height=SIZE[1], camera=camera).rgb
    drawn = samples(executor, scene, EXACT, camera, size=SIZE, time=time)
    off = levels(drawn, truth)
    report.add(
        "Plunging crests against float64 (levels)", view=view, mean=f"{off.mean():.3f}", off=f"{(off > 2).mean():.4f}"
    )
    without = samples(executor, scene.model_copy(update={"breaker": None}), EXACT, camera, size=SIZE, time=time)
    assert (levels(drawn, without) > 2.0).mean() > 0.02, "no crest shows"
    assert off.mean() < 0.5
    # Silhouettes, and lumps that one search meets a step before the other.
    assert (off > 2.0).mean() < 0.02


def test_an_eye_in_water_sees_no_crest(executor: Executor) -> None:
    """Under still water, and in the crest."""
    for eye in (Camera(position=(7.0, -2.0, 2.0), yaw=-0.5), Camera(position=(-3.2, 0.8, -8.0), yaw=-0.5)):
        with_crest, without = (
            samples(executor, scene, EXACT, eye, size=(48, 27), time=2.0)
            for scene in (PLUNGING, PLUNGING.model_copy(update={"breaker": None}))
        )
        np.testing.assert_allclose(colours(with_crest), colours(without), atol=1e-5)


def test_without_light_foam_is_white_and_the_crest_black(executor: Executor) -> None:
    scene, camera = PLUNGING.model_copy(update={"light": None}), EYE
    white = samples(executor, scene, EXACT, camera, size=SIZE, time=2.3)[..., 1]
    dry = samples(executor, scene.model_copy(update={"foam": None}), EXACT, camera, size=SIZE, time=2.3)[..., 1]
    assert (white > 0.9).mean() > 0.005
    assert dry.max() == 0.0


def test_samples_that_are_chosen_meet_the_same_crests(executor: Executor) -> None:
    """They are drawn again by programs that cover the picture, not by the crests' rectangle."""
    scene = load_preset("breaker").scene
    few, many = (TIERS["high"].model_copy(update={"samples_max": most}) for most in (4, 16))
    plans = [make_plan(scene, quality) for quality in (few, many)]
    assert len(plans[1].passes) > len(plans[0].passes)
    seen = [draw(executor, plan, scene.camera, time=6.8, size=(96, 54)).astype(int) for plan in plans]
    assert 0.0 < np.abs(seen[1] - seen[0]).mean() < 1.0
