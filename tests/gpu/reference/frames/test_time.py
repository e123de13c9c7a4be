"""Frames are functions of their request: same bytes always, and any time as good as time 0."""

import hashlib
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.pictures import colours, draw
from support.scenes import load_preset
from support.sweep import crossed

SIZE = (320, 180)


def frame(executor: Executor, time: float, preset: str = "default") -> NDArray[np.float64]:
    scene = load_preset(preset).scene
    plan = make_plan(scene, TIERS["standard"])
    linear = draw(executor, plan, scene.camera, time=time, size=SIZE, output="linear")
    return colours(linear)


def detail(picture: NDArray[np.float64]) -> float:
    """Mean strength of the picture's gradient."""
    return float(np.abs(np.diff(picture, axis=1)).mean() + np.abs(np.diff(picture, axis=0)).mean())


@pytest.mark.parametrize(
    ("preset", "time"), crossed(["default", "paper-halftone", "shallows"], [1e9, -1e9, 1e6 + 0.37], 3)
)
def test_any_time_is_as_sharp_and_moves_as_much_as_time_0(executor: Executor, preset: str, time: float) -> None:
    """Sharpness alone would not show a sea that has frozen or that jumps: motion over a sixtieth of a second does."""
    found: list[tuple[float, float]] = []
    for start in (0.0, time):
        pairs = [[frame(executor, start + 1.7 * i + step, preset) for step in (0.0, 1.0 / 60.0)] for i in range(8)]
        sharp = np.mean([detail(one) for one, _ in pairs])
        moved = np.mean([np.abs(after - before).mean() for before, after in pairs])
        found.append((float(sharp), float(moved)))
    (sharp_at_0, moved_at_0), (sharp_then, moved_then) = found
    assert 0.75 < sharp_then / sharp_at_0 < 1.33
    assert moved_at_0 > 0.0
    assert 0.7 < moved_then / moved_at_0 < 1.4


def test_a_small_step_moves_the_picture_a_little(executor: Executor) -> None:
    """Continuity at 1e9 s, where float64 holds time to 1.2e-7 s: steps of a millisecond."""
    frames = [frame(executor, 1e9 + i * 1e-3) for i in range(5)]
    steps = [float(np.abs(b - a).mean()) for a, b in pairwise(frames)]
    whole = float(np.abs(frames[4] - frames[0]).mean())
    assert whole > 0.0
    assert max(steps) < 4.0 * whole


def test_same_bytes_twice_and_in_another_process(executor: Executor) -> None:
    scene = load_preset("default").scene
    plan = make_plan(scene, TIERS["standard"])
    frames = [draw(executor, plan, scene.camera, time=7.25, size=(160, 90)).tobytes() for _ in range(2)]
    assert frames[0] == frames[1]
    code = (
        "import hashlib; from seafoam.planner import make_plan; from seafoam.quality import TIERS; "
        "from seafoam.render.gl.executor import Executor; from seafoam.scene.presets import load_preset; "
        "s = load_preset('default').scene; "
        "p = make_plan(s, TIERS['standard']); "
        "r = Executor().render(p, time=7.25, camera=s.camera, width=160, height=90); "
        "print(hashlib.sha256(r.pixels.tobytes()).hexdigest())"
    )
    other = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()
    assert other == hashlib.sha256(frames[0]).hexdigest()


def test_frames_do_not_depend_on_what_was_drawn_before(executor: Executor) -> None:
    alone = frame(executor, 3.0)
    for preset in ("paper-threshold", "shallows", "paper-wake"):
        frame(executor, 1.0, preset)
    assert (frame(executor, 3.0) == alone).all()


def test_the_far_side_of_the_map_is_as_good_as_the_origin(executor: Executor) -> None:
    """Ten thousand kilometres away the sea is another, but as sharp."""
    scene = load_preset("default").scene
    plan = make_plan(scene, TIERS["standard"])
    sharp = []
    for x, z in ((0.0, 0.0), (1e7, -1e7)):
        details = []
        for i in range(4):
            camera = scene.camera.model_copy(update={"position": (x - np.sign(x) * 40.0 * i, 5.6, z + 40.0 * i)})
            shot = draw(executor, plan, camera, time=1.0, size=SIZE, output="linear")
            details.append(detail(colours(shot)))
        sharp.append(np.mean(details))
    assert 0.75 < sharp[1] / sharp[0] < 1.33
