"""Over any scene that the schema admits, from any camera, at any time (docs/stability.md).

A scene is drawn from each seed, evenly from the schema's ranges: Hypothesis's floats crowd at the simple ones, where
little goes wrong, and give the same few scenes again and again.
"""

import math
from collections.abc import Callable
from random import Random
from typing import Any, get_args

import numpy as np
import pytest
from annotated_types import Ge, Le
from numpy.typing import NDArray
from pydantic import BaseModel

from seafoam.effects.light.light import sky_irradiance, sun_irradiance
from seafoam.ocean.waves.ripples import TILES
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from support import sweep
from support.exact import UNFILTERED
from support.pictures import levels, samples
from support.report import Report
from support.scenes import (
    Camera,
    Foam,
    FrontSaturation,
    HeightSaturation,
    Light,
    Look,
    ParametricWave,
    Ring,
    Ripples,
    Scene,
    Sea,
    Water,
    WhitecapSaturation,
)

SIZE = (32, 18)
QUALITIES = {
    name: quality.model_copy(update={"samples": 1, "target": "RGBA32F"})
    for name, quality in (("fast", TIERS["fast"]), ("standard", TIERS["standard"]), ("exact", UNFILTERED))
}
LEAST = 1e-30
"""Amplitudes between 0 and this are not drawn: 1/height overflows float32 there."""

Maker = Callable[[Random], Any]
Pixels = NDArray[np.float32]


def even(low: float, high: float) -> Maker:
    """Numbers spread evenly, the ends now and then."""
    return lambda r: r.choice((low, high)) if r.random() < 0.1 else r.uniform(low, high)


def spread(low: float, high: float) -> Maker:
    """Positive numbers, as many in each octave, the ends now and then."""
    inner = even(math.log(low), math.log(high))
    return lambda r: min(max(math.exp(inner(r)), low), high)


def one_of(*values: Any) -> Maker:
    """One of the values; of a maker, what it makes."""

    def make(r: Random) -> Any:
        value = r.choice(values)
        return value(r) if callable(value) else value

    return make


def several(*makers: Maker) -> Maker:
    """A tuple."""
    return lambda r: tuple(maker(r) for maker in makers)


def number(model: type[BaseModel], name: str) -> Maker:
    """A field's whole range, as the schema states it."""
    found = model.model_fields[name].metadata
    low = next(m.ge for m in found if isinstance(m, Ge))
    high = next(m.le for m in found if isinstance(m, Le))
    return even(float(low), float(high))


def of(model: type[Any], /, **makers: Maker) -> Maker:
    """A model with every numeric field drawn from its range, but for those given."""
    ranged = {name for name, field in model.model_fields.items() if field.annotation is float} - makers.keys()
    every = {**{name: number(model, name) for name in sorted(ranged)}, **makers}
    return lambda r: model(**{name: maker(r) for name, maker in every.items()})


def heights(r: Random) -> HeightSaturation:
    base = one_of(even(-100.0, 100.0), even(-2.0, 2.0))(r)
    return HeightSaturation(base=base, full=min(base + spread(2e-3, 200.0)(r), 200.0))


