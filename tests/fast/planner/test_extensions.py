"""Effects from outside the package, and each effect alone: switched on in the default scene, off without a trace."""

import json
from collections.abc import Iterator
from functools import reduce
from importlib.metadata import EntryPoint
from operator import getitem
from typing import Any, get_args

import pytest
from bench.drawn.isolation import switch
from pydantic import BaseModel, Field, ValidationError

from seafoam.accuracy.points import every_parameter, value_at, with_value
from seafoam.api.frames.plans import compile_scene
from seafoam.effects import EFFECTS, outside, register, registry
from seafoam.effects.effect import Contribution, Effect, Extension, QualityParameter, SaturationSource
from seafoam.planner import make_plan, planner
from seafoam.quality import TIERS, Quality, QualityParameters
from seafoam.reference import scene_sha256
from seafoam.render.service.jobs import plan_hash
from seafoam.scene import Camera, Part, Saturation, Scene, SceneExtensions, Wind, load_preset
from support.cases import cases_of, unregister

STANDARD, DEFAULT = TIERS["standard"], load_preset("default").scene


class Rows(Part):
    """Rows of foam."""

    spacing: float = Field(default=14.0, ge=1.0, le=500.0, description="Spacing, m")
    place: tuple[float, float] = Field(default=(0.0, 0.0), description="Place (x, z), m")


class RowQuality(QualityParameters):
    """Settings of rows."""

    taps: int = Field(default=2, ge=1, le=4, description="Taps")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    part = scene.extensions.given(Rows)
    settings = quality.extensions.given(RowQuality) or RowQuality()
    return None if part is None else Contribution(why=f"{part.spacing:g} m, {settings.taps} taps")


ROWS = Effect(
    "rows",
    contribute,
    parameters=(QualityParameter("/extensions/rows/taps", "taps of rows", (1, 2, 4), "filtering"),),
    saturation=SaturationSource(Rows, lambda part, scene: 3.0, ("spacing",)),
    extension=Extension("rows", scene=Rows, quality=RowQuality),
)


@pytest.fixture
def rows() -> Iterator[Effect]:
    register(ROWS)
    yield ROWS
    unregister(ROWS)


def with_rows(**fields: Any) -> Scene:
    return Scene.model_validate({"extensions": {"rows": fields}})


def refused(model: type[BaseModel], document: Any) -> set[tuple[str, tuple[str | int, ...]]]:
    with pytest.raises(ValidationError) as raised:
        model.model_validate_json(json.dumps(document), strict=True)
    return {(item["type"], item["loc"]) for item in raised.value.errors()}


def test_without_extensions_nothing_speaks_of_them() -> None:
    assert outside() == ()
    assert "extensions" not in Scene().model_dump()
    assert "extensions" not in json.dumps([Scene.model_json_schema(), Quality.model_json_schema()]).lower()
    assert refused(Scene, {"extensions": {"rows": {}}}) == {("extra_forbidden", ("extensions", "rows"))}
    assert Scene(extensions=SceneExtensions()) == Scene()


@pytest.mark.usefixtures("rows")
def test_fields_are_validated_and_described_where_they_stand() -> None:
    scene = with_rows(spacing=3.0)
    assert scene.extensions.given(Rows) == Rows(spacing=3.0)
    assert Scene.model_validate_json(scene.model_dump_json(), strict=True) == scene != Scene()
    assert Scene.model_validate(scene.model_dump()) == scene
    assert with_rows(spacing=3.0, place=(1.0, 2.0)) != scene
    assert Scene.model_validate({"extensions": {"rows": None}}) == Scene()
    assert len({scene, with_rows(spacing=3.0), with_rows()}) == 2
    at = ("extensions", "rows")
    wrong = {"rows": {"spacing": 0.1, "width": 2.0, "place": [1.0, "2"]}, "nope": {}}
    assert refused(Scene, {"extensions": wrong}) == {
        ("greater_than_equal", (*at, "spacing")),
        ("extra_forbidden", (*at, "width")),
        ("float_type", (*at, "place", 1)),
        ("extra_forbidden", ("extensions", "nope")),
    }
    assert refused(Scene, {"extensions": {"rows": {"spacing": "3"}}}) == {("float_type", (*at, "spacing"))}
    assert refused(Quality, {"extensions": {"rows": {"taps": 9}}}) == {("less_than_equal", (*at, "taps"))}
    assert refused(Scene, {"extensions": []}) == {("model_type", ("extensions",))}
    schema = Scene.model_json_schema()
    found = schema["$defs"]["SceneExtensions"]
    assert found["additionalProperties"] is False
    model, null = found["properties"]["rows"]["anyOf"]
    assert null == {"type": "null"}
    described = {"default": 14.0, "description": "Spacing, m", "maximum": 500.0, "minimum": 1.0, "type": "number"}
    assert model["properties"]["spacing"] | {"title": ""} == described | {"title": ""}


