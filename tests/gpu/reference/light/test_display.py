"""The display of a finished frame, tone curves and glare, against their float64 forms (docs/formulae.md, section 7)."""

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.light import display
from seafoam.render.gl.executor import Executor
from support.float64 import glare
from support.pictures import ROUNDED
from support.report import Report
from support.scenes import Camera, Light, Ripples, Scene, Sky, Water

SUN = Camera(position=(0.0, 3.0, 0.0), yaw=np.pi / 2, pitch=0.1, fov=0.7)


def scene(**of_light: object) -> Scene:
    """The sun over rippled water, in the middle of the picture."""
    return Scene(light=Light(sun_elevation=0.1, sky=Sky(), **of_light), water=Water(ripples=Ripples()))


def both(executor: Executor, of: Scene, size: tuple[int, int]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Linear frame and picture, levels; rows from the top."""
    plan = make_plan(of, TIERS["standard"])
    linear, shown = (
        executor.render(plan, time=1.0, camera=SUN, width=size[0], height=size[1], output=output).pixels[..., :3]
        for output in ("linear", "rgba8")
    )
    return linear.astype(np.float64), shown.astype(np.float64)


@pytest.mark.parametrize("size", [(160, 90), (149, 83), (60, 34), (5, 3)])
@pytest.mark.parametrize(("tone", "share"), [("filmic", 0.0), ("photographic", 0.0), ("photographic", 0.3)])
def test_a_picture_is_its_linear_frame_by_the_formula(
    executor: Executor, report: Report, size: tuple[int, int], tone: str, share: float
) -> None:
    linear, shown = both(executor, scene(tone=tone, glare=share), size)
    spread = glare.spread(linear[::-1], share)[::-1]
    off = np.abs(shown - 255.0 * display.srgb(display.tone(np.maximum(spread, 0.0), tone)))
    # Rounding, and half floats of the levels.
    bound = ROUNDED if share == 0.0 else 1.0
    title = "A picture against its linear frame in float64, levels"
    report.within(title, size=f"{size[0]} × {size[1]}", tone=tone, glare=share, worst=(off.max(), bound))


def test_glare_keeps_the_light() -> None:
    """Of a frame whose rim is dark; what spreads is at most the share, and no level of it has a seam."""
    frame = np.zeros((360, 640, 3))
    frame[180:184, 320:324] = (900.0, 500.0, 100.0)
    spread = glare.spread(frame, 0.3)
    assert spread.sum() == pytest.approx(frame.sum(), rel=2e-3)
    assert spread[181, 321] == pytest.approx(frame[181, 321], rel=0.3)
    assert (spread >= -1e-9).all()
    ring = [float(spread[182, 322 + r, 0]) for r in (8, 16, 32, 64)]
    falls = [a / b for a, b in itertools.pairwise(ring)]
    # Twice as far, a quarter as bright: between the steps of the levels.
    assert all(2.0 < fall < 9.0 for fall in falls), falls


def test_linear_frames_are_without_glare(executor: Executor) -> None:
    plain, _ = both(executor, scene(), (96, 54))
    spread, _ = both(executor, scene(glare=0.4), (96, 54))
    assert (plain == spread).all()