SHARES = one_of(0.0, 1.0, even(0.0, 1.0), even(0.0, 1.0))
LENGTHS = spread(0.01, 1000.0)
PLACES = even(-1e7, 1e7)
TIMES = one_of(0.0, -1e9, 1e9, even(-1e9, 1e9), even(-1e4, 1e4))
WAVES = of(
    ParametricWave,
    amplitude=one_of(0.0, spread(LEAST, 50.0), spread(0.01, 50.0), spread(0.01, 5.0)),
    wavelength=spread(0.05, 2000.0),
    exponent=spread(0.1, 100.0),
    speed=one_of(None, even(0.0, 200.0)),
)
FRONTS = of(
    FrontSaturation,
    constants=one_of("text", "listing"),
    intensity=spread(0.25, 100.0),
    group=one_of((0.0, 0.0), lambda r: tuple(sorted((r.random(), r.random())))),
)
FOAMS = of(
    Foam,
    saturation=one_of(several(FRONTS), several(heights), several(FRONTS, heights)),
    combine=one_of("max", "product"),
    look=one_of(*get_args(Look)),
    mask=one_of("vac-1.5", "vac-24", "mix"),
    mask_tile=spread(0.05, 1000.0),
    texture_tile=spread(0.05, 1000.0),
    texture=SHARES,
    fade=SHARES,
    albedo=SHARES,
)
RIPPLES = of(Ripples, seed=lambda r: r.randrange(65536))
WATERS = of(
    Water,
    absorption_length=several(LENGTHS, LENGTHS, LENGTHS),
    depth=one_of(None, spread(0.05, 11000.0)),
    floor_albedo=several(SHARES, SHARES, SHARES),
    ripples=one_of(None, RIPPLES),
)
LIGHTS = of(Light, visibility=spread(50.0, 1e6))
EYES = one_of(-1000.0, 0.0, even(-5.0, 100.0), spread(1e-3, 1e5), spread(1.0, 100.0))
CAMERAS = of(Camera, position=several(PLACES, EYES, PLACES))


def ring(r: Random) -> Ring:
    """A ring no steeper than water can be, near the origin, of any time."""
    length = spread(0.05, 500.0)(r)
    return Ring(
        place=(r.uniform(-50.0, 50.0), r.uniform(-50.0, 50.0)),
        birth=TIMES(r),
        amplitude=min(spread(1e-6, 0.1)(r) * length, 20.0),
        decay=spread(0.01, 10.0)(r),
        wavelength=length,
        crests=one_of(None, spread(0.5, 100.0))(r),
    )


SCENES = of(
    Scene,
    rings=lambda r: tuple(ring(r) for _ in range(r.choice((0, 0, 1, 4)))),
    waves=lambda r: tuple(WAVES(r) for _ in range(r.choice((0, 1, 2, 3)))),
    foam=one_of(None, FOAMS, FOAMS),
    water=WATERS,
    light=one_of(None, LIGHTS, LIGHTS, LIGHTS),
)


SEAS = of(
    Sea,
    model=one_of("fft", "gerstner"),
    wind=one_of(0.0, 60.0, even(0.0, 60.0), spread(0.01, 60.0)),
    fetch=spread(100.0, 1e7),
    spread=one_of(0.0, spread(0.1, 100.0)),
    seed=lambda r: r.randrange(65536),
)
WHITECAPS = of(WhitecapSaturation)


def open_sea(r: Random) -> Scene:
    foam = Foam(saturation=(WHITECAPS(r),), look=one_of("filtered", "halftone", "textured")(r))
    return Scene(
        sea=SEAS(r),
        foam=one_of(None, foam, foam)(r),
        water=Water(depth=one_of(None, spread(0.05, 11000.0))(r)),
        light=one_of(None, LIGHTS, LIGHTS)(r),
    )


def seen(r: Random) -> Scene:
    """A scene whose picture is seldom black or white: exposure within a stop."""
    scene: Scene = SCENES(r)
    light = scene.light and scene.light.model_copy(update={"exposure": 0.1 * scene.light.exposure})
    return scene.model_copy(update={"light": light})


def view(r: Random, scene: Scene) -> Camera:
    """A camera over the crests that sees water."""
    height = 1.2 * sum(wave.amplitude for wave in scene.waves) + spread(1.0, 100.0)(r)
    position = several(PLACES, lambda _: height, PLACES)
    return of(Camera, position=position, pitch=even(-1.5, -0.1), fov=even(0.2, 1.5))(r)


