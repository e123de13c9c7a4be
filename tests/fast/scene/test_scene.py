"""Scenes: what they accept, and the wind that all parts follow."""

import copy
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from seafoam.ocean.waves.ripples import TILES, TURN, WAVES_PER_TILE, ripple_cascades, tiles
from seafoam.reference import scene_sha256
from seafoam.scene.base import non_defaults
from seafoam.scene.foam import Foam, HeightSaturation, SlopeSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.scene.water import Ripples, Water


@pytest.mark.parametrize(
    ("document", "where"),
    [
        ({"waves": [{"exponent": float("nan")}]}, ("waves", 0, "exponent")),
        ({"foam": {"saturation": [{"source": "height", "base": 1, "full": 1}]}}, ("foam", "saturation", 0, "height")),
        ({"foam": {"saturation": [{"source": "front", "group": [0.5, 0.1]}]}}, ("foam", "saturation", 0, "front")),
        ({"foam": {"saturation": [{"source": "front"}, {"source": "front"}]}}, ("foam",)),
        ({"camera": {"position": [0, float("inf"), 0]}}, ("camera", "position", 1)),
    ],
)
def test_what_no_schema_can_say_is_refused_where_it_stands(
    document: dict[str, object], where: tuple[object, ...]
) -> None:
    """Fields and ranges: test_api_errors.py."""
    with pytest.raises(ValidationError) as caught:
        Scene.model_validate(document)
    assert any(tuple(error["loc"])[: len(where)] == where for error in caught.value.errors())


def test_every_number_has_a_description_and_a_range() -> None:
    def check(node: dict[str, object], path: str) -> None:
        if node.get("type") in ("number", "integer"):
            assert {"minimum", "maximum"} <= node.keys(), f"{path} has no range"
        for key in ("anyOf", "oneOf", "prefixItems"):
            for i, part in enumerate(node.get(key, [])):
                check(part, f"{path}/{i}")

    schema = Scene.model_json_schema()
    for name, model in schema["$defs"].items():
        for field, node in model.get("properties", {}).items():
            check(node, f"{name}.{field}")
            numeric = node.get("type") in ("number", "integer") or "prefixItems" in node
            assert not numeric or node.get("description"), f"{name}.{field} has no description"


def test_ripples_tile_and_have_the_slope_asked_for() -> None:
    ripples = Ripples(slope=0.2, seed=9)
    cascades = ripple_cascades(ripples)
    assert [len(waves) for waves in cascades] == [WAVES_PER_TILE] * 2 * len(TILES)
    for i, waves in enumerate(cascades):
        tile, (c, s) = TILES[i % 2], (1.0, 0.0) if i < len(TILES) else TURN
        turned = [(c * w.kx + s * w.kz, c * w.kz - s * w.kx) for w in waves]
        numbers = [(kx * tile / (2 * math.pi), kz * tile / (2 * math.pi)) for kx, kz in turned]
        assert all(abs(a - round(a)) < 1e-9 and abs(b - round(b)) < 1e-9 for a, b in numbers)
        assert len({(round(a), round(b)) for a, b in numbers}) == WAVES_PER_TILE
    assert math.isclose(sum(0.5 * w.slope**2 for waves in cascades for w in waves), 0.2**2)
    assert (
        ripple_cascades(ripples)
        == ripple_cascades(Ripples(slope=0.2, seed=9))
        != ripple_cascades(Ripples(slope=0.2, seed=10))
    )
    # The mean square slope over a whole tile is the one asked for.
    waves = ripple_cascades(Ripples(slope=0.2, seed=4))[0]
    x, z = np.meshgrid(*(np.arange(128) * TILES[0] / 128,) * 2)
    slopes = [-w.slope / w.k * np.cos(w.phase - w.kx * x - w.kz * z) for w in waves]
    sx = sum(s * w.kx for s, w in zip(slopes, waves, strict=True))
    sz = sum(s * w.kz for s, w in zip(slopes, waves, strict=True))
    opposite = {(-round(w.kx, 6), -round(w.kz, 6)) for w in waves} & {(round(w.kx, 6), round(w.kz, 6)) for w in waves}
    assert not opposite
    assert math.isclose(float(np.mean(sx**2 + sz**2)), 0.2**2 / 4, rel_tol=1e-6)


def test_ripples_do_not_repeat_with_their_tiles() -> None:
    """Slopes a tile apart along an axis are about half alike; where ripples must repeat or run one way, the same."""
    x, z = np.random.default_rng(3).uniform(-50.0, 50.0, (2, 4000))
    for spread, repeats, least, most in ((1.0, False, -0.2, 0.6), (1.0, True, 0.999, 1.0), (0.1, False, 0.999, 1.0)):
        waves = ripple_cascades(Ripples(slope=0.2, spread=spread), repeats)
        tile = tiles(repeats)[1]
        short = [w for cascade in waves[1::2] for w in cascade]
        along = [
            sum(-w.slope * w.kx / w.k * np.cos(w.phase - w.kx * at - w.kz * z) for w in short) for at in (x, x + tile)
        ]
        assert least <= float(np.corrcoef(*along)[0, 1]) <= most


@pytest.mark.parametrize("name", preset_names())
def test_non_defaults_are_the_whole_scene(name: str) -> None:
    scene = load_preset(name).scene
    assert Scene.model_validate(non_defaults(scene)) == scene


def test_non_defaults_include_the_discriminators_of_unions() -> None:
    assert non_defaults(Scene()) == {}
    assert non_defaults(Scene(light=None)) == {"light": None}
    assert non_defaults(Scene(light=Light(), water=Water(depth=3.0))) == {"water": {"depth": 3.0}}
    kinds = [non_defaults(Scene(foam=Foam(saturation=(kind(),)))) for kind in (HeightSaturation, SlopeSaturation)]
    assert kinds == [{"foam": {"saturation": [{"source": source}]}} for source in ("height", "slope")]


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
    blowing, set_so = scene_of(STILL, {}, *wind), scene_of(STILL, blown(*wind))
    assert blowing.settled == set_so.settled
    assert scene_sha256(blowing) == scene_sha256(set_so) != scene_sha256(scene_of(STILL, {}, 14.0, 1.25))
    for name, value in OWN.items():
        for own in (0.4, value):
            assert in_effect(scene_of(STILL, {name: own}, *wind)) == pytest.approx({**blown(*wind), name: own}), name
