"""Every preset wherever and whenever a visitor takes it: nothing blank, nothing flashing, no NaN, as sharp as ever."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.pictures import colours, draw, samples
from support.report import Report
from support.scenes import Camera, Scene, load_preset, preset_names
from support.sweep import crossed

SIZE = (64, 36)
STEP = 1e-3
"""Between frames that must look alike, m and s."""
PARTS = 8
"""Of the places, each drawn by itself."""
LEVELS = 12.0
"""Most by which their means may differ."""


@dataclass(frozen=True)
class Place:
    """Where the camera goes, and what of it is certain."""

    name: str
    camera: Camera
    dark: bool = False
    """Whether there may be nothing to see: the depths of a lake at night, ground, the unlit side of the water."""


def places(scene: Scene, plan: FramePlan, time: float) -> Iterator[Place]:
    """Grazing, through a crest, under the surface, straight down, at a boat, and where nobody should be."""
    start = scene.camera
    x, _, z = start.position

    def at(name: str, y: float, pitch: float, dark: bool = False, **fields: float) -> Place:
        moved = start.model_copy(update={"position": (x, y, z), "pitch": pitch, **fields})
        return Place(name, moved, dark)

    crest = max(plan.top, 0.1)
    yield at("as it starts", start.position[1], start.pitch)
    yield at("grazing, at the crests' height", crest + 1e-3, 0.0)
    yield at("grazing, a hair down", crest + 0.02, -1e-3)
    yield at("straight down from near", crest + 1.0, -math.pi / 2, dark=True)
    yield at("straight down from far", 500.0, -math.pi / 2, dark=True)
    yield at("straight up", crest + 1.0, math.pi / 2, dark=True)
    yield at("on its side", crest + 0.5, -0.2, roll=math.pi / 2)
    for share in (0.95, 0.75, 0.5, 0.25, 0.05):
        yield at(f"through a crest, {share:g} of its height", share * crest, -0.05, dark=True)
    for down in (1e-6, 0.05, 0.5, 3.0):
        for pitch in (-0.6, 0.0, 0.6, math.pi / 2):
            y = max(-down, plan.bottom + 0.1)
            yield at(f"{down:g} m under still water, pitch {pitch:.1f}", y, pitch, dark=True)
    yield at("a hand over the ground", plan.bottom + 0.1, 0.3, dark=True)
    yield at("under the ground", plan.bottom - 5.0, 0.3, dark=True)
    yield at("ten thousand kilometres away", start.position[1], start.pitch, dark=True)
    away = start.model_copy(update={"position": (1e7, crest + 8.0, -1e7), "pitch": -0.2, "roll": 1.0})
    yield Place("the far corner of the map, askew", away, dark=True)
    yield at("a hundred kilometres up", 1e5, -0.5, dark=True, fov=2.6)
    for boat in scene.boats[:1]:
        turned = boat.bearing + boat.speed / boat.radius * time * (1.0 if boat.turn == "starboard" else -1.0)
        middle = boat.centre[0] + boat.radius * math.cos(turned), boat.centre[1] + boat.radius * math.sin(turned)
        for y, name in ((1.0, "in a boat"), (-0.4, "in its keel"), (0.1 * boat.length, "at its sail")):
            camera = start.model_copy(update={"position": (middle[0], y, middle[1])})
            yield Place(name, camera, dark=True)


def sound(pixels: NDArray[np.float32]) -> bool:
    return bool(np.isfinite(pixels).all() and (pixels >= 0.0).all() and (pixels[..., 3] <= 1.0).all())


@pytest.mark.parametrize(("name", "part"), crossed(preset_names(), range(PARTS), PARTS, 3))
def test_a_preset_flown_anywhere(executor: Executor, report: Report, name: str, part: int) -> None:
    preset = load_preset(name)
    plan = make_plan(preset.scene, TIERS["standard"])
    apart: dict[str, float] = {}
    for place in list(places(preset.scene, plan, preset.time))[part::PARTS]:
        first = draw(executor, plan, place.camera, time=preset.time, size=SIZE, output="samples")
        assert sound(first), place.name
        if not place.dark:
            assert colours(first).max() > 0.02, place.name
            assert np.ptp(colours(first)) > 0.01, place.name
        x, y, z = place.camera.position
        # Away from still water, where an eye that comes through sees something else; by less where it is near.
        step = min(STEP, 0.1 * abs(y))
        nudged = place.camera.model_copy(update={"position": (x + step, y + math.copysign(step, y), z - step)})
        second = draw(executor, plan, nudged, time=preset.time + STEP, size=SIZE, output="samples")
        apart[place.name] = 255.0 * abs(float(colours(first).mean() - colours(second).mean()))
    at = max(apart, key=apart.__getitem__)
    report.within(
        f"Mean levels that {1000 * STEP:g} mm and ms change, the camera anywhere",
        preset=name,
        part=f"{part + 1} of {PARTS}",
        at=at,
        worst=(apart[at], LEVELS),
    )
    exact = TIERS["reference"].model_copy(update={"target": "RGBA32F"})
    assert sound(samples(executor, preset.scene, exact, place.camera, time=preset.time, size=SIZE)), place.name
