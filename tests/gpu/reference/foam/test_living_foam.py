"""Foam that lives: where it lies, how it gathers, of which mask it is, how it goes (docs/formulae.md, 4 to 6 and 8)."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.waves.stokes import first_harmonic, foam_drift
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.reference.foam import coverage
from seafoam.reference.foam.front import decaying_front
from seafoam.reference.types import SurfacePoints
from seafoam.reference.waves.parametric import wave_set
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import linear, rms
from support.report import Report
from support.scenes import (
    Camera,
    Foam,
    FoamLife,
    FrontSaturation,
    HeightSaturation,
    ParametricWave,
    Scene,
)

Floats = NDArray[np.float64]
HALF = (HeightSaturation(base=-0.45, full=0.55),)
"""0.45 on still water."""
DOWN = Camera(position=(0.37, 9.0, -0.21), pitch=-math.pi / 2)
WINDY = FoamLife(windrows=1.0, windrow_spacing=3.0, wind_drift=0.4, wind_direction=0.7)


def places(count: int, side: float = 4000.0) -> Floats:
    return np.random.default_rng(3).uniform(0.0, side, (2, count))


def drawn(executor: Executor, scene: Scene, time: float, camera: Camera | None = None) -> NDArray[np.float32]:
    """Linear pixels, (54, 96, 4)."""
    return linear(executor, scene, EXACT, camera, time=time, size=(96, 54))


def test_foam_drifts_as_a_whole_on_still_water(executor: Executor) -> None:
    """Ten seconds later the foam is that of ten drifts upwind."""
    scene = Scene(foam=Foam(saturation=HALF, mask="lace", octaves=2, life=WINDY), light=None)
    u, w = foam_drift(scene)
    assert math.hypot(u, w) == pytest.approx(0.4, abs=1e-6)
    x, y, z = DOWN.position
    upwind = DOWN.model_copy(update={"position": (x - 10.0 * u, y, z - 10.0 * w)})
    here, there = drawn(executor, scene, 0.0, upwind), drawn(executor, scene, 10.0, DOWN)
    assert np.abs(here - there).max() < 2e-3
    assert np.abs(here - drawn(executor, scene, 0.0, DOWN)).mean() > 0.05


def test_water_carries_its_foam_in_circles() -> None:
    """Water that rests at X is at X − a cos θ: the pattern is pressed together on the crest, by 1 + ak."""
    wave = ParametricWave(amplitude=0.1, wavelength=8.0, exponent=1.0, direction=0.4)
    scene = Scene(waves=(wave,))
    a, k = first_harmonic(0.1, 1.0), 2.0 * math.pi / 8.0
    assert a == pytest.approx(0.05)
    s = np.linspace(0.0, 8.0, 4001)
    x, z = s * math.cos(0.4), s * math.sin(0.4)
    waves = wave_set(scene, 1.3, (0.0, 0.0))
    way = waves.to_rest(x, z)
    along = way[0] * math.cos(0.4) + way[1] * math.sin(0.4)
    assert np.abs(way[1] * math.cos(0.4) - way[0] * math.sin(0.4)).max() < 1e-12
    assert along.max() == pytest.approx(a, rel=1e-6)
    crest = int(np.argmax(waves.height(x, z)[200:-200])) + 200
    assert np.gradient(along, s)[crest] == pytest.approx(a * k, rel=1e-3)
    # In water half a wavelength deep and less the circles are flat.
    shallow = scene.model_copy(update={"water": scene.water.model_copy(update={"depth": 0.8})})
    assert wave_set(shallow, 1.3, (0.0, 0.0)).orbit[0] > 1.35 * a


def test_windrows_share_out_what_there_is(report: Report) -> None:
    """In the mean over many rows s stays s, anywhere between none and all."""
    life = FoamLife(windrows=1.0, windrow_spacing=2.0)
    scene = Scene(foam=Foam(life=life))
    x, z = places(400_000)
    for s in (0.0, 0.03, 0.4, 0.8, 1.0):
        rows = coverage.gathered(scene, 7.0, (0.0, 0.0), np.full(x.shape, s), x, z)
        assert rows.min() >= 0.0
        assert rows.max() <= 1.0
        assert rows.mean() == pytest.approx(s, abs=0.003)
        if s == 0.4:
            assert rows.std() > 0.1


def test_masks_of_all_ages_cover_what_one_would() -> None:
    """What no mask covers stays free: the product of what each leaves is 1 − s."""
    f = np.linspace(0.005, 0.99, 2000)
    s = 0.9 * f
    for masks in (1, 2, 3):
        shares = coverage.shares(masks, s, f)
        free = np.prod([1.0 - share for _, share in shares], axis=0)
        assert np.abs(1.0 - free - s).max() < 1e-12
        assert np.abs(sum(weight for weight, _ in shares) - 1.0).max() < 1e-12
    young, torn, streak = (weight for weight, _ in coverage.shares(3, s, f))
    assert (young[f > 0.9] == 1.0).all()
    assert (torn[np.abs(f - math.exp(-0.8)) < 0.02] == 1.0).all()
    assert (streak[f < math.exp(-1.6)] == 1.0).all()


ONE = Scene(waves=(ParametricWave(amplitude=0.3, wavelength=9.0, direction=0.3),))


def foam_of(scene: Scene, source: FrontSaturation, time: float, x: Any, z: Any) -> Floats:
    """Saturation at places of still water, (r,)."""
    waves = wave_set(scene, time, (0.0, 0.0))
    points = SurfacePoints(x, z, 0.0 * x, None, 1.0, time, (0.0, 0.0))
    return decaying_front(source, waves, points, 1.0, (0.0, 0.0), False)


@pytest.mark.parametrize("decay", [1.5, 3.7])
def test_foam_behind_a_front_decays_by_the_second(decay: float) -> None:
    """By e in each `decay` seconds, from the moment that the paper's front is no longer whole."""
    source = FrontSaturation(intensity=7.0, decay=decay)
    x, z = np.zeros(1), np.zeros(1)
    times = np.arange(0.0, 2.4, 0.01)
    f = np.array([foam_of(ONE, source, t, x, z)[0] for t in times])
    front = int(np.argmax(np.diff(f)))
    assert f[front + 1] == 1.0
    fading = np.flatnonzero((f < 0.999) & (np.arange(f.size) > front))
    slope = np.gradient(np.log(f[fading]), times[fading])
    assert np.abs(slope[1:-1] * decay + 1.0).max() < 1e-3


