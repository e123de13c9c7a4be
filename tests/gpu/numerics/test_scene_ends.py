"""Every scene that is accepted compiles and draws sound pixels: fields at their ends, alone and in pairs, from cameras
and at times of all kinds, and every effect left out."""

import copy
import math
from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import Any

import pytest

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import PlanError, make_plan, planner
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from support.hard.pictures import unsound
from support.pictures import draw
from support.report import Report
from support.scenes import Camera, Scene, load_preset, preset_names
from support.sweep import crossed, spread

Path = tuple[str | int, ...]
SCHEMA = Scene.model_json_schema()
KINDS: dict[str, type | tuple[type, ...]] = {
    "null": type(None),
    "boolean": bool,
    "number": (int, float),
    "integer": (int, float),
    "string": str,
    "array": list,
    "object": dict,
}


def edges(scene: Scene) -> Iterator[tuple[Path, Any]]:
    """Path and value: both ends of each number, other values of each choice, and nothing where that is allowed.

    The camera's fields are left out: they are drawn for each picture.
    """
    for path, value in _edges_of(SCHEMA, scene.model_dump(mode="json"), ()):
        if path[0] != "camera":
            yield path, value


def changed(scene: Scene, *changes: tuple[Path, Any]) -> Scene:
    """The scene with other values. Raises ``ValueError`` where they are refused, or their place is gone."""
    document = scene.model_dump(mode="json")
    for path, value in changes:
        node: Any = document
        try:
            for step in path[:-1]:
                node = node[step]
            node[path[-1]] = copy.deepcopy(value)
        except (TypeError, IndexError, KeyError):
            raise ValueError(f"{path}: no such place") from None
    return Scene.model_validate(document)


def _edges_of(node: Any, value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    options = list(_options(node))
    if value is not None and any(option.get("type") == "null" for option in options):
        yield path, None
    fitting = next((option for option in options if _fits(option, value)), None)
    if fitting is None or "const" in fitting:
        return
    if "enum" in fitting:
        yield from ((path, other) for other in fitting["enum"] if other != value)
    elif isinstance(value, bool):
        yield path, not value
    elif isinstance(value, int | float):
        yield from ((path, fitting[end]) for end in ("minimum", "maximum") if fitting.get(end, value) != value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            inner = fitting["prefixItems"][index] if "prefixItems" in fitting else fitting["items"]
            yield from _edges_of(inner, item, (*path, index))
        if value and "prefixItems" not in fitting and not fitting.get("minItems"):
            yield path, []
    elif isinstance(value, dict):
        for name, item in value.items():
            if name in fitting.get("properties", {}):
                yield from _edges_of(fitting["properties"][name], item, (*path, name))


def _options(node: Any) -> Iterator[Any]:
    if "$ref" in node:
        yield from _options(SCHEMA["$defs"][node["$ref"].rsplit("/", 1)[1]])
    elif either := node.get("anyOf") or node.get("oneOf"):
        for one in either:
            yield from _options(one)
    else:
        yield node


def _fits(option: Any, value: Any) -> bool:
    kind = option.get("type", "string")
    if isinstance(value, bool) != (kind == "boolean") or not isinstance(value, KINDS[kind]):
        return False
    constants = {name: one["const"] for name, one in option.get("properties", {}).items() if "const" in one}
    return not isinstance(value, dict) or all(value.get(name, one) == one for name, one in constants.items())


PARTS = 24
"""Of a preset's scenes, each tried by itself."""
DRAWN = 8
"""One in so many is drawn too: a driver compiles for a second or two."""
QUALITY = TIERS["fast"].model_copy(update={"target": "RGBA32F", "samples": 1})
TIMES = (0.0, 2.7, -1e9, 1e9)


def camera(random: Random, own: Camera) -> Camera:
    """The preset's own now and then; else one of any place, turned anyhow, low or high or under the surface."""
    if random.random() < 0.3:
        return own
    eye = random.choice((-1000.0, 0.0, random.uniform(-5.0, 100.0), math.exp(random.uniform(-7.0, 11.5))))
    place = (random.uniform(-1e7, 1e7), eye, random.uniform(-1e7, 1e7))
    turn = {name: random.uniform(-most, most) for name, most in (("yaw", 6.28), ("pitch", 1.57), ("roll", 3.14))}
    return Camera(position=place, fov=random.uniform(0.01, 2.6), **turn)


def compiles(executor: Executor, plan: FramePlan) -> None:
    """Compile and link every program of a plan. Raises ``ShaderError``."""
    for program in plan.programs.values():
        executor._program(program)


@pytest.mark.parametrize(("preset", "part"), crossed(preset_names(), range(PARTS), PARTS, 6, 4))
def test_fields_at_their_ends(executor: Executor, report: Report, preset: str, part: int) -> None:
    scene, random = load_preset(preset).scene, Random(part)
    found = list(edges(scene))
    tried = [(one,) for one in found[part::PARTS]]
    tried += [tuple(random.sample(found, 2)) for _ in range(len(tried) // 2)]
    refused = 0
    for index, changes in enumerate(tried):
        try:
            plan = make_plan(changed(scene, *changes), QUALITY)
        except (ValueError, PlanError):
            refused += 1
            continue
        compiles(executor, plan)
        if index % DRAWN == part % DRAWN:
            eye, time = camera(random, scene.camera), random.choice(TIMES)
            pixels = draw(executor, plan, eye, time=time, size=(16, 9), output="samples")
            assert unsound(pixels) == [], (changes, eye, time)
    assert refused < 0.5 * len(tried)
    report.add("Fields at their ends", preset=preset, part=f"{part}", scenes=f"{len(tried)}", refused=f"{refused}")


def test_a_drowned_shore(executor: Executor) -> None:
    """Foam of the surf where the shore itself is left out."""
    scene = changed(load_preset("beach").scene, (("shore", "level"), -100.0))
    plan = make_plan(scene, QUALITY)
    assert {"shore", "surf foam"} <= {effect.name for effect in plan.skipped}
    compiles(executor, plan)


@pytest.mark.parametrize("preset", spread(preset_names(), 8))
def test_what_is_left_out_is_not_missed(executor: Executor, monkeypatch: pytest.MonkeyPatch, preset: str) -> None:
    """Effects that can be left out, one at a time and all: no other needs their files, maps or uniforms."""
    scene, quality = load_preset(preset).scene, TIERS["standard"]

    def may_go(effect: Effect) -> bool:
        made = effect.contribute(scene, quality)
        return made is not None and (made.bound is not None or effect.without is not None)

    def gone(effect: Effect) -> Effect:
        def contribute(scene: Scene, quality: Quality) -> Contribution | None:
            made = effect.contribute(scene, quality)
            return None if made is None else Contribution(why="", bound=Bound(0.0, "left out by a test"))

        return replace(effect, contribute=contribute)

    names = [effect.name for effect in EFFECTS if may_go(effect)]
    assert names
    for left_out in [{name} for name in names] + [set(names)]:
        effects = tuple(gone(effect) if effect.name in left_out else effect for effect in EFFECTS)
        monkeypatch.setattr(planner, "EFFECTS", effects)
        make_plan.cache_clear()
        compiles(executor, make_plan(scene, quality))
    make_plan.cache_clear()
