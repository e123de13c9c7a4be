"""Frames and light in float64, and their truth as it is baked."""

from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from references import bake
from seafoam.reference import Mode, Sprayed, render
from seafoam.scene import Camera, Scene
from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation, Look
from seafoam.scene.light import Light
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