def test_a_scene_without_the_part_stays_as_it_was() -> None:
    before = scene_sha256(DEFAULT), make_plan(DEFAULT, STANDARD).sha256
    register(ROWS)
    try:
        assert (scene_sha256(DEFAULT), make_plan(DEFAULT, STANDARD).sha256) == before
        assert scene_sha256(with_rows()) != scene_sha256(Scene())
    finally:
        unregister(ROWS)


@pytest.mark.usefixtures("rows")
def test_the_planner_asks_it_and_knobs_reach_its_settings() -> None:
    scene = with_rows(spacing=5.0)
    assert {note.why for note in make_plan(scene, STANDARD).effects if note.name == "rows"} == {"5 m, 2 taps"}
    pointer = "/extensions/rows/taps"
    assert ("rows", ROWS.parameters[0]) in every_parameter()
    assert value_at(STANDARD, pointer) == 2
    finer = with_value(STANDARD, pointer, 4)
    assert value_at(finer, pointer) == 4
    assert finer.extensions.given(RowQuality) == RowQuality(taps=4)
    assert {note.why for note in make_plan(scene, finer).effects if note.name == "rows"} == {"5 m, 4 taps"}
    assert finer.model_copy(update={"extensions": STANDARD.extensions}) == STANDARD
    assert registry.saturation_limits(scene) == [3.0]
    assert registry.saturation_fields(scene) == ("/extensions/rows/spacing",)


@pytest.mark.usefixtures("rows")
def test_a_name_is_given_once() -> None:
    with pytest.raises(ValueError, match="registered already"):
        register(ROWS)
    other = Effect("other", contribute, extension=Extension("rows", scene=Rows))
    with pytest.raises(ValueError, match="registered already"):
        register(other)
    taken = EFFECTS[5]
    with pytest.raises(ValueError, match="has an effect already"):
        register(Effect("again", contribute, saturation=taken.saturation))
    assert outside() == (ROWS,)


def test_installed_packages_register_by_entry_point_and_unregistering_leaves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def points(group: str) -> list[EntryPoint]:
        return [EntryPoint("rows", f"{__name__}:ROWS", group)] if group == "seafoam.effects" else []

    monkeypatch.setattr(registry, "entry_points", points)
    registry.load()
    try:
        assert outside() == (ROWS,)
    finally:
        unregister(ROWS)
    register(ROWS)
    scene = with_rows()
    hashes = {make_plan(scene, STANDARD).sha256, plan_hash(scene, STANDARD), compile_scene(scene, STANDARD).sha256}
    assert len(hashes) == 1
    unregister(ROWS)
    assert outside() == ()
    assert "rows" not in {note.name for note in make_plan(scene, STANDARD).effects}
    assert hashes.isdisjoint({plan_hash(scene, STANDARD), compile_scene(scene, STANDARD).sha256})
    test_without_extensions_nothing_speaks_of_them()


def parts_of(model: type[BaseModel], at: str = "") -> Iterator[tuple[str, type[Part]]]:
    """Pointers of the parts of a document, without places in lists, and their models."""
    for name, field in model.model_fields.items():
        for one in models_in(field.annotation):
            yield f"{at}/{name}", one
            yield from parts_of(one, f"{at}/{name}")


def models_in(annotation: Any) -> Iterator[type[Part]]:
    if isinstance(annotation, type) and issubclass(annotation, Part):
        yield annotation
    for argument in get_args(annotation):
        yield from models_in(argument)


