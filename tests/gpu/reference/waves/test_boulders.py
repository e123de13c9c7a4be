"""Stones that stand over a current: their pixels against float64, and what their shape keeps to."""

import numpy as np
import pytest

from seafoam.ocean.coast.boulders import BOULDER_REACH, cuts
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.reference.waves.boulders import norm_of
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import levels, linear, samples
from support.report import Report
from support.scenes import (
    Camera,
    Current,
    Foam,
    Light,
    ParametricWave,
    Scene,
    Shore,
    Stone,
    Surf,
    WakeSaturation,
    Water,
)

STONES = Current(
    speed=2.2,
    direction=1.2,
    stones=(
        Stone(place=(-1.0, -7.0), radius=0.9, waves=0.3, height=0.8),
        Stone(place=(0.6, -9.5), radius=1.0, waves=0.3, height=0.5),
        Stone(place=(3.0, -11.0), radius=0.7, waves=0.0, height=1.2),
    ),
)
OPEN = Scene(
    current=STONES,
    foam=Foam(saturation=(WakeSaturation(amount=0.8, life=2.0),), look="filtered", mask="clump"),
    camera=Camera(position=(0.0, 2.0, 0.0), pitch=-0.2),
    light=Light(sun_elevation=0.3, sun_azimuth=-1.0, exposure=-2.0),
)
WAVES = (ParametricWave(amplitude=0.3, wavelength=5.0, direction=0.7),)
BANK = Shore(kind="island", place=(20.0, -40.0), size=160.0, radius=25.0, depth=6.0, surf=Surf(height=0.0), detail=1.0)
SCENES = {
    "open": OPEN,
    "front light": OPEN.model_copy(update={"light": Light(sun_elevation=0.5, sun_azimuth=1.9, exposure=-2.0)}),
    "waves": OPEN.model_copy(update={"waves": WAVES, "foam": None}),
    "bank": OPEN.model_copy(update={"shore": BANK, "waves": WAVES}),
    "below": OPEN.model_copy(update={"camera": Camera(position=(0.0, -0.8, 0.0)), "water": Water(depth=2.5)}),
    "dark": OPEN.model_copy(update={"light": None}),
}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.whole
def test_stones_against_float64(executor: Executor, report: Report, name: str) -> None:
    scene, size = SCENES[name], (64, 36)
    truth = render(scene, time=3.0, width=64, height=36).rgb
    seen = samples(executor, scene, EXACT, scene.camera, time=3.0, size=size)
    low = tuple(stone.model_copy(update={"height": 0.0}) for stone in STONES.stones)
    bare = scene.model_copy(update={"current": STONES.model_copy(update={"stones": low})})
    without = levels(samples(executor, bare, EXACT, scene.camera, time=3.0, size=size), truth)
    away = levels(seen, truth)
    share = float((away > 2.0).mean())
    report.within("Stones against float64, 64 × 36, levels", scene=name, mean=(away.mean(), 0.1), over_2=(share, 0.004))
    assert without.mean() > 10.0 * away.mean()


@pytest.mark.parametrize("tier", ["fast", "standard"])
def test_wide_pixels_and_rectangles_in_one_leave_stones_as_they_are(executor: Executor, tier: str) -> None:
    """Ways to the water between samples, and rectangles that overlap: against all samples at full width."""
    scene, quality = SCENES["bank"], TIERS[tier]
    square = quality.model_copy(update={"pixel_width": 1})
    wide, full = (linear(executor, scene, one, scene.camera, time=3.0, size=(320, 180)) for one in (quality, square))
    # The stones' own pixels: dark against the water.
    drawn = levels(wide, full)[80:150, 60:220]
    assert np.median(drawn) < 3.0
    assert (drawn > 30.0).mean() < 0.05


def test_a_stone_is_convex_within_its_reach_and_as_high_as_asked() -> None:
    rng = np.random.default_rng(3)
    for stone in STONES.stones:
        a, b = rng.uniform(-1.5, 1.5, (2, 2000, 3))
        middle = norm_of(stone, 0.5 * (a + b))[0]
        assert (middle <= 0.5 * (norm_of(stone, a)[0] + norm_of(stone, b)[0]) + 1e-12).all()
        inside = a[norm_of(stone, a)[0] < 1.0]
        assert np.hypot(inside[:, 0], inside[:, 2]).max() <= BOULDER_REACH
        top = stone.radius * inside[:, 1].max()
        assert 0.45 * stone.height * stone.radius < top <= stone.dome
    assert not np.allclose(cuts(STONES.stones[0]), cuts(STONES.stones[1]))


def test_no_pass_draws_stones_where_none_stands_over_the_water() -> None:
    low = STONES.model_copy(update={"stones": tuple(s.model_copy(update={"height": 0.0}) for s in STONES.stones)})
    for current, count in ((STONES, 1), (low, 0), (None, 0)):
        plan = make_plan(OPEN.model_copy(update={"current": current}), TIERS["standard"])
        assert sum(one.program == "boulders" and "over" in one.eye for one in plan.passes) == count
