"""No NaN and no infinity reaches a float target: read before the mean, the clamp and the tone curve."""

import math
from typing import get_args

import numpy as np
import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.pictures import draw
from support.scenes import (
    Camera,
    Foam,
    FrontSaturation,
    Light,
    Look,
    ParametricWave,
    Ripples,
    Scene,
    Water,
    load_preset,
    preset_names,
)
from support.sweep import crossed

CAMERAS = {
    "down": Camera(position=(0.0, 8.0, 0.0), pitch=-math.pi / 2),
    "up": Camera(position=(0.0, 8.0, 0.0), pitch=math.pi / 2),
    "level": Camera(position=(0.0, 8.0, 0.0), pitch=0.0),
    "in a crest": Camera(position=(0.0, 0.4, 0.0), pitch=-0.2),
    "under water": Camera(position=(0.0, -3.0, 0.0), pitch=0.3),
    "far from the origin": Camera(position=(1e7, 8.0, -1e7), pitch=-0.2, roll=1.0),
    "high": Camera(position=(0.0, 1e5, 0.0), pitch=-0.5, fov=2.6),
}


def finite(executor: Executor, scene: Scene, tier: str, camera: Camera, time: float) -> bool:
    quality = TIERS[tier].model_copy(update={"target": "RGBA32F"})  # type: ignore[index]
    plan = make_plan(scene, quality)
    pixels = draw(executor, plan, camera, time=time, size=(96, 54), output="samples")
    return bool(np.isfinite(pixels).all() and (pixels >= 0.0).all() and (pixels[..., 3] <= 1.0).all())


@pytest.mark.parametrize(("preset", "view"), crossed(preset_names(), CAMERAS, len(CAMERAS), 3, 2))
def test_presets_are_finite_at_their_most_exact(executor: Executor, preset: str, view: str) -> None:
    """At the usual tier ``test_anywhere`` asks it of more places."""
    assert finite(executor, load_preset(preset).scene, "reference", CAMERAS[view], 2.7)


HARD_WAVES = {
    "K 0.1": ParametricWave(exponent=0.1),
    "K 100": ParametricWave(exponent=100.0, amplitude=5.0),
    "no height": ParametricWave(amplitude=0.0),
    "tiny": ParametricWave(wavelength=0.05, amplitude=1e-6),
    "huge": ParametricWave(wavelength=2000.0, amplitude=50.0, speed=200.0),
    "near-vertical": ParametricWave(wavelength=0.05, amplitude=50.0, exponent=4.0),
}


@pytest.mark.parametrize(("name", "look"), crossed(HARD_WAVES, get_args(Look), 4))
@pytest.mark.parametrize("constants", ["text", "listing"])
def test_hard_waves_are_finite(executor: Executor, name: str, look: Look, constants: str) -> None:
    front = FrontSaturation(constants=constants, group=(0.2, 0.2))  # type: ignore[arg-type]
    scene = Scene(
        waves=(HARD_WAVES[name], HARD_WAVES[name].model_copy(update={"direction": math.pi})),
        foam=Foam(saturation=(front,), look=look, fade=0.2, texture=0.5),
        water=Water(ripples=Ripples(), depth=0.05, scattering=0.0),
    )
    for time in (0.0, 1e9, -1e9):
        assert finite(executor, scene, "standard", CAMERAS["level"].model_copy(update={"pitch": -0.4}), time)


@pytest.mark.parametrize("elevation", [-math.pi / 2, -0.02, 0.0, 0.02, math.pi / 2])
def test_every_sun_is_finite(executor: Executor, elevation: float) -> None:
    scene = load_preset("default").scene.model_copy(update={"light": Light(sun_elevation=elevation)})
    for view in ("down", "level", "up"):
        assert finite(executor, scene, "standard", CAMERAS[view], 0.0)
