"""Parametric waves, their groups, and ripples: the shader's sums against float64 at any time and place."""

import math
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.effect import Contribution
from seafoam.effects.waves import parametric, ripples
from seafoam.effects.waves.parametric import group_bounds, scaled_files, wave_files
from seafoam.reference import render
from seafoam.reference.waves.parametric import group_factor, ripple_set, wave_set
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
    ParametricWave,
    Ripples,
    Scene,
    SlopeSaturation,
    Water,
    WaveGroups,
)

PLACED = ((12.5, (0.0, 0.0)), (1e9, (1e7, -1e7)))
"""Times, s, and the eye's places, m."""
EXPONENTS = (0.75, 1.0, 1.4, 2.0, 3.5, 8.0, 30.0, 100.0)
PLACES = 10_000
REACH = 300.0
"""m from the eye: beyond, waves as short as these are filtered out of the picture."""


def some_waves() -> tuple[ParametricWave, ...]:
    """Sixteen waves of every shape, a metre to 200 m long, every way."""
    random = Random(3)
    made = []
    for i in range(16):
        length = math.exp(random.uniform(0.0, math.log(200.0)))
        made.append(
            ParametricWave(
                amplitude=0.05 * length * random.uniform(0.2, 1.0),
                wavelength=length,
                direction=random.uniform(-math.pi, math.pi),
                exponent=EXPONENTS[i % len(EXPONENTS)],
                phase=random.uniform(-math.pi, math.pi),
            )
        )
    return tuple(made)


def places() -> NDArray[np.float32]:
    return np.random.default_rng(11).uniform(-REACH, REACH, (PLACES, 2)).astype(np.float32)


def between(got: NDArray[np.float64], want: NDArray[np.float64]) -> float:
    """The greatest angle between the normals of two sets of slopes (n, 2), rad."""
    first, second = (np.column_stack((-s[:, 0], np.ones(len(s)), -s[:, 1])) for s in (got, want))
    first, second = (n / np.linalg.norm(n, axis=1, keepdims=True) for n in (first, second))
    return float(2.0 * np.arcsin(np.minimum(0.5 * np.linalg.norm(first - second, axis=1), 1.0)).max())


GROUPED = (
    ParametricWave(amplitude=1.1, wavelength=24.0, direction=0.4, exponent=2.0),
    ParametricWave(amplitude=0.6, wavelength=15.0, direction=-0.2, exponent=1.5, phase=1.0),
    ParametricWave(amplitude=0.3, wavelength=8.5, direction=0.9, exponent=1.4, phase=2.0),
)
SCENES = {
    "sixteen": Scene(waves=some_waves(), water=Water(depth=40.0)),
    "in groups": Scene(waves=GROUPED, wave_groups=WaveGroups(size=40.0, contrast=0.8, seed=5), water=Water(depth=40.0)),
}


@pytest.mark.whole
@pytest.mark.parametrize(("name", "most"), [("sixteen", (2e-4, 5e-4)), ("in groups", (3e-4, 3e-4))])
@pytest.mark.parametrize(("time", "origin"), PLACED, ids=str)
def test_waves_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float], name: str, most: tuple[float, float]
) -> None:
    """They displace nothing sideways, so their Jacobian is 1 by construction."""
    scene = SCENES[name]
    made, files = parametric.EFFECT.contribute(scene, UNFILTERED), ("lib/numbers.glsl", *wave_files(scene))
    got = probe.contributed(made, files, "y.xyz = parametric_waves(x.xy);", places(), time=time, origin=origin)[:, :3]
    waves = wave_set(scene, time, origin)
    x, z = places().astype(np.float64).T
    want = np.column_stack((waves.height(x, z), *waves.gradient(x, z)))
    assert want[:, 0].std() > 0.05 * waves.bounds.top
    report.within(
        "Parametric waves against float64, 10 000 places, height in m, slope, normal in rad",
        waves=name,
        time=time,
        origin=origin[0],
        height=(np.abs(got - want)[:, 0].max(), most[0]),
        slope=(np.abs(got - want)[:, 1:].max(), most[1]),
        normal=(between(got[:, 1:], want[:, 1:]), 5e-4),
    )


@pytest.mark.parametrize(("time", "origin"), PLACED, ids=str)
def test_ripples_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    """Ripples have slopes alone: no height and no displacement to compare."""
    scene = Scene(water=Water(ripples=Ripples(slope=0.2)))
    body = "y.xyz = ripples_detail(x.xy, Footprint(vec2(0.0), vec2(0.0)));"
    files = ("lib/numbers.glsl", "waves/ripples.glsl@bands", "waves/ripples.glsl@exact")
    made = ripples.EFFECT.contribute(scene, UNFILTERED)
    got = probe.contributed(made, files, body, places(), time=time, origin=origin)[:, :2]
    want = np.column_stack(ripple_set(scene.water.ripples, time, origin).gradient(*places().astype(np.float64).T))
    assert want.std() > 0.1
    report.within(
        "Ripples against float64, 56 ripples, 10 000 places, slope and normal in rad",
        time=time,
        origin=origin[0],
        slope=(np.abs(got - want).max(), 3e-4),
        normal=(between(got, want), 3e-4),
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


@pytest.mark.parametrize("seed", range(5))
def test_no_wave_exceeds_its_bounds(seed: int) -> None:
    """Slopes, differences of heights, and second differences over more than a texel."""
    groups = WaveGroups(size=30.0, contrast=1.0, seed=seed)
    scene = Scene(waves=SCENE.waves, wave_groups=groups)
    made, waves = contribution(scene), wave_set(scene, 0.0, (0.0, 0.0))
    rng = np.random.default_rng(seed)
    x, z = rng.uniform(-200.0, 200.0, (2, 100_000))
    heights = waves.height(x, z)
    steepest, most_bent = min(made.max_slope, waves.bounds.slope), min(made.max_curvature, waves.bounds.curvature)
    assert heights.max() <= made.max_height
    assert heights.min() >= made.min_height
    assert np.hypot(*waves.gradient(x, z)).max() <= steepest
    turn = rng.uniform(0.0, 2.0 * math.pi, x.shape)
    for step in (0.02, 1.0):
        ahead, behind = (waves.height(x + s * np.cos(turn), z + s * np.sin(turn)) for s in (step, -step))
        assert (np.abs(ahead - heights) / step).max() <= steepest
        assert ((ahead + behind - 2.0 * heights) / step**2).max() <= most_bent
    factor = group_factor(scene, 0.0, (0.0, 0.0))
    slope = group_bounds(scene)[0]
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
