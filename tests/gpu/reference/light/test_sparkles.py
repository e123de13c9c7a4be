"""Sparkles and the lake's highlight: GLSL against float64, and the mean of sparkles (docs/formulae.md, section 12)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.light.glitter import density
from seafoam.reference.light.sparkles import EPOCHS, SparkleField
from support.probe import Probe, stand_in
from support.report import Report
from support.scenes import Sparkles

SPARKLES = Sparkles(size=0.004, rate=3.0, life=0.4, share=1.0)
FILES = (
    "lib/numbers.glsl",
    "lib/rays.glsl@camera",
    stand_in("no_glint"),
    "lib/noise.glsl@hash",
    "light/glitter.glsl@sparkles",
)


def looks(count: int, seed: int = 1) -> NDArray[np.float64]:
    """Unit vectors below the horizon, even over the half sphere; float32 numbers."""
    random = np.random.default_rng(seed)
    y, turn = -random.random(count), 2.0 * math.pi * random.random(count)
    level = np.sqrt(1.0 - y * y)
    d = np.stack((level * np.cos(turn), y, level * np.sin(turn)), axis=-1).astype(np.float32).astype(np.float64)
    return d / np.sqrt((d * d).sum(axis=1, keepdims=True))


def probed(probe: Probe, d: NDArray[np.float64], w: float, time: float, cells: int = 4) -> NDArray[np.float64]:
    radius = 0.5 * SPARKLES.size
    return probe(
        FILES,
        f"y.x = sparkle_light(normalize(x.xyz), x.w, {radius:.9g}, {4.0 * radius:.9g});",
        np.column_stack([d, np.full(len(d), w)]),
        consts={"SPARKLE_CELLS": cells},
        uniforms={
            "u_sparkle_radius": radius,
            "u_sparkle_density": density(SPARKLES),
            "u_sparkle_life": SPARKLES.life,
            "u_sparkle_time": [math.fmod(time, SPARKLES.life), math.fmod(time, SPARKLES.life * EPOCHS)],
        },
    )[:, 0].astype(np.float64)


@pytest.mark.parametrize("time", [0.0, 12.34, 1e9])
@pytest.mark.parametrize("w", [0.03, 1.0, 30.0])
def test_sparkles_equal_their_float64_form(probe: Probe, w: float, time: float) -> None:
    d = looks(100_000)
    got = probed(probe, d, w, time)
    want = SparkleField(SPARKLES, time, 0.0).light(d, np.full(len(d), w))
    assert (want > 0.0).sum() > 100
    # A hash that lies within rounding of its chance falls either way.
    away = np.abs(got - want) / max(w, want.max())
    assert (away > 2e-3).mean() <= 1e-4
    assert away.mean() <= 1e-4


@pytest.mark.parametrize("cells", [1, 4])
@pytest.mark.parametrize("w", [0.3, 3.0, 300.0])
def test_their_mean_is_the_smooth_glint(probe: Probe, report: Report, w: float, cells: int) -> None:
    """Over the half sphere, at 24 times."""
    d = looks(200_000)
    ratio = float(np.mean([probed(probe, d, w, 1.37 + 0.53 * i, cells).mean() for i in range(24)])) / w
    title = "Mean light of sparkles over the smooth glint's"
    report.within(title, cells=cells, glint=w, ratio=ratio, off=(abs(ratio - 1.0), 0.02))
