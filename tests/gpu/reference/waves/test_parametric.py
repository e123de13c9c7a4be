"""Parametric waves and ripples: the shader's sums against float64 at any time and place."""

import math
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.waves import parametric, ripples
from seafoam.effects.waves.parametric import wave_files
from seafoam.reference.waves.parametric import ripple_set, wave_set
from support.exact import UNFILTERED
from support.probe import Probe
from support.report import Report
from support.scenes import ParametricWave, Ripples, Scene, Water, WaveGroups

ORIGINS = ((0.0, 0.0), (1e7, -1e7))
TIMES = (0.0, 12.5, 3600.0, 1e9)
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
@pytest.mark.parametrize("origin", ORIGINS, ids=str)
@pytest.mark.parametrize("time", TIMES)
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
    assert want[:, 0].std() > 0.05 * waves.top
    report.within(
        "Parametric waves against float64, 10 000 places, height in m, slope, normal in rad",
        waves=name,
        time=time,
        origin=origin[0],
        height=(np.abs(got - want)[:, 0].max(), most[0]),
        slope=(np.abs(got - want)[:, 1:].max(), most[1]),
        normal=(between(got[:, 1:], want[:, 1:]), 5e-4),
    )


@pytest.mark.parametrize("origin", ORIGINS, ids=str)
@pytest.mark.parametrize("time", TIMES)
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
