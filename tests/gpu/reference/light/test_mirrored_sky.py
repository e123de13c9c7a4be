"""Mirrors: skies, blurred and drawn once (formulae, 6 and 9), and what stands by the water."""

import hashlib
import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS, SurfaceQuality
from seafoam.reference import render
from seafoam.reference.light import light as reference_light
from seafoam.reference.light.clouds import CloudLayer
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import draw, levels, linear, rms, rmse, samples
from support.report import Report
from support.scenes import (
    Boat,
    Camera,
    Cirrus,
    Clouds,
    Light,
    ParametricWave,
    Ripples,
    Scene,
    Sea,
    Shore,
    Sky,
    Surf,
    Water,
)

WIDTH, HEIGHT = 80, 45
WATER = slice(int(0.41 * HEIGHT), HEIGHT)
"""Rows below the horizon."""
CAMERA = Camera(position=(0.0, 4.0, 0.0), yaw=0.3, pitch=-0.12)
ALONG = Camera(position=(0.0, 4.0, 0.0), yaw=1.87, pitch=-0.12)
"""Across a wind along x, and along it and toward the sun."""
ALL = "return (1.0 - reflectance) * body + reflectance * reflected + sun_reaches * glitter_light(d, n, sigma2, cv);"
MIRRORED = "return reflectance * reflected;"


def mirror_alone(plan: FramePlan) -> FramePlan:
    """A plan whose water shows what it mirrors, and neither its body nor the sun's glitter."""
    programs = {}
    for name, program in plan.programs.items():
        text = program.fragment.text.replace(ALL, MIRRORED)
        # The executor knows programs by it.
        sha256 = hashlib.sha256(text.encode()).hexdigest()
        fragment = program.fragment.model_copy(update={"text": text, "sha256": sha256})
        programs[name] = program.model_copy(update={"fragment": fragment})
    assert any(MIRRORED in program.fragment.text for program in programs.values())
    return plan.model_copy(update={"programs": programs})


def light_of(
    executor: Executor, scene: Scene, finer: int = 1, camera: Camera = CAMERA, **quality: object
) -> NDArray[np.float64]:
    """Mirrored light (rows, columns, 3) of a picture's water, each pixel the mean of finer² of a larger picture."""
    # Of the same tiles, however many samples: what is compared is how their slopes are gathered.
    same = {"target": "RGBA32F", "sea_size": 256}
    plan = mirror_alone(make_plan(scene, TIERS["standard"].model_copy(update={**same, **quality})))
    size = (finer * WIDTH, finer * HEIGHT)
    drawn = draw(executor, plan, camera, time=3.0, size=size, output="linear")[..., :3].astype(np.float64)
    return drawn.reshape(HEIGHT, finer, WIDTH, finer, 3).mean(axis=(1, 3))[WATER]


def drawn_once(executor: Executor, scene: Scene, camera: Camera = CAMERA) -> tuple[float, float]:
    """Energy of a frame drawn once over that of 256 samples of the resolved surface, less 1, and its root mean square
    error over that of 16 such samples."""
    resolved = {"samples": 16, "surface": SurfaceQuality(steps=384, tolerance=0.02, filter=False)}
    truth = light_of(executor, scene, 4, camera, **resolved)
    once, sixteen = light_of(executor, scene, 1, camera), light_of(executor, scene, 1, camera, **resolved)
    return float(once.mean() / truth.mean() - 1.0), rms(once - truth) / rms(sixteen - truth)


@pytest.mark.parametrize(("wind", "elevation"), [(4.0, 0.12), (8.0, 0.8), (15.0, 0.35)])
def test_small_hard_clouds_over_rough_water(executor: Executor, report: Report, wind: float, elevation: float) -> None:
    sky = Sky(clouds=Clouds(cover=0.45, softness=0.3, size=600.0, height=1200.0))
    light = Light(sun_elevation=elevation, sun_azimuth=0.6, visibility=1e6, exposure=-0.5, sky=sky)
    energy, error = drawn_once(executor, Scene(light=light, sea=Sea(model="fft", wind=wind, fetch=60000.0)))
    report.within(
        "Mirrored small clouds, drawn once: energy less 1, and error over that of 16 samples",
        wind=wind,
        sun=elevation,
        energy=(abs(energy), 0.02),
        error=(error, 1.5),
    )


@pytest.mark.parametrize("wind", [4.0, 8.0, 15.0])
@pytest.mark.parametrize("layered", [False, True], ids=["plain", "layered"])
def test_clear_skies_over_rough_water(executor: Executor, report: Report, wind: float, layered: bool) -> None:
    """By day, with a low sun and at dusk; looking along the wind at a low sun for the error alone."""
    sky, sea = Sky() if layered else None, Sea(wind=wind, fetch=60000.0)
    for elevation, camera in ((0.8, CAMERA), (0.12, CAMERA), (-0.05, CAMERA), (0.12, ALONG)):
        light = Light(sun_elevation=elevation, sun_azimuth=0.6, visibility=1e6, exposure=-0.5, sky=sky)
        energy, error = drawn_once(executor, Scene(light=light, sea=sea), camera)
        report.within(
            "Mirrored clear sky, drawn once: energy less 1, and error over that of 16 samples",
            layered=layered,
            wind=wind,
            sun=elevation,
            energy=(abs(energy), math.inf if camera is ALONG else 0.02),
            error=(error, 1.5),
        )


def layer(clouds: Clouds, elevation: float) -> CloudLayer:
    above = reference_light.air(Light(sun_elevation=elevation, sky=Sky(clouds=clouds))).above
    return above.clouds


