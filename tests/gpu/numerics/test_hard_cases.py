"""Every effect's hard cases: finite, non-negative, and as the float64 reference has them (docs/stability.md)."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import seafoam
from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect, HardCase
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.reference import render as reference
from seafoam.reference.foam import front
from seafoam.render.gl.executor import Executor
from seafoam.resources import data_dir
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.waves import ParametricWave
from support.exact import EXACT
from support.probe import Probe
from support.report import Report

SIZE = (48, 27)
QUALITIES = {
    "exact": EXACT,
    "march": TIERS["standard"].model_copy(update={"target": "RGBA32F"}),
    "mesh": TIERS["draft"].model_copy(
        update={"target": "RGBA32F", "surface": SurfaceQuality(method="mesh", cells=112, refine=2)}
    ),
}
SHARE = 0.01
"""Of pixels off by more than 2 levels of linear light, between two qualities."""
CASES = [
    pytest.param(effect, case, id=f"{effect.name}: {case.name}") for effect in EFFECTS for case in effect.cases.hard
]


def draw(
    executor: Executor,
    scene: Scene,
    quality: Quality,
    time: float,
    camera: Camera,
    size: tuple[int, int] = SIZE,
    output: str = "samples",
) -> NDArray[np.float32]:
    plan = make_plan(scene, quality)
    rendered = executor.render(plan, time=time, camera=camera, width=size[0], height=size[1], output=output)  # type: ignore[arg-type]
    return rendered.pixels  # type: ignore[return-value]


def assert_sound(pixels: NDArray[np.float32]) -> None:
    assert np.isfinite(pixels).all()
    assert (pixels >= 0.0).all()
    assert (pixels[..., 3] <= 1.0).all()


def levels(a: NDArray[np.floating], b: NDArray[np.floating]) -> NDArray[np.float64]:
    """Largest difference of each pixel's colours, clipped at white, in levels."""
    clipped = [np.clip(part[..., :3].astype(np.float64), 0.0, 1.0) for part in (a, b)]
    result: NDArray[np.float64] = 255.0 * np.abs(clipped[0] - clipped[1]).max(axis=-1)
    return result


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_every_effect_has_hard_cases(effect: Effect) -> None:
    assert effect.cases.hard, f"{effect.name} declares no hard case"
    for case in effect.cases.hard:
        assert case.guard
        assert case.without
        assert case.times
        assert effect.contribute(case.scene, EXACT) is not None, f"{case.name} does not call for it"


@pytest.mark.parametrize(("effect", "case"), CASES)
def test_guards_stand_where_they_are_said_to(effect: Effect, case: HardCase) -> None:
    """Files that a guard names exist, and a shader among them is drawn: a guard in another file guards nothing here."""
    named = re.findall(r"[\w/]+\.(?:glsl|py)", case.guard)
    for name in named:
        folder = data_dir("shaders") if name.endswith(".glsl") else Path(seafoam.__file__).parent
        assert any(folder.rglob(name)), f"no file {name}"
    if named and all(name.endswith(".glsl") for name in named):
        plans = (make_plan(case.scene, quality) for quality in QUALITIES.values())
        shaders = (shader for plan in plans for one in plan.programs.values() for shader in (one.vertex, one.fragment))
        assert any(file.path in named for shader in shaders for file in shader.files), f"none of {named} is drawn"


def test_names_tell_cases_apart() -> None:
    names = [case.name for effect in EFFECTS for case in effect.cases.hard]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(("effect", "case"), CASES)
def test_hard_case(executor: Executor, report: Report, effect: Effect, case: HardCase) -> None:
    """Sound at every quality, within bounds of the reference at the exact one, and as good in half floats."""
    camera = case.camera or case.scene.camera
    worst_mean, worst_share = 0.0, 0.0
    for time in case.times:
        pictures = {name: draw(executor, case.scene, quality, time, camera) for name, quality in QUALITIES.items()}
        for picture in pictures.values():
            assert_sound(picture)
        if not case.apart:
            truth = reference(case.scene, time=time, width=SIZE[0], height=SIZE[1], camera=camera)
            assert np.isfinite(truth.rgb).all()
            away = levels(pictures["exact"], truth.rgb)
            worst_mean, worst_share = max(worst_mean, away.mean()), max(worst_share, float((away > 2.0).mean()))
    # The usual target against the float32 one: bright suns are not infinite there, nights not lost.
    half = draw(executor, case.scene, TIERS["standard"], case.times[-1], camera)
    assert_sound(half)
    away = levels(half, pictures["march"])
    # Half floats keep 11 bits: an eighth of a level at white. The mask's moments and the ripple tile are the same.
    assert away.mean() <= 0.25
    assert (away > 2.0).mean() <= SHARE
    report.add(
        "Hard cases against the float64 reference, 48 × 27, levels of linear light",
        effect=effect.name,
        case=case.name,
        mean="apart" if case.apart else f"{worst_mean:.4f}",
        over_2="" if case.apart else f"{100 * worst_share:.2f} %",
    )
    assert worst_mean <= case.bounds.mean
    assert worst_share <= case.bounds.share


@pytest.mark.parametrize("quality", ["march", "mesh"])
@pytest.mark.parametrize("size", [(1, 1), (1, 4096), (4096, 1), (511, 3), (47, 27)], ids=str)
def test_sizes(executor: Executor, size: tuple[int, int], quality: str) -> None:
    scene = load_preset("default").scene
    for target in ("RGBA16F", "RGBA32F"):
        wanted = QUALITIES[quality].model_copy(update={"target": target})
        pixels = draw(executor, scene, wanted, 0.0, scene.camera, size)
        assert pixels.shape == (size[1], size[0], 4)
        assert_sound(pixels)


def test_one_pixel_is_the_references(executor: Executor) -> None:
    scene = load_preset("default").scene
    got = draw(executor, scene, EXACT, 2.7, scene.camera, (1, 1))
    want = reference(scene, time=2.7, width=1, height=1)
    assert levels(got, want.rgb).max() <= 1.0


def test_a_hundred_equal_waves(executor: Executor) -> None:
    """More than a scene may hold: a hundred small ones are one large one, within float32's rounding of the sums."""
    camera = Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12)
    foam = Foam(look="fading")
    many = Scene.model_construct(
        **{**dict(Scene(foam=foam)), "waves": (ParametricWave(amplitude=0.005, wavelength=9.0),) * 100}
    )
    one = Scene(waves=(ParametricWave(amplitude=0.5, wavelength=9.0),), foam=foam)
    quality = EXACT.model_copy(update={"waves": 100})
    pictures = [draw(executor, scene, quality, 1e9, camera) for scene in (many, one)]
    for picture in pictures:
        assert_sound(picture)
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
        ["lib/numbers.glsl", "foam/saturation/front_profile.glsl"],
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


def test_a_microsecond_is_a_step_of_the_sea(executor: Executor) -> None:
    """1e-6 s at 1e9 s: some pixel moves, none far."""
    scene = load_preset("default").scene
    frames = [draw(executor, scene, EXACT, time, scene.camera, (96, 54)) for time in (1e9, 1e9 + 1e-6)]
    assert (frames[0] != frames[1]).any()
    assert levels(*frames).mean() <= 0.05
