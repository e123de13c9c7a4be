"""Water is drawn under the horizon alone, rising rays look for land alone: no pixel is any different."""

import math

import numpy as np
import pytest

from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.pictures import draw
from support.probe import WHOLE
from support.scenes import Camera, Scene, load_preset

SIZES = ((48, 27), (64, 7), (5, 61), (1, 1))


def over_the_target(plan: FramePlan) -> FramePlan:
    """The plan with every pass that keeps under the horizon drawn over the whole target."""
    programs = dict(plan.programs)
    for name, program in programs.items():
        if any(file.path == "vertex/vertex.glsl@falling" for file in program.vertex.files):
            programs[name] = program.model_copy(update={"vertex": WHOLE})
    assert programs != plan.programs
    return plan.model_copy(update={"programs": programs})


def cameras(top: float) -> list[Camera]:
    """High and low, among crests and over all of them, every way up; straight down and up."""
    chance = np.random.default_rng(23)
    found = [Camera(position=(3.0, top + 2.0, 1.0), pitch=sign * math.pi / 2, roll=1.0) for sign in (-1.0, 1.0)]
    for height in (0.3 * top, top, top + 0.01, top + 1.0, top + 40.0):
        for _ in range(4):
            yaw, roll = chance.uniform(-math.pi, math.pi, 2)
            pitch, fov = chance.uniform(-1.2, 0.9), chance.uniform(0.2, 2.4)
            found.append(Camera(position=(5.0, height, -2.0), yaw=yaw, pitch=pitch, roll=roll, fov=fov))
    return found


@pytest.mark.parametrize("preset", ["default", "beach"])
def test_no_pixel_is_different(executor: Executor, preset: str) -> None:
    scene: Scene = load_preset(preset).scene
    plan = make_plan(scene, TIERS["standard"])
    whole = over_the_target(plan)
    water = 0
    for camera in cameras(plan.top):
        for width, height in SIZES:
            one, other = (
                draw(executor, each, camera, time=2.7, size=(width, height), output="linear") for each in (plan, whole)
            )
            assert (one == other).all(), (camera, width, height)
            water += int((one[..., 3] > 0.0).sum())
    assert water > 0
