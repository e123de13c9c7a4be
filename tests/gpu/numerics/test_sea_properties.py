"""Any open sea that the schema admits, from any camera, at any time: finite, no brighter than its light, and steady."""

import math
from random import Random

import numpy as np
from hypothesis import given, settings

from seafoam.ocean.cascades import cascades
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, WhitecapSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water
from seafoam.scene.waves import Sea
from support.pictures import levels, samples
from support.report import Report

from .test_properties import (
    CAMERAS,
    LIGHTS,
    SEEDS,
    SIZE,
    STABLE,
    TABLE,
    TIMES,
    brightest,
    even,
    of,
    one_of,
    spread,
)

QUALITIES = {
    "draft": TIERS["draft"].model_copy(update={"target": "RGBA32F", "sea_size": 64}),
    "standard": TIERS["standard"].model_copy(update={"target": "RGBA32F", "sea_size": 128}),
}
PLAIN = of(
    Sea,
    wind=one_of(0.0, 60.0, even(0.0, 60.0), spread(0.01, 60.0)),
    fetch=spread(100.0, 1e7),
    spread=one_of(0.0, spread(0.1, 100.0)),
    seed=lambda r: r.randrange(65536),
)
FOLDS = of(WhitecapSaturation)


def some_sea(r: Random) -> Sea:
    """Of either model."""
    sea: Sea = PLAIN(r)
    return sea.model_copy(update={"model": r.choice(("fft", "gerstner"))})


def scene_of(r: Random) -> Scene:
    foam = Foam(saturation=(FOLDS(r),), look=one_of("filtered", "halftone", "textured")(r))
    return Scene(
        sea=some_sea(r),
        foam=one_of(None, foam, foam)(r),
        water=Water(depth=one_of(None, spread(0.05, 11000.0))(r)),
        light=one_of(None, LIGHTS, LIGHTS)(r),
    )


@settings(max_examples=12, **STABLE)
@given(seed=SEEDS)
def test_any_sea_is_finite_and_no_brighter_than_its_light(executor: Executor, seed: int) -> None:
    r = Random(seed)
    scene, camera, time = scene_of(r), CAMERAS(r), TIMES(r)
    for quality in QUALITIES.values():
        pixels = samples(executor, scene, quality, camera, time=time, size=SIZE)
        assert np.isfinite(pixels).all()
        assert (pixels >= 0.0).all()
        assert (pixels[..., 3] <= 1.0).all()
        assert pixels[..., :3].max() <= brightest(scene) * (1.0 + 1e-5) + 1e-6


def test_a_small_step_of_time_changes_the_sea_a_little(executor: Executor, report: Report) -> None:
    met: list[float] = []

    @settings(max_examples=6, **STABLE)
    @given(seed=SEEDS)
    def holds(seed: int) -> None:
        r = Random(seed)
        sea = some_sea(r).model_copy(update={"wind": spread(1.0, 60.0)(r)})
        scene, time = Scene(sea=sea, light=Light()), TIMES(r)
        camera = Camera(position=(r.uniform(-1e7, 1e7), 150.0, 0.0), pitch=-0.5)
        step = max(1e-6, 8.0 * math.ulp(time))
        fastest = max(float(tile.turns.max()) for tile in cascades(sea, None)) * 2.0 * math.pi / 2048.0
        # float32 holds the fine part of the loop, under 2 s, to 1.2e-7 s.
        bound = 0.5 + 255.0 * 20.0 * fastest * (step + 2.4e-7)
        frames = [
            samples(executor, scene, QUALITIES["standard"], camera, time=at, size=SIZE) for at in (time, time + step)
        ]
        met.append(float(levels(*frames).mean()) / bound)
        assert met[-1] <= 1.0

    holds()
    report.add(TABLE, property="a small step of time, open sea", worst=f"{100 * max(met):.1f} % of the bound")
