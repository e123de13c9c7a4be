"""Frames and light in float64, and their truth as it is baked."""

import math
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from references import bake
from seafoam.effects.bounds import max_surface_height
from seafoam.ocean.basics.dispersion import wave_level
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.ocean.waves.rings import ring_height
from seafoam.ocean.waves.wakes import joint_height, wakes
from seafoam.reference import Mode, Sprayed, render
from seafoam.reference.light import light
from seafoam.reference.types import Floats, unit
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation, Look
from seafoam.scene.light import Light, Sky
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.spray import Spray
from seafoam.scene.water import Ripples, Water
from seafoam.scene.waves import ParametricWave

WAVES = (
    ParametricWave(amplitude=0.8, wavelength=14.0, direction=1.2, exponent=2.0),
    ParametricWave(amplitude=0.3, wavelength=6.0, direction=2.0, exponent=1.5, phase=1.0),
)
FOAM = Foam(
    saturation=(FrontSaturation(group=(0.1, 0.5)), HeightSaturation(base=0.4, full=0.9)),
    mask="blur:1.5:64:20",
    texture=0.4,
)
SEA = Scene(
    waves=WAVES, foam=FOAM, water=Water(ripples=Ripples()), camera=Camera(position=(3.0, 4.0, -2.0), pitch=-0.3)
)


def test_samples_are_pixels_of_a_finer_picture() -> None:
    fine = render(SEA, time=1.0, width=24, height=16, samples=1)
    coarse = render(SEA, time=1.0, width=12, height=8, samples=2)
    np.testing.assert_array_equal(coarse.amount, fine.alpha)
    np.testing.assert_allclose(coarse.rgb, fine.rgb.reshape(8, 2, 12, 2, 3).mean(axis=(1, 3)), rtol=1e-13)


def test_spray_without_drops_is_refused() -> None:
    """And with none in the air it changes nothing."""
    scene, at = SEA.model_copy(update={"spray": Spray()}), {"time": 1.0, "width": 12, "height": 8}
    with pytest.raises(ValueError, match="needs its drops"):
        render(scene, **at)
    none = render(Sprayed(scene, np.zeros((3, 0, 4), np.float32)), **at)
    np.testing.assert_array_equal(none.rgb, render(SEA, **at).rgb)


def test_chunks_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = {"time": 2.0, "width": 14, "height": 9, "samples": 3, "mode": "converged"}
    whole = render(SEA, **settings)
    monkeypatch.setattr("seafoam.reference.renderer.frame.CHUNK", 100)
    np.testing.assert_allclose(render(SEA, **settings).rgb, whole.rgb, rtol=1e-9)


@pytest.mark.parametrize("look", get_args(Look))
@pytest.mark.parametrize("mode", ["same-samples", "converged"])
@pytest.mark.parametrize("lit", [True, False])
def test_every_look(look: str, mode: str, lit: bool) -> None:
    foam = FOAM.model_copy(update={"look": look})
    scene = SEA.model_copy(update={"foam": foam, "light": Light() if lit else None})
    frame = render(scene, time=2.0, width=16, height=9, samples=2, mode=mode)
    assert np.isfinite(frame.rgb).all()
    assert (frame.rgb >= 0.0).all()
    assert (frame.amount >= 0.0).all()
    assert (frame.amount <= 1.0).all()
    assert 0.0 < frame.alpha.mean() < 1.0
    if not lit:
        np.testing.assert_allclose(frame.rgb, np.repeat(frame.alpha[:, :, None], 3, axis=2), atol=1e-14)


