"""Whole frames, and frames on disk."""

import itertools
import math
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from seafoam.reference import Assets, load_truth, render, scene_sha256, truth_is_current
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.truth import truth_bytes
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation, Look
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
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


def test_assets_of_a_scene() -> None:
    made = Assets.for_scene(SEA.model_copy(update={"foam": Foam(mask="blur:2:128:3")}))
    shipped = Assets.for_scene(SEA.model_copy(update={"foam": Foam()}))
    assert made is not None
    assert shipped is not None
    assert made.thresholds.shape == (128, 128)
    assert shipped.quantiles.shape == (11, 65)
    assert [level.shape[0] for level in made.spans] == [128, 64, 32, 16, 8, 4, 2, 1]
    assert shipped.texture[0].shape == (256, 256)
    assert Assets.for_scene(Scene()) is None


def test_rows_run_from_the_top() -> None:
    frame = render(SEA, time=1.0, width=12, height=10, samples=2)
    assert frame.amount.shape == frame.hit.shape == (20, 24)
    assert not frame.hit[0].any()
    assert frame.hit[-1].all()
    depression = cameras.depression(cameras.view(SEA.camera, 12, 10), 12, 10)
    assert (np.diff(depression, axis=0) > 0.0).all()
    assert depression[-1, 6] > 0.5
    np.testing.assert_allclose(frame.amount.reshape(10, 2, 12, 2).mean(axis=(1, 3)), frame.alpha, atol=1e-14)


def test_samples_are_pixels_of_a_finer_picture() -> None:
    fine = render(SEA, time=1.0, width=24, height=16, samples=1)
    coarse = render(SEA, time=1.0, width=12, height=8, samples=2)
    np.testing.assert_array_equal(coarse.amount, fine.alpha)
    np.testing.assert_allclose(coarse.rgb, fine.rgb.reshape(8, 2, 12, 2, 3).mean(axis=(1, 3)), rtol=1e-13)


def test_sides() -> None:
    # Yaw 0 looks along −z with +x to the right: the half of the picture toward a sun in +x is the brighter.
    low_sun = Scene(light=Light(sun_azimuth=0.0, sun_elevation=0.1), camera=Camera(pitch=0.3))
    sky = render(low_sun, time=0.0, width=8, height=4).rgb.sum(axis=2)
    assert (sky[:, -1] > sky[:, 0]).all()
    rolled = low_sun.model_copy(update={"camera": Camera(pitch=0.3, roll=0.5 * math.pi)})
    turned = render(rolled, time=0.0, width=8, height=8).rgb.sum(axis=2)
    # R = U₀ and U = −R₀: the bottom of the picture is what was its right.
    assert (turned[-1] > turned[0]).all()


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
    assert not frame.amount[~frame.hit].any()
    if not lit:
        np.testing.assert_allclose(frame.rgb, np.repeat(frame.alpha[:, :, None], 3, axis=2), atol=1e-14)


CAMERAS = {
    "down": Camera(pitch=-math.pi / 2 + 1e-9),
    "up": Camera(pitch=1.5707, position=(0.0, 5.0, 0.0)),
    "under": Camera(position=(0.0, -3.0, 0.0), pitch=0.4),
    "under, down": Camera(position=(0.0, -3.0, 0.0), pitch=-0.4),
    "in a crest": Camera(position=(0.0, 0.2, 0.0), pitch=0.0),
    "at still water": Camera(position=(0.0, 0.0, 0.0), pitch=0.0),
    "far": Camera(position=(1e7, 1e5, -1e7), pitch=-0.7),
    "grazing": Camera(position=(0.0, 1e5, 0.0), pitch=0.0, fov=0.01),
    "wide": Camera(fov=2.6, pitch=-0.2, roll=2.0),
}
SEAS = {
    "flat": (ParametricWave(amplitude=0.0),),
    "none": (),
    "blunt": (ParametricWave(exponent=0.1),),
    "cusp": (ParametricWave(exponent=0.5, direction=1.5),),
    "sharp": (ParametricWave(exponent=100.0), ParametricWave(exponent=1.0, wavelength=5.0)),
}


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("sea", SEAS)
def test_odd_scenes_are_finite(camera: str, sea: str) -> None:
    sun = Light(sun_elevation=-0.3 if sea == "cusp" else 0.6, sun_azimuth=-math.pi / 2)
    for width, height, ripples in ((1, 1, None), (7, 5, Ripples())):
        scene = Scene(waves=SEAS[sea], foam=FOAM, water=Water(ripples=ripples), light=sun, camera=CAMERAS[camera])
        frame = render(scene, time=1e9 + 0.25, width=width, height=height, samples=2)
        assert np.isfinite(frame.rgb).all()
        assert (frame.rgb >= 0.0).all()
        assert np.isfinite(frame.alpha).all()


