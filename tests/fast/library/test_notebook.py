"""The notebook's widget without a notebook: what its page asks of Python, and its traits from both sides."""

import json
from typing import Any

import numpy as np
import pytest
import traitlets

import seafoam
from seafoam.library.request import InvalidRequestError, schemas
from seafoam.masks.catalogue import load_catalogue
from seafoam.notebook import Water
from seafoam.notebook.widget import answer
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene import load_preset
from seafoam.textures.store import spec_of, texture


@pytest.fixture
def water() -> Water:
    return Water("paper-halftone", quality="fast")


def test_it_begins_with_the_preset(water: Water) -> None:
    preset = load_preset("paper-halftone")
    assert (water.scene, water.camera, water.time) == (preset.scene, preset.scene.camera, preset.time)
    assert (water.quality, water.playing, water.panel, water.error) == ("fast", True, False, "")
    state = water.get_state()
    assert state["scene"] == preset.scene.model_dump(mode="json")
    assert state["camera"] == preset.scene.camera.model_dump(mode="json")
    assert "render" in state["_esm"]
    with pytest.raises(InvalidRequestError, match="atlantis"):
        Water("atlantis")


def test_python_changes_the_scene(water: Water) -> None:
    seen = []
    water.observe(lambda change: seen.append(change["new"]), "camera")
    water.scene = "default"
    assert (water.scene, [water.camera]) == (load_preset("default").scene, seen)
    assert water.camera == water.scene.camera
    water.scene = {"sea": {"wind": 12.0}}
    assert water.scene == seafoam.Scene.model_validate({"sea": {"wind": 12.0}})
    water.camera = {"yaw": 1.0}
    assert water.camera == water.scene.camera.model_copy(update={"yaw": 1.0})
    # A scene with the same camera leaves the view where it is.
    water.scene = water.scene.model_copy(update={"foam": None})
    assert water.camera.yaw == 1.0
    water.quality = {"waves": 4}
    assert water.quality == {"waves": 4}
    for name, value in (("scene", {"sea": {"wind": 99}}), ("camera", {"yaw": 99}), ("quality", "best"), ("time", 2e9)):
        with pytest.raises(traitlets.TraitError):
            setattr(water, name, value)


def test_the_page_changes_the_scene_and_what_it_may_not_change_is_undone_there(
    water: Water, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []
    water.observe(lambda change: seen.append(change["new"].foam.look), "scene")
    edited = water.scene.model_dump(mode="json")
    edited["foam"]["look"] = "fading"
    water.set_state({"scene": edited})
    assert seen == ["fading"]
    water.set_state({"camera": {**edited["camera"], "yaw": 0.5}, "time": 7.5, "playing": False})
    assert (water.camera.yaw, water.time, water.playing) == (0.5, 7.5, False)
    before = water.scene
    restored: list[Any] = []
    monkeypatch.setattr(water, "send_state", lambda key=None: restored.append(key))
    water.set_state({"scene": {**before.model_dump(mode="json"), "sea": {"wind": 99.0}}})
    assert (water.scene, ["scene"] in restored) == (before, True)
    assert "scene/sea/wind" in water.error
    water.set_state({"scene": before.model_dump(mode="json")})
    assert water.error == ""


def test_plans_and_textures_are_the_servers(water: Water, monkeypatch: pytest.MonkeyPatch) -> None:
    messages: list[tuple[Any, list[bytes]]] = []
    monkeypatch.setattr(water, "send", lambda content, buffers=None: messages.append((content, buffers or [])))
    asked = {"kind": "plan", "scene": water.get_state()["scene"], "quality": "fast"}
    water._answer(water, {"id": "a/1", **asked}, [])
    plan = make_plan(water.scene, TIERS["fast"])
    ((content, _),) = messages
    assert content["id"] == "a/1"
    assert json.dumps(content["value"], sort_keys=True) == json.dumps(plan.model_dump(mode="json"), sort_keys=True)
    for one in plan.textures.values():
        water._answer(water, {"id": "a/2", "kind": "texture", "url": one.url}, [])
        assert messages[-1][1] == [texture(spec_of(one.url)).data]
    water._answer(water, "not a request", [])
    for scene, said in (({"foam": {"mask": "zzz"}}, "scene/foam/mask"), ({"sea": {"wind": 99}}, "scene/sea/wind")):
        water._answer(water, {"id": "a/3", "kind": "plan", "scene": scene, "quality": "fast"}, [])
        assert said in messages[-1][0]["error"]


def test_schema_and_lists_of_names_are_the_servers() -> None:
    assert answer({"kind": "schema"}) == (schemas(), [])
    names, parts = answer({"kind": "choices", "url": "/api/masks"})
    assert {"name": "vac-24", "title": load_catalogue()["vac-24"].title} in names
    assert parts == []


def test_a_still_is_what_the_picture_shows(water: Water, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: dict[str, Any] = {}

    def frame(what: Any, **options: Any) -> Any:
        asked.update(options, scene=what)
        return np.zeros(())

    monkeypatch.setattr("seafoam.notebook.widget.frame", frame)
    water.time = 4.0
    water.still((64, 36))
    shown = {"scene": water.scene, "time": 4.0, "camera": water.camera, "quality": "fast"}
    assert asked == {**shown, "size": (64, 36)}