def test_a_footprint_sees_the_mean_of_what_fronts_left(executor: Executor) -> None:
    """Straight down, where no wave hides: once a pixel as the mean of 64 places."""
    source = FrontSaturation(intensity=7.0, group=(0.2, 0.6), decay=2.0)
    waves = (ParametricWave(amplitude=1e-3, wavelength=9.0), ParametricWave(amplitude=1e-3, wavelength=6.0))
    camera = Camera(position=(0.0, 60.0, 0.0), pitch=-math.pi / 2, fov=0.5)
    foam = Foam(saturation=(source,), mask="vac-1.5", mask_tile=0.5)
    scene = Scene(waves=waves, foam=foam, light=None, camera=camera)
    off = linear(executor, scene, TIERS["standard"], time=4.0, size=(48, 27))[..., 3]
    off = off - render(scene, time=4.0, width=48, height=27, samples=8, mode="converged").alpha
    assert abs(off.mean()) < 0.01
    assert rms(off) < 0.06


def test_masks_of_another_size_and_cells_are_left_out() -> None:
    """Another mask may be chosen for foam that lives: older masks that do not fit go, and so do cells."""
    alone = make_plan(Scene(foam=Foam(mask="lace:4:64:1", life=FoamLife(masks=()))), TIERS["standard"])
    small = make_plan(Scene(foam=Foam(mask="lace:4:64:1", life=FoamLife(), cells=True)), TIERS["standard"])
    assert small.programs == alone.programs
    assert small.textures == alone.textures
