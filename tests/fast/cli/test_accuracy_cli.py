"""``seafoam accuracy`` and ``seafoam render --quality auto``. What they refuse is in test_refusals.py."""

import json
import time
from types import SimpleNamespace

import numpy as np
import pytest

from seafoam.accuracy import sweep
from seafoam.quality import TIERS
from seafoam.render.service import jobs
from seafoam.scene.presets import load_preset
from support.accuracy_rigs import grey_truth, noisy


@pytest.fixture
def seafoam(seafoam, monkeypatch, tmp_path):
    """The command on a renderer whose times and errors are known."""
    monkeypatch.setenv("SEAFOAM_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    monkeypatch.setattr("seafoam.render.service.jobs.measure", lambda executor, job: noisy().measure(job))
    return seafoam


SMALL = ("--size", "32x18", "--rounds", "2", "--samples", "2")


def test_accuracy_writes_every_form(seafoam, tmp_path):
    files = {"-o": "a.png", "--json": "a.json", "--csv": "a.csv", "--html": "a.html"}
    options = [part for option, name in files.items() for part in (option, tmp_path / name)]
    code, out, err = seafoam("accuracy", "default", *SMALL, *options)
    assert code == 0, err
    assert "samples=4" in out
    assert "× the time buys" in out
    found = json.loads((tmp_path / "a.json").read_text())
    assert found["preset"] == "default"
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.csv").read_text().startswith("id,")
    assert "seafoam accuracy default --size 32x18" in (tmp_path / "a.html").read_text()


def test_accuracy_says_by_which_clock_it_timed(seafoam, tmp_path):
    for clock in ("wall", "processor"):
        code, _, err = seafoam("accuracy", "paper-threshold", *SMALL, "--timer", clock, "--json", tmp_path / "a.json")
        assert code == 0, err
        assert json.loads((tmp_path / "a.json").read_text())["timing"]["timer"] == clock


@pytest.mark.parametrize(("clock", "seconds"), [("wall", 0.5), ("processor", 2.0)])
def test_a_measurement_is_timed_by_the_clock_that_is_asked_for(monkeypatch, clock, seconds):
    scene = load_preset("paper-threshold").scene
    drawn = SimpleNamespace(pixels=np.zeros((9, 16, 4), np.uint8), timings={"render": 0.5, "read": 0.25})
    renderer = SimpleNamespace(render=lambda plan, **asked: drawn)
    monkeypatch.setattr(time, "process_time", iter((1.0, 3.0)).__next__)
    asked = jobs.MeasureJob(scene, TIERS["fast"], 0.0, scene.camera, (jobs.Draw(16, 9, "rgba8"),), clock)
    assert [one.seconds for one in jobs.measure(renderer, asked)] == [seconds]


def test_accuracy_of_all_presets_fills_folders(seafoam, monkeypatch, tmp_path):
    monkeypatch.setattr("seafoam.scene.presets.preset_names", lambda: ("paper-halftone", "paper-threshold"))
    code, _, err = seafoam("accuracy", "--all", *SMALL, "--csv", tmp_path / "reports")
    assert code == 0, err
    assert {path.stem for path in (tmp_path / "reports").iterdir()} == {"paper-halftone", "paper-threshold"}


def test_render_picks_a_quality_for_a_budget(seafoam, tmp_path):
    asked = ("--size", "32x18", "--quality", "auto", "--budget-ms", "4")
    code, out, err = seafoam("render", "paper-threshold", "-o", tmp_path / "a.png", *asked)
    assert code == 0, err
    assert "predicted" in out.splitlines()[-1]
    assert "of 4 ms at 32 x 18" in out.splitlines()[-1]
