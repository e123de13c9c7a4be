"""Foam by slope against float64, and foam that does not repeat: two textures, and a mask turned in each cell."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.waves import parametric
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.quality import TIERS
from seafoam.reference import render as reference
from seafoam.reference.renderer.sources import slope_saturation
from seafoam.reference.waves.parametric import wave_set
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import linear, rmse
from support.probe import Probe, stand_in
from support.report import Report
from support.scenes import Camera, Foam, HeightSaturation, ParametricWave, Scene, SlopeSaturation

SIDE, TILE_PIXELS, HEIGHT, TILE = 256, 32, 200.0, 12.8
ABOVE = Camera(position=(31.7, HEIGHT, -8.3), pitch=-math.pi / 2, fov=2.0 * math.atan(4.0 * TILE / HEIGHT))
"""From 200 m up a tile is 32 pixels."""


@pytest.mark.parametrize(("cap", "blur"), [(4.0, 0.0), (1.0, 0.7)])
def test_slope_saturation_equals_its_float64_form(probe: Probe, cap: float, blur: float) -> None:
    waves = (
        ParametricWave(amplitude=0.8, wavelength=6.0, exponent=1.6, direction=0.4),
        ParametricWave(amplitude=0.3, wavelength=2.3, exponent=1.0, direction=-1.0),
    )
    scene = Scene(waves=waves)
    given = parametric.EFFECT.contribute(scene, UNFILTERED)
    time, origin = 12.5, (1234.5, -77.0)
    state = FrameState(time, Camera(position=(origin[0], 5.0, origin[1])), 1, 1, 1, 1)
    at = np.random.default_rng(4).uniform(-30.0, 30.0, (10000, 2)).astype(np.float32)
    slope = "foam/saturation/slope.glsl@blurred" if blur > 0.0 else "foam/saturation/slope.glsl@plain"
    got = probe(
        [
            "lib/numbers.glsl",
            "waves/parametric.glsl",
            stand_in("parametric_slope"),
            "foam/saturation/slope.glsl@lack",
            slope,
        ],
        "y.x = slope_saturation(x.xy, 0.0, Footprint(vec2(0.0), vec2(0.0)));",
        at,
        consts={**given.consts, "SURFACE_FILTER": False, "SLOPE_MOST": cap},
        uniforms={
            **{key: evaluate(value, state) for key, value in given.uniforms.items()},
            "u_slope_gain": np.float32(16.0),
            "u_slope_base": np.float32(0.03125),
            "u_slope_blur": np.float32(blur),
        },
    )[:, 0]
    x, z = at.astype(np.float64).T
    want = np.minimum(
        slope_saturation(wave_set(scene, time, origin).gradient, x, z, 16.0, 0.03125, float(np.float32(blur))), cap
    )
    assert want.max() > 0.6
    assert (want == 0.0).any()
    assert np.abs(got - want).max() <= 2e-5


def from_above(executor: Executor, **foam: object) -> NDArray[np.float64]:
    """Foam of even saturation from 200 m up, a row a line of pixels."""
    saturation = (HeightSaturation(base=-0.5, full=0.5 + 0.5),)
    scene = Scene(foam=Foam(saturation=saturation, mask="mix", mask_tile=TILE, **foam), light=None)
    return linear(executor, scene, TIERS["standard"], ABOVE, size=(SIDE, SIDE))[..., 3].astype(np.float64)


def repeat(picture: NDArray[np.float64]) -> float:
    """Greatest autocorrelation at a tile's distance, along and across, within a pixel."""
    even = picture - picture.mean()
    power = np.fft.irfft2(np.abs(np.fft.rfft2(even)) ** 2, s=even.shape)
    near = range(TILE_PIXELS - 1, TILE_PIXELS + 2)
    return float(max(max(power[0, i] for i in near), max(power[i, 0] for i in near)) / power[0, 0])


def test_foam_repeats_from_200_m_and_in_cells_it_does_not(executor: Executor, report: Report) -> None:
    pictures = {
        "one mask": from_above(executor),
        "in cells": from_above(executor, cells=True),
        "one mask, halftone": from_above(executor, look="halftone"),
        "in cells, halftone": from_above(executor, look="halftone", cells=True),
        "one texture": from_above(executor, look="textured", texture_tile=TILE),
        "two textures": from_above(executor, look="textured", texture_tile=TILE, texture_second=TILE * 2.7 / 3.14),
    }
    found = {name: repeat(picture) for name, picture in pictures.items()}
    report.within("Foam from 200 m up: autocorrelation at a tile's distance", **found)
    assert found["one mask"] > 0.8
    assert found["in cells"] < 0.15
    assert found["in cells, halftone"] < 0.15
    assert found["two textures"] < 0.75 * found["one texture"]
    # Cells move no foam: the mean is the saturation, 1/3.
    for name in ("one mask", "in cells", "in cells, halftone"):
        assert abs(pictures[name].mean() - 1.0 / 3.0) < 0.01


@pytest.mark.parametrize("look", ["filtered", "halftone", "textured"])
def test_frames_with_cells_and_two_textures_equal_float64(executor: Executor, look: str) -> None:
    foam = Foam(
        saturation=(SlopeSaturation(gain=9.0, blur=0.3), HeightSaturation(base=0.2, full=1.1)),
        look=look,
        mask="mix",
        mask_tile=1.7,
        mask_angle=0.8,
        cells=True,
        texture=0.6,
        texture_tile=2.7,
        texture_second=3.14,
        fade=0.3,
    )
    camera = Camera(position=(-5e6, 2.6625, 7e6), yaw=0.3, pitch=-0.5)
    scene = Scene(waves=(ParametricWave(amplitude=0.9, wavelength=7.0),), foam=foam, light=None, camera=camera)
    got = linear(executor, scene, UNFILTERED.model_copy(update={"samples": 4}), time=3.3, size=(96, 54))
    want = reference(scene, time=3.3, width=96, height=54, samples=2)
    assert want.alpha.std() > 0.05
    assert rmse(got, want.rgb) <= 0.5