def test_another_camera_stands_in() -> None:
    other = Camera(position=(0.0, 9.0, 0.0), pitch=-0.5)
    by_hand = render(SEA.model_copy(update={"camera": other}), time=0.0, width=6, height=4)
    np.testing.assert_array_equal(render(SEA, time=0.0, width=6, height=4, camera=other).rgb, by_hand.rgb)


def test_both_modes_agree_where_nothing_is_sharp() -> None:
    near = Camera(position=(0.0, 3.0, 0.0), pitch=-0.9, fov=0.5)
    smooth = Scene(waves=WAVES, camera=near, light=Light(sun_azimuth=2.0))
    same = render(smooth, time=1.0, width=16, height=12, samples=4)
    converged = render(smooth, time=1.0, width=16, height=12, samples=8, mode="converged")
    np.testing.assert_allclose(same.rgb, converged.rgb, rtol=0.02)


def test_filtered_look_approaches_its_limit() -> None:
    foam = Foam(saturation=(HeightSaturation(base=0.0, full=1.5),), mask_tile=6.0, mask=FOAM.mask)
    near = Camera(position=(0.0, 3.0, 0.0), pitch=-1.0)
    scene = Scene(waves=WAVES, foam=foam, light=None, camera=near)
    limit = render(scene, time=1.0, width=12, height=8, samples=32, mode="converged")
    errors = [
        float(np.abs(render(scene, time=1.0, width=12, height=8, samples=n).alpha - limit.alpha).mean())
        for n in (1, 16)
    ]
    assert errors[1] < 0.02
    assert errors[1] < errors[0]


def test_exposure_scales_light() -> None:
    brighter = SEA.model_copy(update={"light": Light(exposure=1.0)})
    plain = render(SEA, time=0.0, width=6, height=4)
    np.testing.assert_allclose(render(brighter, time=0.0, width=6, height=4).rgb, 2.0 * plain.rgb)


@pytest.mark.parametrize("mode", ["same-samples", "converged"])
def test_truth_survives_the_disk(tmp_path: Path, mode: str) -> None:
    frame = render(SEA, time=2.0, width=13, height=9, samples=3, mode=mode)
    paths = [tmp_path / name for name in ("a.npz", "b.npz")]
    for path in paths:
        path.write_bytes(truth_bytes(frame, preset="sea", scene=SEA, time=2.0, mode=mode, seconds=1.25))
    assert paths[0].read_bytes() == paths[1].read_bytes()
    truth = load_truth(paths[0])
    dim = frame.rgb <= 1.0
    assert np.abs(truth.rgb - frame.rgb)[dim].max() < 0.01 / 255
    assert np.abs(truth.alpha - frame.alpha).max() < 1e-5
    if mode == "same-samples":
        np.testing.assert_array_equal(truth.foam, frame.amount > 0.0)
    else:
        assert truth.foam is None
    assert (truth.preset, truth.look, truth.time, truth.samples, truth.mode) == ("sea", "filtered", 2.0, 3, mode)
    assert truth.scene_sha256 == scene_sha256(SEA)
    assert truth_is_current(paths[0], SEA)
    assert not truth_is_current(paths[0], Scene())
    assert not truth_is_current(tmp_path / "none.npz", SEA)


def test_scenes_hash_apart() -> None:
    hashes = [scene_sha256(scene) for scene in (SEA, Scene(), Scene(light=None), SEA.model_copy(update={"foam": None}))]
    assert all(a != b for a, b in itertools.combinations(hashes, 2))
    assert scene_sha256(SEA) == scene_sha256(SEA.model_copy())
