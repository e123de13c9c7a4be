"""Fields that effects outside the package add: named where they are unknown, described where they are registered."""

import importlib
from pathlib import Path

import pytest

from seafoam.effects import register, unregister
from support.serving import problem, serving

EXAMPLE = Path(__file__).parents[4] / "docs" / "example"


@pytest.fixture
def windrows(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLE))
    effect = importlib.import_module("windrows").EFFECT
    register(effect)
    yield effect
    unregister(effect)


def plan(client, scene, quality=None):
    body = {"scene": scene} if quality is None else {"scene": scene, "quality": quality}
    return client.post("/api/plans", json=body)


def test_a_registered_extension_is_described_and_checked(windrows):
    scene = {"foam": {}, "extensions": {"windrows": {"spacing": 20.0}}}
    with serving() as client:
        schemas = client.get("/openapi.json").json()["components"]["schemas"]
        assert schemas["Scene"]["properties"]["extensions"]["$ref"].endswith("/SceneExtensions")
        model, _ = schemas["SceneExtensions"]["properties"]["windrows"]["anyOf"]
        assert model["properties"]["spacing"]["maximum"] == 500.0
        assert "filter" in str(schemas["QualityExtensions"])
        response = plan(client, scene, {"extensions": {"windrows": {"filter": False}}})
        assert response.status_code == 200
        made = response.json()
        assert "windrows" in {note["name"] for note in made["effects"]}
        assert "/extensions/windrows/strength" in made["live"]
        for wrong, pointer, allowed in (
            ({"windrows": {"spacing": 1e9}}, "windrows/spacing", {"minimum": 2.0, "maximum": 500.0}),
            ({"windrow": {}}, "windrow", {"members": ["windrows"]}),
        ):
            (error,) = problem(plan(client, {"foam": {}, "extensions": wrong}), 422)["errors"]
            assert (error["pointer"], error["allowed"]) == (f"/scene/extensions/{pointer}", allowed)
