"""A sweep with GL and the float64 reference."""

from functools import partial

from seafoam.accuracy import sweep
from seafoam.accuracy.cache import Store
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, make_sweep
from seafoam.render.service.jobs import measure


def test_a_real_sweep_end_to_end(executor, monkeypatch, tmp_path):
    """Few points of a preset, against the reference itself."""
    wanted = {"fast", "standard", "reference", "samples=4"}
    every = sweep.points_of
    monkeypatch.setattr(sweep, "points_of", lambda scene: tuple(point for point in every(scene) if point.id in wanted))
    subject = Subject.of_preset("paper-halftone")
    subject = Subject(subject.preset, subject.scene, subject.time, (32, 18))
    rig = Rig(partial(measure, executor), executor.info, 1)
    settings = SweepSettings(32, 18, 8, 2)
    found = make_sweep(Store(tmp_path), subject, settings, rig)
    assert {point.id for point in found.points} == wanted
    errors = {point.id: point.error.rmse for point in found.points}
    assert errors["reference"] < errors["samples=4"] < errors["standard"]
    assert found.point("standard").causes.filtering > 0.0
    assert all(point.time.median_ms > 0.0 for point in found.points)
    assert "reference" in found.front
    assert make_sweep(Store(tmp_path), subject, settings, rig) == found
