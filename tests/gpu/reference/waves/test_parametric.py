"""Parametric waves and ripples: the shader's sums against float64 at any time and place."""

import math
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.waves import parametric
from seafoam.effects.waves import ripples as ripples
from seafoam.reference.waves.parametric import ripple_set, wave_set
from support.exact import UNFILTERED
from support.probe import Probe
from support.report import Report
from support.scenes import ParametricWave, Ripples, Scene, Water

ORIGINS = ((0.0, 0.0), (1e7, -1e7))
TIMES = (0.0, 12.5, 3600.0, 1e9)
EXPONENTS = (0.75, 1.0, 1.4, 2.0, 3.5, 8.0, 30.0, 100.0)
PLACES = 10_000
FILES = ("lib/numbers.glsl", "waves/parametric.glsl")
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


@pytest.mark.parametrize("origin", ORIGINS, ids=str)
@pytest.mark.parametrize("time", TIMES)
def test_parametric_waves_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    """They displace nothing sideways, so their Jacobian is 1 by construction."""
    scene = Scene(waves=some_waves(), water=Water(depth=40.0))
    body = "y.xyz = parametric_waves(x.xy);"
    made = parametric.EFFECT.contribute(scene, UNFILTERED)
    got = probe.contributed(made, FILES, body, places(), time=time, origin=origin)[:, :3]
    waves = wave_set(scene, time, origin)
    x, z = places().astype(np.float64).T
    want = np.column_stack((waves.height(x, z), *waves.gradient(x, z)))
    height, slope = (np.abs(got - want)[:, part].max() for part in (slice(0, 1), slice(1, 3)))
    normal = between(got[:, 1:], want[:, 1:])
    report.add(
        "Parametric waves against float64, 16 waves, 10 000 places",
        time=f"{time:g} s",
        origin=f"{origin[0]:g} m",
        height=f"{1e6 * height:.0f} µm of {waves.top:.1f} m (bound 200)",
        slope=f"{1e6 * slope:.0f} millionths of {np.abs(want[:, 1:]).max():.1f} (bound 500)",
        normal=f"{1e6 * normal:.0f} µrad (bound 500)",
    )
    assert want[:, 0].std() > 0.05 * waves.top
    assert height <= 2e-4
    assert slope <= 5e-4
    assert normal <= 5e-4


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
    x, z = places().astype(np.float64).T
    want = np.column_stack(ripple_set(scene.water.ripples, time, origin).gradient(x, z))
    slope, normal = float(np.abs(got - want).max()), between(got, want)
    report.add(
        "Ripples against float64, 56 ripples, 10 000 places",
        time=f"{time:g} s",
        origin=f"{origin[0]:g} m",
        slope=f"{1e6 * slope:.0f} millionths of {np.abs(want).max():.2f} (bound 300)",
        normal=f"{1e6 * normal:.0f} µrad (bound 300)",
    )
    assert want.std() > 0.1
    assert slope <= 3e-4
    assert normal <= 3e-4
