"""Accuracy by the executor: sweeps, flicker, and what is displayed."""

from functools import partial

import numpy as np
import pytest
from bench.drawn.motion import MOST, excess, moved, shown
from numpy.typing import NDArray

from seafoam.accuracy import metrics, sweep
from seafoam.accuracy.cache import stored
from seafoam.accuracy.metrics import tone_curve
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, make_sweep
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure
from support.pictures import draw
from support.report import Report
from support.scenes import Scene, ToneCurve, load_preset


def test_a_real_sweep_end_to_end(executor, monkeypatch, tmp_path):
    """Few points of a preset, against the reference itself."""
    wanted = {"fast", "standard", "reference", "samples=4"}
    every = sweep.points_of
    monkeypatch.setattr(sweep, "points_of", lambda scene: tuple(point for point in every(scene) if point.id in wanted))
    subject = Subject.of_preset("paper-halftone")
    subject = Subject(subject.preset, subject.scene, subject.time, (32, 18))
    rig = Rig(partial(measure, executor), executor.info, 1)
    settings = SweepSettings(32, 18, 8, 2)
    found = make_sweep(stored(tmp_path), subject, settings, rig)
    assert {point.id for point in found.points} == wanted
    errors = {point.id: point.error.rmse for point in found.points}
    assert errors["reference"] < errors["samples=4"] < errors["standard"]
    assert found.point("standard").causes.filtering > 0.0
    assert all(point.time.median_ms > 0.0 for point in found.points)
    assert "reference" in found.front
    assert make_sweep(stored(tmp_path), subject, settings, rig) == found


@pytest.mark.parametrize("curve", ["filmic", "photographic"])
def test_displayed_pictures_are_what_the_screen_gets(executor: Executor, curve: ToneCurve) -> None:
    scene = load_preset("default").scene
    light = scene.light.model_copy(update={"tone": curve, "glare": 0.0})
    plan = make_plan(scene.model_copy(update={"light": light}), TIERS["fast"])
    shape = {"time": 0.0, "camera": scene.camera, "width": 32, "height": 18}
    linear = executor.render(plan, output="linear", **shape).pixels
    screen = executor.render(plan, output="rgba8", **shape).pixels
    assert np.abs(255.0 * metrics.displayed(linear, curve) - screen[..., :3]).max() < 0.6


Frames = list[NDArray[np.float64]]


def clip(executor: Executor, scene: Scene, time: float, samples: int, tier: Tier = "standard") -> tuple[Frames, Frames]:
    """Foam and luma of a fifth of a second at 60 Hz, the camera 0.3 m/s forward."""
    plan = make_plan(scene, TIERS[tier].model_copy(update={"samples": samples}))
    curve = tone_curve(scene)
    foams, pictures = [], []
    for i in range(12):
        camera = moved(scene.camera, 0.3 * i / 60.0)
        frame = draw(executor, plan, camera, time=time + i / 60.0, size=(64, 36), output="linear")
        foams.append(frame[..., 3].astype(np.float64))
        pictures.append(shown(frame, curve))
    return foams, pictures


def test_default_flickers_no_more_than_twice_its_motion(executor: Executor, report: Report) -> None:
    """One sample a pixel against 64; the hard threshold, which the filtered look is there to mend, fails the bound."""
    preset = load_preset("default")
    ratios, often = {}, {}
    for look in ("filtered", "halftone"):
        scene = preset.scene.model_copy(update={"foam": preset.scene.foam.model_copy(update={"look": look})})
        once, often[look] = (clip(executor, scene, preset.time, samples) for samples in (1, 64))
        ratios[look] = [excess(one, many) for one, many in zip(once, often[look], strict=True)]
        report.add(
            "Flicker of default at one sample a pixel over that at 64, 12 frames at 60 Hz",
            look=look,
            foam=f"{ratios[look][0]:.2f}",
            picture=f"{ratios[look][1]:.2f}",
            bound=f"{MOST:g}",
        )
    assert max(ratios["filtered"]) <= MOST
    assert min(ratios["halftone"]) > MOST
    fast = clip(executor, preset.scene, preset.time, 1, "fast")
    assert max(map(excess, fast, often[preset.scene.foam.look])) <= MOST
