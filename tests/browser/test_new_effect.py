"""CONTRIBUTING.md's example: one Python module and its GLSL, and both executors draw it. No TypeScript knows of it."""

import base64
import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from seafoam.effects import EFFECTS
from seafoam.plan import FramePlan, planner
from seafoam.quality import TIERS
from seafoam.render.executor import Executor
from seafoam.scene.presets import load_preset

EXAMPLE = Path(__file__).parents[2] / "docs" / "example" / "windrows.py"
SIZE = (320, 180)


@pytest.fixture
def plans(monkeypatch: pytest.MonkeyPatch) -> tuple[FramePlan, FramePlan]:
    """The default sea without the example, and with it among its effects."""
    scene = load_preset("default").scene
    without = planner.make_plan.__wrapped__(scene, TIERS["standard"])
    spec = importlib.util.spec_from_file_location("windrows", EXAMPLE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(planner, "EFFECTS", (*EFFECTS, module.EFFECT))
    return without, planner.make_plan.__wrapped__(scene, TIERS["standard"])


def test_the_example_draws_on_both_sides(page: Page, executor: Executor, plans: tuple[FramePlan, FramePlan]) -> None:
    without, plan = plans
    assert "windrows" in {note.name for note in plan.effects}
    scene = load_preset("default").scene
    width, height = SIZE
    with_lines = executor.render(plan, time=9.0, camera=scene.camera, width=width, height=height).pixels
    plain = executor.render(without, time=9.0, camera=scene.camera, width=width, height=height).pixels
    assert np.abs(with_lines.astype(int) - plain.astype(int)).mean() > 0.5
    answer = page.evaluate(
        "([plan, options]) => window.seafoam.render(plan, options)",
        [
            json.loads(plan.canonical_json()),
            {"time": 9.0, "width": width, "height": height, "camera": scene.camera.model_dump(mode="json")},
        ],
    )
    pixels = np.frombuffer(base64.b64decode(answer["pixels"]), np.uint8).reshape(height, width, 4)
    assert answer["glError"] == 0
    assert (pixels == with_lines).all()


def test_contributing_shows_the_very_files_that_run() -> None:
    text = (EXAMPLE.parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for name in ("windrows.py", "windrows.glsl"):
        body = (EXAMPLE.parent / name).read_text(encoding="utf-8")
        for line in body.splitlines():
            if line.strip().startswith(("float windrow", "slots=", "EFFECT =")):
                assert line.strip() in text, line