def brightest(scene: Scene) -> float:
    """No sample is brighter; derived in docs/stability.md."""
    light = scene.light
    if light is None:
        return 1.0
    sun = max(sun_irradiance(light))
    sky = 49.5
    body = (sun + max(sky_irradiance(light)) + scene.water.translucency * sun) / math.pi
    glitter, disc = (1e4, 3000.0) if sun > 0.0 else (0.0, 0.0)
    return min(2.0**light.exposure * max(max(body, sky) + glitter, sky + disc), 65504.0)


def is_sound(executor: Executor, scene: Scene, quality: Quality, camera: Camera, time: float) -> None:
    pixels = samples(executor, scene, quality, camera, time=time, size=SIZE)
    assert np.isfinite(pixels).all()
    assert (pixels >= 0.0).all()
    assert (pixels[..., 3] <= 1.0).all()
    assert pixels[..., :3].max() <= brightest(scene) * (1.0 + 1e-5) + 1e-6


SEA_QUALITIES = [
    TIERS[tier].model_copy(update={"target": "RGBA32F", "sea_size": size})
    for tier, size in (("fast", 64), ("standard", 128))
]


@pytest.mark.parametrize("seed", sweep.spread(range(30), 3))
def test_any_frame_is_finite_and_no_brighter_than_its_light(executor: Executor, seed: int) -> None:
    r = Random(seed)
    scene, camera, time = SCENES(r), CAMERAS(r), TIMES(r)
    is_sound(executor, scene, QUALITIES[r.choice(sorted(QUALITIES))], camera, time)


@pytest.mark.parametrize("seed", sweep.spread(range(12), 3))
def test_any_sea_is_finite_and_no_brighter_than_its_light(executor: Executor, seed: int) -> None:
    r = Random(seed)
    scene, camera, time = open_sea(r), CAMERAS(r), TIMES(r)
    for quality in SEA_QUALITIES:
        is_sound(executor, scene, quality, camera, time)


def alike(report: Report, what: str, one: Pixels, other: Pixels, mean: float = 0.5, over_2: float = math.inf) -> None:
    """Two pictures are so near: their mean difference in levels, and the share of pixels that are off by over 2."""
    off = levels(one, other)
    title = "Properties of any scene, 32 × 18, levels"
    report.within(title, property=what, mean=(off.mean(), mean), over_2=((off > 2.0).mean(), over_2))


def still(scene: Scene, tile: float, share: int) -> Scene:
    """Without waves and rings, foam everywhere, its tiles whole parts of ``tile``."""
    foam = (scene.foam or Foam()).model_copy(
        update={
            "saturation": (HeightSaturation(base=-0.5, full=0.5 + 0.01 * share),),
            "mask_tile": tile / share,
            "texture_tile": tile / (3 * share),
            "mask_angle": 0.0,
        }
    )
    return scene.model_copy(update={"waves": (), "rings": (), "foam": foam})


@pytest.mark.parametrize("seed", sweep.spread(range(12), 3))
def test_a_shift_by_whole_tiles_changes_nothing(executor: Executor, report: Report, seed: int) -> None:
    """774.9 m hold 41 of the long ripple tiles and 189 of the short, 29 times that also whole turned copies of them;
    shifts of up to 30 times that."""
    whole = 29 * 774.9
    assert all(math.isclose(whole / tile, round(whole / tile), rel_tol=1e-12) for tile in TILES)
    r = Random(seed)
    scene, time = still(seen(r), 774.9, r.randint(1, 60)), TIMES(r)
    quality, camera = QUALITIES[r.choice(("standard", "exact"))], view(r, scene)
    x, y, z = r.uniform(-50.0, 50.0), camera.position[1], r.uniform(-50.0, 50.0)
    away = whole * r.randint(-30, 30), whole * r.randint(-30, 30)
    cameras = [camera.model_copy(update={"position": at}) for at in ((x, y, z), (x + away[0], y, z + away[1]))]
    here, there = (samples(executor, scene, quality, one, time=time, size=SIZE) for one in cameras)
    alike(report, "a shift by whole tiles", here, there, over_2=0.01)