def test_truth_survives_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bake, "DIRECTORY", tmp_path)
    for mode in get_args(Mode):
        job = bake.Job(mode, SEA, 2.0, (13, 9), 3, mode)
        frame = render(SEA, time=2.0, width=13, height=9, samples=3, mode=mode)
        bake.truth_file(mode).write_bytes(bake.truth_bytes(frame, job))
        truth = bake.load_truth(mode)
        dim = frame.rgb <= 1.0
        assert np.abs(truth.rgb - frame.rgb)[dim].max() < 0.01 / 255
        assert np.abs(truth.alpha - frame.alpha).max() < 1e-5
        assert truth.foam is None if mode == "converged" else (truth.foam == (frame.amount > 0.0)).all()
        assert bake.truth_is_current(mode, SEA)
        assert not bake.truth_is_current(mode, Scene())
        assert not bake.truth_is_current("none", SEA)


MOST = 2e-4
"""Greatest share of the time under water."""
MOMENTS = 400_000


def heights(scene: Scene) -> Floats:
    """Height of the water over a place at moments far apart, m.

    Waves at any phase, as high as in their groups at most; a normal sea; rings, wakes and surf by the most they add.
    """
    random = np.random.default_rng(1)
    total = np.full(MOMENTS, ring_height(scene) + joint_height(wakes(scene.boats)))
    if scene.shore is not None:
        total += scene.shore.surf.height
    for wave in scene.waves:
        turn = random.uniform(0.0, 2.0 * math.pi, MOMENTS)
        total += wave.amplitude * (0.5 + 0.5 * np.sin(turn)) ** wave.exponent - wave_level(wave)
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        variance = sum(tile.variance for tile in cascades(scene.sea, scene.water.depth)[:RAISED])
        total += random.normal(0.0, math.sqrt(variance), MOMENTS)
    return total


def test_the_cameras_stay_above_water() -> None:
    judged = 0
    for name in preset_names():
        scene = load_preset(name).scene.settled
        height = scene.camera.position[1]
        if height <= max_surface_height(scene):
            judged += 1
            under = float((heights(scene) >= height).mean())
            assert under <= MOST, f"{name}: {100.0 * under:.2f} % of the time under water"
    assert judged > 0


def test_disc_is_where_the_sun_is() -> None:
    air = light.air(Light(sun_elevation=0.5, sun_azimuth=1.0))
    np.testing.assert_allclose(light.sun_disc(air, air.sun), np.minimum(air.sun_irradiance / 6.8e-5, 3000.0))
    np.testing.assert_array_equal(light.sun_disc(air, unit(air.sun + np.array([0.02, 0.0, 0.0]))), 0.0)
    assert (light.sun_disc(light.air(Light(sun_elevation=-0.1)), air.sun) == 0.0).all()


def test_haze_before_a_low_sun_does_not_glow_at_ones_feet() -> None:
    """A layered sky: at the horizon haze is the sky's light; under the sun, but steeply down, half of that at most."""
    air = light.air(Light(sun_azimuth=0.0, sun_elevation=0.05, sky=Sky()))
    y = np.array([0.0, -0.2, -0.5, -0.8])
    d = np.stack((np.sqrt(1.0 - y * y), y, np.zeros(4)), axis=-1)
    seen = light.haze(air, 1000.0, np.zeros((4, 3)), d, np.full(4, 1e9))
    np.testing.assert_allclose(seen[0], air.sky(d[:1])[0], rtol=1e-12)
    assert (np.diff(seen, axis=0) < 0.0).all()
    assert (seen[2] < 0.5 * seen[0]).all()


def test_an_endless_plume_is_water_that_scatters_as_much() -> None:
    d = unit(np.array([[0.6, -0.5, 0.2], [0.0, -1.0, 0.0]]))
    n = np.tile((0.0, 1.0, 0.0), (2, 1))
    plume = Water(aeration=0.2, plume_depth=20.0, scattering=0.1)
    hit = light.WaterHit(d, n, np.zeros(2), (0.0, 0.0), saturation=np.ones(2))
    got, want = (light.water(light.air(Light()), body, hit) for body in (plume, Water(scattering=0.3)))
    np.testing.assert_allclose(got, want, rtol=1e-4)
