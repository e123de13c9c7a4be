"""Groups of parametric waves: how they share out heights, what they carry, fronts and frames, and their bounds."""

import math

import numpy as np
import pytest

from gpu.reference.waves.test_parametric import SCENES, places
from seafoam.effects.effect import Contribution
from seafoam.effects.waves import parametric
from seafoam.effects.waves.groups import group_bounds, scaled_files, wave_files
from seafoam.reference import render
from seafoam.reference.waves.parametric import group_factor, wave_set
from seafoam.render.gl.executor import Executor
from support.exact import EXACT, UNFILTERED
from support.pictures import linear, rms
from support.probe import Probe
from support.report import Report
from support.scenes import (
    Camera,
    Foam,
    FoamLife,
    FoamSource,
    FrontSaturation,
    Scene,
    SlopeSaturation,
    Water,
    WaveGroups,
)


def contribution(scene: Scene) -> Contribution:
    return parametric.EFFECT.contribute(scene, UNFILTERED)


def test_water_in_groups_is_carried_as_far_as_its_waves_are_high(probe: Probe) -> None:
    drifting = Foam(saturation=(SlopeSaturation(), FrontSaturation(decay=2.0)), life=FoamLife())
    scene = SCENE.model_copy(update={"foam": drifting})
    carry = scaled_files(scene, "foam/carry.glsl@parametric", "waves/groups.glsl@carry")
    files = ("lib/numbers.glsl", *wave_files(scene), *carry)
    got = probe.contributed(contribution(scene), files, "y.xy = parametric_carry(x.xy);", places(), time=3.0)[:, :2]
    x, z = places().astype(np.float64).T
    want = np.column_stack(wave_set(scene, 3.0, (0.0, 0.0)).to_rest(x, z))
    assert np.abs(want).max() > 0.2
    assert np.abs(got - want).max() <= 1e-3


SCENE = SCENES["in groups"]


@pytest.mark.parametrize(("time", "origin"), [(0.0, (0.0, 0.0)), (1e9, (1e7, -1e7))])
def test_groups_are_of_the_waves_height_and_of_as_little_as_their_contrast_leaves(
    time: float, origin: tuple[float, float]
) -> None:
    x, z = places().astype(np.float64).T
    grouped, even = (
        wave_set(scene, time, origin).height(x, z) for scene in (SCENE, SCENE.model_copy(update={"wave_groups": None}))
    )
    factor = grouped / np.where(np.abs(even) > 1e-6, even, np.nan)
    assert 0.2 - 1e-9 <= np.nanmin(factor) < 0.25
    assert 0.95 < np.nanmax(factor) <= 1.0 + 1e-9


@pytest.mark.parametrize("seed", range(5))
def test_no_wave_exceeds_its_bounds(seed: int) -> None:
    """Slopes, differences of heights, and second differences over more than a texel."""
    groups = WaveGroups(size=30.0, contrast=1.0, seed=seed)
    scene = Scene(waves=SCENE.waves, wave_groups=groups)
    made, waves = contribution(scene), wave_set(scene, 0.0, (0.0, 0.0))
    rng = np.random.default_rng(seed)
    x, z = rng.uniform(-200.0, 200.0, (2, 100_000))
    heights = waves.height(x, z)
    steepest, most_bent = min(made.max_slope, waves.slope), min(made.max_curvature, waves.curvature)
    assert heights.max() <= made.max_height
    assert heights.min() >= made.min_height
    assert np.hypot(*waves.gradient(x, z)).max() <= steepest
    turn = rng.uniform(0.0, 2.0 * math.pi, x.shape)
    for step in (0.02, 1.0):
        ahead, behind = (waves.height(x + s * np.cos(turn), z + s * np.sin(turn)) for s in (step, -step))
        assert (np.abs(ahead - heights) / step).max() <= steepest
        assert ((ahead + behind - 2.0 * heights) / step**2).max() <= most_bent
    factor = group_factor(scene, 0.0, (0.0, 0.0))
    slope = group_bounds(scene).slope
    assert 0.8 * slope <= np.hypot(*factor.gradient(x, z)).max() <= slope


SHARED: tuple[FoamSource, ...] = (FrontSaturation(intensity=7.0, group=(0.3, 1.3), decay=3.0, variation=0.2),)
OWN: tuple[FoamSource, ...] = (*SHARED, SlopeSaturation())
PRESENT: tuple[FoamSource, ...] = (FrontSaturation(constants="listing", intensity=7.0, group=(0.3, 0.9)),)


@pytest.mark.parametrize("sources", [SHARED, OWN, PRESENT], ids=["shared phases", "own phases", "listing"])
@pytest.mark.parametrize("carried", [False, True], ids=["still", "carried"])
def test_frames_are_the_float64_truth(
    executor: Executor, report: Report, sources: tuple[FoamSource, ...], *, carried: bool
) -> None:
    life = FoamLife(carried=carried, wind_drift=0.3)
    foam = Foam(saturation=sources, look="filtered", mask="lace", life=life)
    camera = Camera(position=(2.0, 6.0, 1.0), yaw=0.8, pitch=-0.3)
    scene = SCENE.model_copy(update={"foam": foam, "camera": camera, "water": Water()})
    got = linear(executor, scene, EXACT, time=7.0, size=(96, 54))
    want = render(scene, time=7.0, width=96, height=54)
    assert want.alpha.mean() > 0.01
    report.within(
        "Waves in groups against float64, one sample a pixel, light in levels",
        front=len(sources),
        carried=carried,
        foam=(rms(got[..., 3] - want.alpha), 0.01),
        light=(255.0 * np.abs(got[..., :3] - want.rgb).mean(), 0.5),
    )


def test_groups_travel_with_their_velocity() -> None:
    """In a second the factor, and not the waves, moves by the group velocity."""
    now, later = (group_factor(SCENE, time, (0.0, 0.0)) for time in (10.0, 11.0))
    x, z = places().astype(np.float64).T
    v_x, v_z = now.velocity
    # Half of √(gλ/2π) in deep water.
    assert math.hypot(v_x, v_z) == pytest.approx(0.5 * math.sqrt(9.81 * 24.0 / (2.0 * math.pi)), rel=1e-3)
    np.testing.assert_allclose(later(x + v_x, z + v_z), now(x, z), atol=1e-9)
    np.testing.assert_allclose(later(x, z, 1.0), now(x, z), atol=1e-9)
