"""A small picture of every preset: it shows something, and what its text says."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.foam.whitecaps import whitecaps
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.parity import faults
from support.pictures import colours, draw
from support.report import Report
from support.scenes import Camera, Scene, load_preset, preset_names

SIZE = (64, 36)


@pytest.mark.whole
@pytest.mark.parametrize("preset", preset_names())
def test_a_preset_draws(executor: Executor, preset: str) -> None:
    found = load_preset(preset)
    plan = make_plan(found.scene, TIERS["fast"])
    camera = found.scene.camera
    frame = draw(executor, plan, camera, time=found.time, size=SIZE, output="samples")
    assert not faults(frame)


LARGER = (96, 54)
MINUTE = range(0, 61, 10)


def below_horizon(camera: Camera) -> NDArray[np.bool_]:
    """Which pixels look down at least 0.002 rad, so that they show water even from over the crests."""
    half = math.tan(camera.fov / 2.0)
    y, x = np.mgrid[1.0 : -1.0 : LARGER[1] * 1j, -1.0 : 1.0 : LARGER[0] * 1j] * half
    x *= LARGER[0] / LARGER[1]
    up = x * math.sin(camera.roll) + y * math.cos(camera.roll)
    rise = up * math.cos(camera.pitch) + math.sin(camera.pitch)
    return rise < -0.002 * np.sqrt(1.0 + x * x + y * y)


def views(executor: Executor, scene: Scene, times: range, tier: str = "fast") -> list[NDArray[np.float32]]:
    """Linear light and coverage of the scene from its camera at each time."""
    plan = make_plan(scene, TIERS[tier])
    return [draw(executor, plan, scene.camera, time=t, size=LARGER, output="linear") for t in times]


@pytest.mark.whole
@pytest.mark.parametrize(("preset", "wind"), [("open-ocean", 13.0), ("boat-in-storm", 22.0), ("storm", 22.0)])
def test_as_much_foam_is_seen_as_the_wind_makes(executor: Executor, report: Report, preset: str, wind: float) -> None:
    """Monahan's share, of the water's pixels in the preset's own view; 16 frames of a breeze are sure to a third."""
    scene = load_preset(preset).scene
    water = below_horizon(scene.camera)
    shares = [float(view[..., 3][water].mean()) for view in views(executor, scene, range(0, 400, 25), "standard")]
    seen = float(np.mean(shares))
    report.add(
        "Foam in the view", preset=preset, law=f"{whitecaps(wind):.3f}", seen=f"{seen:.3f}", most=f"{max(shares):.3f}"
    )
    assert 0.6 < seen / whitecaps(wind) < 1.6
    if wind > 20.0:
        assert min(shares) > 0.5 * seen


def test_the_boat_is_seen_all_the_first_minute(executor: Executor) -> None:
    """Against frames with the boat behind the camera: without a boat the plan has other pixels, which differ too."""
    scene = load_preset("boat-in-storm").scene
    behind = scene.boats[0].model_copy(update={"centre": (0.0, 300.0)})
    seen, unseen = (views(executor, one, MINUTE) for one in (scene, scene.model_copy(update={"boats": (behind,)})))
    for one, other in zip(seen, unseen, strict=True):
        changed = np.abs(colours(one) - colours(other)).max(axis=-1) > 0.1
        assert changed.mean() > 0.005
        # With its reflection and shadow; the page's controls cover the foot of the picture.
        assert np.nonzero(changed)[0].mean() < 2.0 / 3.0 * LARGER[1]


def test_a_lake_at_sunset_is_not_black(executor: Executor) -> None:
    """At most a fiftieth of the picture is under 40 of 255 levels."""
    found = load_preset("lake-sunset")
    plan = make_plan(found.scene, TIERS["standard"])
    frame = draw(executor, plan, found.scene.camera, time=found.time, size=LARGER)
    assert (frame[..., :3].astype(np.float64) @ (0.2126, 0.7152, 0.0722) < 40.0).mean() < 0.02
