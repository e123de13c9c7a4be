"""Groups of parametric waves: the shader's waves, fronts and frames against float64, and their bounds."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.effect import Contribution
from seafoam.effects.waves import parametric
from seafoam.effects.waves.groups import group_bounds, orbit_files, wave_files
from seafoam.planner import make_plan
from seafoam.reference import render
from seafoam.reference.foam.front import STILL, decaying_front
from seafoam.reference.types import SurfacePoints
from seafoam.reference.waves.groups import group_factor
from seafoam.reference.waves.parametric import wave_set
from seafoam.render.gl.executor import Executor
from support.exact import EXACT, UNFILTERED
from support.pictures import draw
from support.probe import Probe
from support.report import Report
from support.scenes import (
    Camera,
    Foam,
    FoamLife,
    FoamSource,
    FrontSaturation,
    Light,
    ParametricWave,
    Scene,
    SlopeSaturation,
    Water,
    WaveGroups,
)

WAVES = (
    ParametricWave(amplitude=1.1, wavelength=24.0, direction=0.4, exponent=2.0),
    ParametricWave(amplitude=0.6, wavelength=15.0, direction=-0.2, exponent=1.5, phase=1.0),
    ParametricWave(amplitude=0.3, wavelength=8.5, direction=0.9, exponent=1.4, phase=2.0),
)
GROUPS = WaveGroups(size=40.0, contrast=0.8, seed=5)
SCENE = Scene(waves=WAVES, wave_groups=GROUPS, water=Water(depth=40.0))
PLACES = 10_000


def places() -> NDArray[np.float32]:
    return np.random.default_rng(11).uniform(-300.0, 300.0, (PLACES, 2)).astype(np.float32)


def contribution(scene: Scene) -> Contribution:
    made = parametric.EFFECT.contribute(scene, UNFILTERED)
    assert made is not None
    return made


@pytest.mark.parametrize("origin", [(0.0, 0.0), (1e7, -1e7)], ids=str)
@pytest.mark.parametrize("time", [0.0, 1e9])
def test_waves_in_groups_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    files, body = ("lib/numbers.glsl", *wave_files(SCENE)), "y.xyz = parametric_waves(x.xy);"
    got = probe.contributed(contribution(SCENE), files, body, places(), time=time, origin=origin)[:, :3]
    waves = wave_set(SCENE, time, origin)
    x, z = places().astype(np.float64).T
    want = np.column_stack((waves.height(x, z), *waves.gradient(x, z)))
    height, slope = (np.abs(got - want)[:, part].max() for part in (slice(0, 1), slice(1, 3)))
    report.add(
        "Parametric waves in groups against float64, 10 000 places",
        time=f"{time:g} s",
        origin=f"{origin[0]:g} m",
        height=f"{1e6 * height:.0f} µm of {waves.top:.1f} m (bound 300)",
        slope=f"{1e6 * slope:.0f} millionths of {np.abs(want[:, 1:]).max():.1f} (bound 300)",
    )
    assert height <= 3e-4
    assert slope <= 3e-4
    even = wave_set(SCENE.model_copy(update={"wave_groups": None}), time, origin)
    factor = want[:, 0] / np.where(np.abs(even.height(x, z)) > 1e-6, even.height(x, z), np.nan)
    assert 0.2 - 1e-9 <= np.nanmin(factor) < 0.25
    assert 0.95 < np.nanmax(factor) <= 1.0 + 1e-9


def test_water_in_groups_is_carried_as_far_as_its_waves_are_high(probe: Probe) -> None:
    drifting = Foam(saturation=(SlopeSaturation(), FrontSaturation(decay=2.0)), life=FoamLife())
    scene = SCENE.model_copy(update={"foam": drifting})
    files = ("lib/numbers.glsl", *wave_files(scene), *orbit_files(scene))
    got = probe.contributed(contribution(scene), files, "y.xy = parametric_carry(x.xy);", places(), time=3.0)[:, :2]
    x, z = places().astype(np.float64).T
    want = np.column_stack(wave_set(scene, 3.0, (0.0, 0.0)).to_rest(x, z))
    assert np.abs(want).max() > 0.2
    assert np.abs(got - want).max() <= 1e-3


@pytest.mark.parametrize("seed", range(5))
def test_no_wave_exceeds_its_bounds(seed: int) -> None:
    """Slopes, differences of heights, and second differences over more than a texel."""
    groups = WaveGroups(size=30.0, contrast=1.0, seed=seed)
    scene = Scene(waves=WAVES, wave_groups=groups)
    made, waves = contribution(scene), wave_set(scene, 0.0, (0.0, 0.0))
    rng = np.random.default_rng(seed)
    x, z = rng.uniform(-200.0, 200.0, (2, 100_000))
    heights = waves.height(x, z)
    assert heights.max() <= made.max_height
    assert heights.min() >= made.min_height
    assert np.hypot(*waves.gradient(x, z)).max() <= min(made.max_slope, waves.slope)
    turn = rng.uniform(0.0, 2.0 * math.pi, x.shape)
    for step in (0.02, 1.0):
        ahead = waves.height(x + step * np.cos(turn), z + step * np.sin(turn))
        behind = waves.height(x - step * np.cos(turn), z - step * np.sin(turn))
        assert (np.abs(ahead - heights) / step).max() <= min(made.max_slope, waves.slope)
        assert ((ahead + behind - 2.0 * heights) / step**2).max() <= min(made.max_curvature, waves.curvature)
    factor = group_factor(scene, 0.0, (0.0, 0.0))
    assert factor is not None
    steepest = np.hypot(*factor.gradient(x, z)).max()
    assert 0.8 * group_bounds(scene).slope <= steepest <= group_bounds(scene).slope


SHARED: tuple[FoamSource, ...] = (FrontSaturation(intensity=7.0, group=(0.3, 1.3), decay=3.0, variation=0.2),)
OWN: tuple[FoamSource, ...] = (*SHARED, SlopeSaturation())
PRESENT: tuple[FoamSource, ...] = (FrontSaturation(constants="listing", intensity=7.0, group=(0.3, 0.9)),)


@pytest.mark.parametrize("sources", [SHARED, OWN, PRESENT], ids=["shared phases", "own phases", "listing"])
@pytest.mark.parametrize("carried", [False, True], ids=["still", "carried"])
def test_frames_are_the_float64_truth(
    executor: Executor, report: Report, sources: tuple[FoamSource, ...], *, carried: bool
) -> None:
    life = FoamLife(carried=carried, wind_drift=0.3)
    scene = Scene(
        waves=WAVES,
        wave_groups=GROUPS,
        foam=Foam(saturation=sources, look="filtered", mask="lace", life=life),
        light=Light(),
        camera=Camera(position=(2.0, 6.0, 1.0), yaw=0.8, pitch=-0.3),
    )
    got = draw(executor, make_plan(scene, EXACT), scene.camera, time=7.0, size=(96, 54), output="linear")
    want = render(scene, time=7.0, width=96, height=54)
    off = got[..., 3] - want.alpha
    error = np.abs(got[..., :3] - want.rgb).mean()
    report.add(
        "Waves in groups against float64, one sample a pixel",
        front=str(len(sources)),
        carried=str(carried),
        foam=f"{want.alpha.mean():.4f}",
        rmse=f"{np.sqrt((off**2).mean()):.5f}",
        light=f"{255.0 * error:.3f} levels",
    )
    assert want.alpha.mean() > 0.01
    assert np.sqrt((off**2).mean()) < 0.01
    assert 255.0 * error < 0.5


def test_groups_break_up_the_lattice_of_two_waves() -> None:
    """Two waves and their foam repeat every 20 m along x; in groups neither does."""
    turns = (math.pi / 3, -math.pi / 3)
    waves = tuple(ParametricWave(amplitude=0.4, wavelength=10.0, direction=turn, exponent=1.0) for turn in turns)
    source = FrontSaturation(intensity=7.0, group=(0.3, 0.9), decay=3.0)
    x, z = np.random.default_rng(5).uniform(-300.0, 300.0, (2, 4000))

    def alike(groups: WaveGroups | None) -> tuple[float, float]:
        scene = Scene(waves=waves, wave_groups=groups)
        of = wave_set(scene, 3.0, (0.0, 0.0))
        heights = [of.height(x + shift, z) for shift in (0.0, 20.0)]
        points = [SurfacePoints(x + shift, z, 0.0 * x, None, 1.0, 3.0, (0.0, 0.0)) for shift in (0.0, 20.0)]
        foam: Any = [decaying_front(source, of, one, 1.0, STILL) for one in points]
        return float(np.corrcoef(*heights)[0, 1]), float(np.corrcoef(*foam)[0, 1])

    assert min(alike(None)) > 0.999
    height, foam = alike(WaveGroups(size=30.0, contrast=1.0))
    assert height < 0.85
    assert foam < 0.5


def test_groups_travel_with_their_velocity() -> None:
    """In a second the factor, and not the waves, moves by the group velocity."""
    now, later = (group_factor(SCENE, time, (0.0, 0.0)) for time in (10.0, 11.0))
    assert now is not None
    assert later is not None
    x, z = places().astype(np.float64).T
    v_x, v_z = now.velocity
    # Half of √(gλ/2π) in deep water.
    assert math.hypot(v_x, v_z) == pytest.approx(0.5 * math.sqrt(9.81 * 24.0 / (2.0 * math.pi)), rel=1e-3)
    np.testing.assert_allclose(later(x + v_x, z + v_z), now(x, z), atol=1e-9)
    np.testing.assert_allclose(later(x, z, 1.0), now(x, z), atol=1e-9)