def test_every_part_of_a_scene_is_an_effects_whose_fields_are_fields() -> None:
    sources = {effect.saturation.model for effect in EFFECTS if effect.saturation is not None}
    assert sources == {one for one in get_args(get_args(Saturation)[0])}
    models = {"": {Scene}}
    for at, model in parts_of(Scene):
        models.setdefault(at, set()).add(model)
    for effect in EFFECTS:
        assert effect.fields or effect.saturation is not None, effect.name
        for pointer in effect.fields:
            owner, _, name = pointer.rpartition("/")
            assert any(name in model.model_fields for model in models[owner]), pointer
    # The wind is no part's own: all parts follow it.
    parts = {at for at, model in parts_of(Scene) if model not in {*sources, Camera, Wind}}
    assert parts <= {field for effect in EFFECTS for field in effect.fields}


SHADED = TIERS["standard"].model_copy(update={"foam_relief": True, "shore_map": 64, "shore_floor": 64, "sea_size": 128})
"""Draws all effects: shades of foam are of the finer tiers. What is measured on maps takes a moment on small ones."""


def without(monkeypatch: pytest.MonkeyPatch, scene: Scene, effect: Effect) -> bytes:
    """The scene's plan by a planner that has never heard of the effect."""
    others = tuple(one for one in EFFECTS if one.name != effect.name)
    with monkeypatch.context() as patched:
        patched.setattr(planner, "EFFECTS", others)
        # Past the cache, which does not know which effects there were.
        return make_plan.__wrapped__(scene, SHADED).canonical_json()


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_switched_off_a_plan_is_that_of_a_scene_that_never_named_it(
    monkeypatch: pytest.MonkeyPatch, effect: Effect
) -> None:
    """Byte for byte: on, off again in JSON as a page would send it, and by a planner without the effect."""
    found = switch(effect, DEFAULT, SHADED)
    assert found is not None, f"no preset and no hard case has fields that switch {effect.name} on there"
    assert found.on == DEFAULT if found.given else (found.off == DEFAULT) == (not found.needs)
    assert found.on.camera == found.off.camera
    assert found.fields
    plan, drawn = make_plan(found.off, SHADED), make_plan(found.on, SHADED)
    assert effect.name in {note.name for note in drawn.effects} - {note.name for note in plan.effects}
    if effect.name in {note.name for note in plan.skipped}:
        # The scene still names what it shows, and a bound leaves it out.
        assert _but_for_notes(plan.canonical_json()) == _but_for_notes(without(monkeypatch, found.off, effect))
        return
    on, off = (one.model_dump(mode="json") for one in (found.on, found.off))
    for pointer in found.fields:
        _put(on, pointer, _got(off, pointer))
    again = Scene.model_validate(json.loads(json.dumps(on)))
    assert make_plan(again, SHADED) == plan
    assert Scene.model_validate(_named(off)) == found.off
    assert without(monkeypatch, found.off, effect) == plan.canonical_json()


def test_what_a_bound_leaves_out_leaves_a_note_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scenes that name an effect and cannot show it: but for the note, the plan of a planner without it."""
    compared = 0
    for effect in EFFECTS:
        for scene in cases_of(effect).invisible:
            lean = make_plan(scene, SHADED)
            if {note.name for note in lean.skipped} == {effect.name}:
                other = without(monkeypatch, scene, effect)
                assert _but_for_notes(lean.canonical_json()) == _but_for_notes(other), effect.name
                compared += 1
                break
    assert compared > 5


def _but_for_notes(plan: bytes) -> Any:
    """A plan without its notes of what is left out, and without the fields that those take out of the live ones."""
    return {**json.loads(plan), "skipped": [], "live": []}


def _got(document: Any, pointer: str) -> Any:
    return reduce(getitem, pointer.split("/")[1:], document)


def _put(document: Any, pointer: str, value: Any) -> None:
    above, _, last = pointer.rpartition("/")
    _got(document, above)[last] = value


def _named(document: dict[str, Any]) -> dict[str, Any]:
    """The scene without what is absent, anywhere in it; no light has to be named, since there is one otherwise."""

    def bare(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: bare(held) for name, held in value.items() if held is not None or name == "light"}
        return [bare(item) for item in value] if isinstance(value, list) else value

    named: dict[str, Any] = bare(document)
    return {name: held for name, held in named.items() if held != []}
