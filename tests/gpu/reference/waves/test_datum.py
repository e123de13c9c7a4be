"""y = 0 is still water in every scene, drawn and in float64. docs/formulae.md, *Heights*."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.basics.dispersion import wave_level
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.planner import make_plan
from seafoam.reference.boats.wake import wake_set
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.probe import shown
from support.report import Report
from support.scenes import Boat, Camera, ParametricWave, Ring, Scene, Sea

Floats = NDArray[np.float64]
TIMES = tuple(3.7 * i for i in range(8))
TEXELS = 128
"""A side of a sea's tile: as few as hold its waves."""
QUALITY = EXACT.model_copy(update={"sea_size": TEXELS})
SPAN = 4000.0
"""Side of the square whose places are drawn, m."""

PAPER = (
    ParametricWave(amplitude=1.2, wavelength=18.0, exponent=3.0),
    ParametricWave(amplitude=0.35, wavelength=11.3, direction=0.9, exponent=2.0, phase=1.7),
    ParametricWave(amplitude=0.2, wavelength=4.1, direction=-0.6, exponent=0.7),
)
NEAR = Boat(centre=(0.0, 0.0), radius=40.0, speed=5.0, wake=0.5)
FAR = NEAR.model_copy(update={"centre": (6000.0, 0.0)})
"""Out of sight, and its wake with it."""


def heights(executor: Executor, scene: Scene, time: float) -> Floats:
    """The drawn surface at 10,000 places, m."""
    over = scene.model_copy(update={"camera": Camera(position=(13.0, 400.0, -7.0), pitch=-math.pi / 2)})
    return shown(executor, over, "o_color = vec4(waves(p).x);", SPAN, time=time, quality=QUALITY)[:, 0]


def truth(_: Executor, scene: Scene, time: float) -> Floats:
    """The same number of heights in float64, at other places."""
    x, z = np.random.default_rng(int(time)).uniform(-0.5 * SPAN, 0.5 * SPAN, (2, 10_000))
    total = wave_set(scene, time, (0.0, 0.0)).height(x, z) + ring_set(scene, time, (0.0, 0.0)).height(x, z)
    if scene.boats:
        total += wake_set(scene, time, (0.0, 0.0)).height(x, z)
    sea = sea_surface(scene, time, (0.0, 0.0), TEXELS)
    return total if sea is None else total + sea.height(x, z)


def drawn_together(scene: Scene) -> float:
    """By how much a choppy sea's mean lies under still water, m: Σ ½λka² of its raised waves, a their amplitude."""
    if scene.sea is None:
        return 0.0
    raised = cascades(scene.sea, scene.water.depth)[:RAISED]
    return sum(
        of.choppiness(scene.sea.choppiness) * float((0.5 * of.k * (2.0 * np.abs(of.h0)) ** 2).sum()) for of in raised
    )


SCENES = {
    "the paper's waves": Scene(waves=PAPER),
    "a sea without choppiness": Scene(sea=Sea(wind=12.0, choppiness=0.0)),
    "a choppy sea": Scene(sea=Sea(wind=12.0, choppiness=1.0)),
    "all together": Scene(
        waves=PAPER,
        sea=Sea(wind=6.0),
        rings=(Ring(birth=-4.0, amplitude=0.4, decay=0.1, wavelength=6.0),),
        boats=(NEAR,),
    ),
}
WAYS: dict[str, Callable[[Executor, Scene, float], Floats]] = {"drawn": heights, "float64": truth}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("way", WAYS)
def test_the_mean_height_is_still_water(executor: Executor, report: Report, way: str, name: str) -> None:
    """Within four standard errors, which are far less than a hundredth of the waves' greatest height."""
    scene = SCENES[name]
    means = np.array([WAYS[way](executor, scene, time).mean() for time in TIMES])
    error = float(means.std(ddof=1)) / math.sqrt(means.size)
    top, lower = make_plan(scene, QUALITY).top, drawn_together(scene)
    report.within(
        "Mean height of the surface over many places and times, m",
        scene=name,
        way=way,
        expected=-lower,
        off=(abs(float(means.mean()) + lower), 4.0 * error + 1e-4 * top),
        standard_error=(error, 0.005 * top),
    )


@pytest.mark.parametrize(("exponent", "mean"), [(0.5, 2.0 / math.pi), (1.0, 0.5), (2.0, 3.0 / 8.0), (3.0, 5.0 / 16.0)])
def test_the_mean_of_a_wave_is_the_analytic_one(exponent: float, mean: float) -> None:
    scene = Scene(waves=(ParametricWave(amplitude=2.0, exponent=exponent),))
    assert wave_level(scene.waves[0]) == pytest.approx(2.0 * mean, rel=1e-12)
    assert wave_set(scene, 0.0, (0.0, 0.0)).level == pytest.approx(2.0 * mean, rel=1e-12)


def test_where_no_ring_and_no_wake_is_water_is_still(executor: Executor) -> None:
    """Exactly at 0, however high they are elsewhere."""
    rings = (Ring(place=(0.0, 1e5), amplitude=2.0),)
    scene = Scene(rings=rings, boats=(FAR.model_copy(update={"centre": (0.0, 1e5)}),))
    assert all((of(executor, scene, 3.0) == 0.0).all() for of in WAYS.values())
