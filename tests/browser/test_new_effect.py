"""CONTRIBUTING.md's example: one Python module and its GLSL, and both executors draw it. No TypeScript knows of it."""

import base64
import importlib
import json
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect
from seafoam.planner import FramePlan, make_plan, planner
from seafoam.quality import TIERS, Tier
from seafoam.render.gl.executor import Executor
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from support.pictures import draw

EXAMPLE = Path(__file__).parents[2] / "docs" / "example" / "windrows.py"
SIZE = (320, 180)
SHOWN = ("float windrow", "slots=", "EFFECT =", "bound=", "CASES =", "guard=", "without=")
"""Beginnings of lines that CONTRIBUTING.md must hold."""


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> Effect:
    """The example's."""
    monkeypatch.syspath_prepend(str(EXAMPLE.parent))
    return importlib.import_module(EXAMPLE.stem).EFFECT


def plan_of(effect: Effect, scene: Scene, tier: Tier = "standard", *, economy: bool = True) -> FramePlan:
    """A plan with one more effect, past the cache."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(planner, "EFFECTS", (*EFFECTS, effect))
        return planner.make_plan.__wrapped__(scene, TIERS[tier], economy=economy)


def test_the_example_draws_on_both_sides(page: Page, executor: Executor, example: Effect) -> None:
    scene = load_preset("default").scene
    without, plan = make_plan(scene, TIERS["standard"]), plan_of(example, scene)
    assert example.name in {note.name for note in plan.effects}
    width, height = SIZE
    with_lines = draw(executor, plan, scene.camera, time=5.0, size=(width, height))
    plain = draw(executor, without, scene.camera, time=5.0, size=(width, height))
    assert np.abs(with_lines.astype(int) - plain.astype(int)).mean() > 0.5
    answer = page.evaluate(
        "([plan, options]) => window.seafoam.render(plan, options)",
        [
            json.loads(plan.canonical_json()),
            {"time": 5.0, "width": width, "height": height, "camera": scene.camera.model_dump(mode="json")},
        ],
    )
    pixels = np.frombuffer(base64.b64decode(answer["pixels"]), np.uint8).reshape(height, width, 4)
    assert answer["glError"] == 0
    assert (pixels == with_lines).all()


def test_the_example_holds_where_it_is_hard(executor: Executor, example: Effect) -> None:
    (case,) = example.cases.hard
    plan = plan_of(example, case.scene, "reference")
    for time in case.times:
        drawn = draw(executor, plan, case.camera, time=time, size=(48, 27), output="linear")
        assert np.isfinite(drawn).all()
        assert 0.0 < drawn[..., 3].mean() < 1.0


def test_the_example_is_left_out_where_it_cannot_show(executor: Executor, example: Effect) -> None:
    (scene,) = example.cases.invisible
    lean, full = plan_of(example, scene), plan_of(example, scene, economy=False)
    assert example.name in {note.name for note in lean.skipped}
    assert example.name in {note.name for note in full.effects}
    pictures = [draw(executor, plan, scene.camera, time=0.0, size=(48, 27), output="linear") for plan in (lean, full)]
    assert np.abs(pictures[0] - pictures[1]).max() < 0.5 / 255.0


def test_contributing_shows_the_very_files_that_run() -> None:
    text = (EXAMPLE.parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for name in ("windrows.py", "windrows_cases.py", "windrows.glsl"):
        body = (EXAMPLE.parent / name).read_text(encoding="utf-8")
        for line in body.splitlines():
            if line.strip().startswith(
                ("float windrow", "slots=", "EFFECT =", "bound=", "CASES =", "guard=", "without=")
            ):
                assert line.strip() in text, line
