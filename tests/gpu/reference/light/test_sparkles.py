"""Sparkles and the lake's highlight: GLSL against float64, and the mean of sparkles (docs/formulae.md, section 12)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.light.glitter import density
from seafoam.effects.shader import Inline
from seafoam.reference.light import light as reference_light
from seafoam.reference.light.sparkles import EPOCHS, SparkleField
from seafoam.render.gl.executor import Executor
from support.exact import SQUARE
from support.pictures import linear
from support.probe import Probe, stand_in
from support.report import Report
from support.scenes import Camera, Light, Scene, Sparkles, Water

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


WIDE_RANGE = SQUARE.model_copy(update={"target": "RGBA32F"})


@pytest.mark.parametrize("cells", [1, 4])
@pytest.mark.parametrize("w", [0.3, 3.0, 300.0])
def test_their_mean_is_the_smooth_glint(probe: Probe, report: Report, w: float, cells: int) -> None:
    """Over the half sphere, at 24 times."""
    d = looks(200_000)
    ratio = float(np.mean([probed(probe, d, w, 1.37 + 0.53 * i, cells).mean() for i in range(24)])) / w
    title = "Mean light of sparkles over the smooth glint's"
    report.within(title, cells=cells, glint=w, ratio=ratio, off=(abs(ratio - 1.0), 0.02))


def test_they_swell_and_fade_without_a_jump() -> None:
    d = looks(20_000)
    w = np.full(len(d), 0.1)
    times = 5.0 + 0.4 * np.arange(0.0, 1.5, 2e-3)
    seen = np.flatnonzero(SparkleField(SPARKLES, 5.2, 0.0).light(d, w) > 0.0)[:30]
    course = np.array([SparkleField(SPARKLES, time, 0.0).light(d[seen], w[seen]) for time in times])
    assert np.abs(np.diff(course, axis=0)).max() <= 0.03 * course.max()
    # One that lives next to it may stand there all the while.
    assert (course == 0.0).any(axis=0).mean() >= 0.9


SUNSET = Light(sun_elevation=0.15, sun_azimuth=-math.pi / 2, visibility=1e6)
VIEW = Camera(position=(0.0, 6.0, 0.0), pitch=-0.1, fov=0.12)
FEW = Sparkles(size=0.001, rate=6.0, life=0.3, share=1.0)


def test_a_sparkle_is_as_large_in_every_picture(executor: Executor) -> None:
    """Share of the water under bright sparkles, at once and twice the pixels along each side."""
    large = FEW.model_copy(update={"size": 0.004, "rate": 0.1})
    scene = Scene(water=Water(roughness=0.17), light=SUNSET.model_copy(update={"sparkles": large}))
    shares = [
        float((linear(executor, scene, WIDE_RANGE, VIEW, time=3.0, size=size)[..., 1] > 30.0).mean())
        for size in ((480, 270), (960, 540))
    ]
    assert shares[0] > 1e-3
    assert abs(shares[1] / shares[0] - 1.0) <= 0.03


@pytest.mark.parametrize("power", [1.0, 364.0, 2000.0])
@pytest.mark.parametrize("perturb", [0.0, 0.4, 10.0])
def test_the_lakes_highlight_equals_its_float64_form(probe: Probe, power: float, perturb: float) -> None:
    light = Light(sun_elevation=0.3, sun_azimuth=-1.2)
    air = reference_light.air(light)
    d = looks(4000)
    slopes = np.random.default_rng(2).normal(0.0, 0.3, (4000, 2)).astype(np.float32).astype(np.float64)
    n = np.column_stack([-slopes[:, 0], np.ones(4000), -slopes[:, 1]])
    n /= np.sqrt((n * n).sum(axis=1, keepdims=True))
    want = reference_light.blinn_phong(air, power, perturb, d, n, np.ones(4000), 0.0)
    # A probe takes four numbers: slopes and two of d, whose third is below the horizon.
    got = probe(
        [
            "lib/numbers.glsl",
            Inline("uniform vec3 u_sun_direction;\n"),
            "light/shade.glsl@irradiance",
            "light/glitter.glsl@blinn_phong",
        ],
        "vec3 d = vec3(x.x, -sqrt(max(1.0 - x.x * x.x - x.y * x.y, 0.0)), x.y);\n"
        "y.xyz = glitter_light(d, normalize(vec3(-x.z, 1.0, -x.w)), 0.0, 1.0);",
        np.column_stack([d[:, 0], d[:, 2], slopes]),
        uniforms={
            "u_sun_direction": air.sun,
            "u_sun_irradiance": air.sun_irradiance,
            "u_specular_power": power,
            "u_specular_perturb": perturb,
        },
    )[:, :3]
    assert np.isfinite(got).all()
    assert want.max() > 1e-3
    assert np.abs(got - want).max() <= 1e-6 * (10.0 + power) * air.sun_irradiance.max()
