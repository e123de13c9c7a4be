"""One wind for all parts of a scene, and parts that have their own."""

import copy
import math
from collections.abc import Mapping
from typing import Any

import pytest

from seafoam.ocean.waves.cascades import cascades
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import scene_sha256
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.sums import summed

STILL: dict[str, Any] = {
    "sea": {},
    "water": {"ripples": {"gusts": {}}},
    "foam": {"saturation": [{"source": "whitecap"}], "life": {}},
    "spray": {},
    "light": {"sky": {"clouds": {}, "cirrus": {}}},
}
"""Every part that the wind moves, with nothing said of it."""
OWN = {
    **{"sea.wind": 10.0, "water.ripples.gusts.speed": 3.0, "foam.life.wind_drift": 0.0, "foam.life.windrows": 0.0},
    **{
        "spray.wind": 3.0,
        "light.sky.clouds.wind": 8.0,
        "light.sky.cirrus.wind": 25.0,
        "light.sky.cirrus.direction": 0.6,
    },
    **{f"{part}.wind_direction": 0.0 for part in ("sea", "water.ripples", "foam.life", "spray", "light.sky.clouds")},
}
"""By field that follows a wind, what it is without one."""


def blown(speed: float, direction: float) -> dict[str, float]:
    """What these fields are in a wind, by docs/formulae.md."""
    factors = {"foam.life.wind_drift": 0.02, "light.sky.clouds.wind": 1.6, "light.sky.cirrus.wind": 2.5}
    factors |= {"sea.wind": 1.0, "water.ripples.gusts.speed": 0.8, "spray.wind": 1.0}
    found = {name: factors.get(name, 0.0) * speed or direction * name.endswith("direction") for name in OWN}
    rows = min(max((speed - 4.0) / 18.0, 0.0), 1.0)
    return {**found, "foam.life.windrows": rows, "spray.wind": min(found["spray.wind"], 40.0)}


def scene_of(document: Mapping[str, Any], values: Mapping[str, float | None], *wind: float) -> Scene:
    """A scene with fields of its parts set, and with a wind of a speed and direction, if any."""
    made = copy.deepcopy({**document, "wind": dict(zip(("speed", "direction"), wind, strict=True)) if wind else None})
    for name, value in values.items():
        *steps, last = name.split(".")
        part = made
        for step in steps:
            part = part[step]
        part[last] = value
    return Scene.model_validate(made)


def found(scene: Scene, name: str) -> float | None:
    """The value of a field; None too where the scene has no such part."""
    part: Any = scene
    for step in name.split("."):
        part = getattr(part, step, None)
    return part


def in_effect(scene: Scene) -> dict[str, float]:
    values = {name: found(scene.settled, name) for name in OWN}
    return {name: OWN[name] if value is None else value for name, value in values.items()}


def test_without_a_wind_parts_have_their_defaults() -> None:
    scene = scene_of(STILL, {})
    assert scene_of(STILL, OWN).settled == scene.settled == scene
    assert scene_sha256(scene_of(STILL, OWN)) == scene_sha256(scene)


def test_parts_follow_the_wind_and_a_field_of_a_part_wins() -> None:
    for speed in (0.0, 3.0, 13.0, 60.0):
        assert in_effect(scene_of(STILL, {}, speed, 1.25)) == pytest.approx(blown(speed, 1.25), rel=1e-12)
    wind = 13.0, 1.25
    for name, value in OWN.items():
        for own in (0.4, value):
            assert in_effect(scene_of(STILL, {name: own}, *wind)) == pytest.approx({**blown(*wind), name: own}), name


def test_a_wind_draws_what_its_parts_would() -> None:
    scenes = scene_of(STILL, {}, 13.0, 1.25), scene_of(STILL, blown(13.0, 1.25)), scene_of(STILL, {}, 14.0, 1.25)
    plans = [make_plan(each, TIERS["standard"]).sha256 for each in scenes]
    assert plans[0] == plans[1] != plans[2]
    assert scene_sha256(scenes[0]) == scene_sha256(scenes[1]) != scene_sha256(scenes[2])


def test_more_wind_is_a_rougher_sea_with_faster_clouds_and_more_rows_of_foam() -> None:
    ocean, before = load_preset("open-ocean").scene.model_dump(mode="json"), (0.0, 0.0, 0.0)
    follow = dict.fromkeys(name for name in OWN if found(load_preset("open-ocean").scene, name) is not None)
    for speed in (6.0, 10.0, 16.0):
        scene = scene_of(ocean, follow, speed, 1.25)
        rough = summed(tile.variance for tile in cascades(scene.settled.sea, None))
        uniforms = make_plan(scene, TIERS["standard"]).uniforms
        (x, z), (rows,) = (rule.rate for rule in uniforms["u_cloud_phase"].rules[:2]), uniforms["u_windrows"].rules
        after = rough, math.hypot(x, z), rows.value[0]
        assert all(less < more for less, more in zip(before, after, strict=True))
        before = after


@pytest.mark.parametrize("name", preset_names())
def test_presets_say_of_the_wind_only_what_differs(name: str) -> None:
    scene = load_preset(name).scene
    document = scene.model_dump(mode="json")
    for field in (field for field in OWN if found(scene, field) is not None):
        assert scene_of(document, {field: None}, *dict(scene.wind or {}).values()).settled != scene.settled, field
