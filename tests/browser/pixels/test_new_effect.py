"""CONTRIBUTING.md's example: one Python module and its GLSL, registered from outside the package. Both executors draw
it as its float64 truth says; no TypeScript and no file of the package knows of it."""

import importlib
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from seafoam.effects import register
from seafoam.effects.effect import Effect
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.browser.lanes import rendered
from support.cases import cases_of, unregister
from support.exact import whole_plan
from support.pictures import draw
from support.scenes import Camera, Foam, HeightSaturation, Scene, load_preset

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "docs" / "example" / "windrows.py"
SIZE = (160, 90)
SHOWN = (
    "float rows",
    "class Windrows",
    "class WindrowQuality",
    "slots=",
    "EFFECT =",
    "bound=",
    "def truth",
    "extension=",
    "saturation=",
    "CASES =",
    "guard=",
)
"""Beginnings of lines that CONTRIBUTING.md must hold."""
DRY = (HeightSaturation(base=50.0, full=60.0),)
"""A saturation that nothing reaches: all foam is the example's."""
PART = {"windrows": {"spacing": 9.0, "strength": 0.8, "wind_direction": 0.6}}


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> Iterator[Effect]:
    """The example's, registered."""
    monkeypatch.syspath_prepend(str(EXAMPLE.parent))
    effect: Effect = importlib.import_module(EXAMPLE.stem).EFFECT
    register(effect)
    yield effect
    unregister(effect)


def test_the_example_draws_on_both_sides(page: Page, executor: Executor, example: Effect) -> None:
    plain = load_preset("default").scene
    scene = Scene.model_validate({**plain.model_dump(), "extensions": PART})
    without, plan = make_plan(plain, TIERS["standard"]), make_plan(scene, TIERS["standard"])
    assert example.name not in {note.name for note in (*without.effects, *without.skipped)}
    assert example.name in {note.name for note in plan.effects}
    with_lines, bare = (draw(executor, one, scene.camera, time=5.0, size=SIZE) for one in (plan, without))
    assert np.abs(with_lines.astype(int) - bare.astype(int)).mean() > 0.5
    assert (rendered(page, plan, time=5.0, size=SIZE, camera=scene.camera) == with_lines).all()


def test_the_example_holds_where_it_is_hard(executor: Executor, example: Effect) -> None:
    (case,) = cases_of(example).hard
    plan = make_plan(case.scene, TIERS["reference"])
    for time in case.times:
        drawn = draw(executor, plan, case.camera, time=time, size=(48, 27), output="linear")
        assert np.isfinite(drawn).all()
        assert 0.0 < drawn[..., 3].mean() < 1.0


def test_the_example_is_left_out_where_it_cannot_show(executor: Executor, example: Effect) -> None:
    (scene,) = cases_of(example).invisible
    lean, full = (make(scene, TIERS["standard"]) for make in (make_plan, whole_plan))
    assert example.name in {note.name for note in lean.skipped}
    assert example.name in {note.name for note in full.effects}
    pictures = [draw(executor, plan, scene.camera, time=0.0, size=(48, 27), output="linear") for plan in (lean, full)]
    assert np.abs(pictures[0] - pictures[1]).max() < 0.5 / 255.0


@pytest.mark.parametrize("look", ["fading", "filtered"])
def test_the_example_is_as_its_truth(executor: Executor, example: Effect, look: str) -> None:
    camera = Camera(position=(40.0, 5.0, -3.0), pitch=-0.35)
    scene = Scene.model_validate(
        {"foam": Foam(saturation=DRY, look=look), "light": None, "camera": camera, "extensions": PART}
    )
    width, height = 96, 54
    quality = TIERS["reference"].model_copy(update={"samples": 4})
    frame = render(scene, time=2.0, width=width, height=height, samples=2, mode="same-samples")
    drawn = draw(executor, make_plan(scene, quality), camera, time=2.0, size=(width, height), output="linear")
    assert 0.005 < frame.alpha.mean() < 0.5
    off = np.abs(drawn[..., 3] - frame.alpha)
    # A threshold that a sample just misses turns that sample: the mean holds, and nearly every pixel.
    assert off.mean() < 1.0 / 255.0
    assert (off < 2.0 / 255.0).mean() > 0.99


def test_contributing_shows_the_very_files_that_run() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    shown = set()
    for name in ("windrows.py", "windrows_cases.py", "windrows.glsl"):
        for line in (EXAMPLE.parent / name).read_text(encoding="utf-8").splitlines():
            for start in SHOWN:
                if line.strip().startswith(start):
                    assert line.strip() in text, line
                    shown.add(start)
    assert shown == set(SHOWN)


def test_contributing_lists_the_files_of_an_effect_of_the_package() -> None:
    """The list of sparkles, and that no other module of the package names them."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    # Of a shader's file, a part.
    listed = set(re.findall(r"^\| `((?:server|shaders|docs|tests)/[^`@]+)(?:@\w+)?`", text, re.MULTILINE))
    assert listed
    assert all((ROOT / path).is_file() for path in listed)
    folders = (ROOT / "server" / "seafoam", ROOT / "shaders")
    files = [path for folder in folders for path in folder.rglob("*") if path.suffix in (".py", ".glsl")]
    naming = {
        str(path.relative_to(ROOT))
        for path in files
        if re.search(r"sparkle", path.read_text(encoding="utf-8"), re.IGNORECASE)
    }
    assert naming <= listed, naming - listed