@pytest.mark.parametrize("cover", [0.2, 0.45, 0.8])
@pytest.mark.parametrize(("thickness", "depth"), [(2.0, 0.0), (8.0, 0.0), (8.0, 700.0)])
def test_a_blur_keeps_the_mean_of_clouds(report: Report, cover: float, thickness: float, depth: float) -> None:
    """Cover and light of clouds over many places, blurred as water blurs them, against as they are."""
    of = layer(Clouds(cover=cover, thickness=thickness, softness=0.5, size=600.0, depth=depth), 0.5)
    rng = np.random.default_rng(8)
    turn = rng.uniform(0.0, 2.0 * math.pi, 12_000)
    height = rng.uniform(0.3, 0.9, turn.size)
    level = np.sqrt(1.0 - height * height)
    d = np.stack((level * np.cos(turn), height, level * np.sin(turn)), -1)
    means = []
    for width in (1e-4, 0.02, 0.06, 0.2):
        light, cover_there, _ = of.toward(d, (np.full(turn.size, width),) * 2, lambda y: np.zeros((*y.shape, 3)))
        means.append((float(cover_there.mean()), float(light.mean())))
    worst = np.abs(np.array(means[1:]) - means[0]).max(axis=0) / (1.0, float(of.light.mean()) / math.pi)
    report.within(
        "Blurred clouds: largest change of the mean of their cover, and of their light over white",
        clouds=f"cover {cover:g}, thickness {thickness:g}, {depth:g} m deep",
        cover=(worst[0], 0.035),
        light=(worst[1], 0.035),
    )


SKIES = {
    "cirrus": Sky(cirrus=Cirrus(cover=0.6)),
    "rain": Sky(clouds=Clouds(cover=0.9, thickness=20.0, height=900.0, rain=3.0)),
    "both": Sky(cirrus=Cirrus(direction=-1.0), clouds=Clouds(cover=0.4, softness=0.4, size=900.0, depth=900.0)),
}


@pytest.mark.parametrize("name", SKIES)
def test_layers_equal_their_float64_form(executor: Executor, name: str) -> None:
    """Sky and level water that mirrors it, from a place far from the origin."""
    scene = Scene(light=Light(sun_elevation=0.3, exposure=-1.5, sky=SKIES[name]))
    camera = Camera(position=(2e4, 3.0, -1e4), pitch=0.05)
    drawn = linear(executor, scene, EXACT, camera, time=1e6, size=(48, 32))
    truth = render(scene, time=1e6, camera=camera, width=48, height=32).rgb
    assert levels(drawn, truth).max() <= 0.3


STANDING = (128, 72)
TIME = 2.7
LAND = Scene(
    shore=Shore(
        kind="lagoon",
        size=400.0,
        radius=90.0,
        depth=15.0,
        inner_depth=6.0,
        height=40.0,
        slope=0.4,
        surf=Surf(height=0.0),
    ),
    water=Water(scattering=0.012),
    light=Light(sun_elevation=0.4, exposure=-1.5, reflection="planar"),
    camera=Camera(position=(0.0, 1.8, 40.0), pitch=-0.05),
)
RIPPLED = LAND.model_copy(
    update={
        "waves": (ParametricWave(amplitude=0.02, wavelength=2.3, direction=1.1, exponent=1.0),),
        "water": Water(scattering=0.012, ripples=Ripples(slope=0.02)),
        "boats": (Boat(centre=(0.0, 0.0), radius=12.0, bearing=-1.5, speed=0.0, length=6.0),),
        "light": Light(exposure=-1.5, reflection="planar", sky=Sky(clouds=Clouds(cover=0.4))),
    }
)
BOATS = Scene(
    boats=(
        Boat(centre=(0.0, -40.0), radius=20.0, bearing=1.7, speed=0.0, heel=0.15),
        Boat(centre=(-30.0, -30.0), radius=20.0, bearing=0.3, speed=0.0, kind="motor", length=11.0),
    ),
    light=Light(reflection="planar", sun_elevation=0.5, sun_azimuth=2.4, exposure=-1.2),
    camera=Camera(position=(0.0, 3.0, 0.0), pitch=-0.12, fov=0.7),
)
WAVY = BOATS.model_copy(
    update={
        "waves": (ParametricWave(amplitude=0.12, wavelength=5.0, direction=1.1),),
        "camera": BOATS.camera.model_copy(update={"position": (0.0, 3.1, 0.0)}),
    }
)


@pytest.mark.whole
@pytest.mark.parametrize(
    ("scene", "traced", "mapped", "better"),
    [(LAND, 0.02, 2.0, 3.0), (RIPPLED, 0.3, 4.0, 3.0), (WAVY, 1.5, 9.0, 1.66)],
    ids=["land in still water", "land and a boat in ripples", "boats in waves"],
)
def test_what_stands_by_the_water_is_in_the_mirror(
    executor: Executor, report: Report, scene: Scene, traced: float, mapped: float, better: float
) -> None:
    """By rays from the water within ``traced`` levels, by the map within ``mapped``; the sky alone is far from it.

    On waves the map knows only what the mirrored eye sees.
    """
    truth = render(scene, time=TIME, width=STANDING[0], height=STANDING[1]).rgb

    def off(scene: Scene, **parameters: object) -> float:
        return rmse(samples(executor, scene, EXACT.model_copy(update=parameters), time=TIME, size=STANDING), truth)

    alone = scene.model_copy(update={"light": scene.light.model_copy(update={"reflection": "sky"})})
    by_map, sky = off(scene, reflection="map", reflection_size=1024), off(alone)
    report.within(
        "The planar mirror against float64, 128 × 72, RMSE in levels",
        boats=len(scene.boats),
        waves=len(scene.waves),
        traced=(off(scene), traced),
        map_of_1024=(by_map, mapped),
        of_256=off(scene, reflection="map", reflection_size=256),
        sky_alone=sky,
    )
    assert sky >= better * by_map
