"""Every effect's hard cases: finite, non-negative, and as the float64 reference has them (docs/stability.md)."""

import math

import numpy as np
import pytest

from seafoam.effects.effect import Effect
from seafoam.reference.foam import front
from seafoam.render.gl.executor import Executor
from support.cases import HardCase
from support.exact import EXACT
from support.hard.pictures import CASES, HALF, QUALITIES, SHARE, SIZE, judged, pictures_of, truth_of, unsound
from support.pictures import levels, samples
from support.probe import Probe
from support.report import Report
from support.scenes import Camera, Foam, ParametricWave, Scene, load_preset
from support.sweep import rested


@pytest.mark.parametrize(("effect", "case"), rested(CASES, 8))
def test_a_hard_case_is_the_references(executor: Executor, report: Report, effect: Effect, case: HardCase) -> None:
    found = judged(case, pictures_of(executor, case, ("exact",)), truth_of(executor, case))
    report.add(
        "Hard cases against the float64 reference, 48 × 27, levels of linear light",
        effect=effect.name,
        case=case.name,
        mean=f"{found.mean:.4f}",
        over_2=f"{100 * found.share:.2f} %",
    )
    assert found.faults == ()


@pytest.mark.parametrize(("effect", "case"), rested(CASES, 24))
def test_a_hard_case_is_sound_by_march_and_mesh(executor: Executor, effect: Effect, case: HardCase) -> None:
    """And as good in half floats as in float32."""
    assert judged(case, pictures_of(executor, case, ("march", "mesh", HALF)), []).faults == ()


@pytest.mark.parametrize("quality", ["march", "mesh"])
@pytest.mark.parametrize("size", [(1, 1), (1, 4096), (4096, 1), (511, 3), (47, 27)], ids=str)
def test_sizes(executor: Executor, size: tuple[int, int], quality: str) -> None:
    scene = load_preset("default").scene
    for target in ("RGBA16F", "RGBA32F"):
        wanted = QUALITIES[quality].model_copy(update={"target": target})
        pixels = samples(executor, scene, wanted, scene.camera, time=0.0, size=size)
        assert pixels.shape == (size[1], size[0], 4)
        assert unsound(pixels) == []


def test_a_hundred_equal_waves(executor: Executor) -> None:
    """More than a scene may hold: a hundred small ones are one large one, within float32's rounding of the sums."""
    camera = Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12)
    foam = Foam(look="fading")
    many = Scene.model_construct(
        **{**dict(Scene(foam=foam)), "waves": (ParametricWave(amplitude=0.005, wavelength=9.0),) * 100}
    )
    one = Scene(waves=(ParametricWave(amplitude=0.5, wavelength=9.0),), foam=foam)
    quality = EXACT.model_copy(update={"waves": 100})
    pictures = [samples(executor, scene, quality, camera, time=1e9, size=SIZE) for scene in (many, one)]
    for picture in pictures:
        assert unsound(picture) == []
    away = levels(*pictures)
    assert away.mean() <= 0.1
    assert (away > 2.0).mean() <= SHARE


@pytest.mark.parametrize("intensity", [1e-6, 1e-3, 0.25, 1e4])
def test_front_at_its_pole_and_beyond_the_schemas_c(probe: Probe, intensity: float) -> None:
    """Signals along the axes, of no length, and with subnormal parts; f is finite, in [0, 4], and 4 on the pole."""
    away = np.geomspace(1e-30, 1.0, 200)
    signals = np.concatenate(
        [
            [[1.0, 0.0], [1.0, -0.0], [0.0, 0.0], [-1.0, 0.0], [1e-30, 1e-38], [-1e-30, 0.0]],
            np.column_stack([np.ones_like(away), away]),
            np.column_stack([np.ones_like(away), -away]),
            np.column_stack([-away, away]),
        ]
    ).astype(np.float32)
    got = probe(
        ["lib/numbers.glsl", "foam/saturation/front.glsl@profile"],
        "y.x = front_profile(x.xy, length(x.xy));",
        signals,
        uniforms={"u_front_intensity": intensity, "u_front_log_base": 1.0},
    )[:, 0]
    assert np.isfinite(got).all()
    assert ((got >= 0.0) & (got <= 4.0)).all()
    assert (got[:2] == 4.0).all()
    wide = signals[6:].astype(np.float64)
    want = front.front_saturation(wide[:, 0], wide[:, 1], intensity, math.e)
    # exp multiplies the exponent's rounding, at most 80 times 6e-8, and f is at most 4.
    assert np.abs(got[6:] - want).max() <= 1e-4
