"""Every error is problem+json, names the field, and says what is allowed."""

import json

import pytest

from seafoam.api.http.schema_limits import allowed_at, describe_allowed
from support.api_fakes import RAISE
from support.serving import problem

FRAME = "/api/frames/default.png"


@pytest.mark.parametrize(
    ("url", "parameter", "allowed"),
    [
        (f"{FRAME}?width=0", "width", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?width=4097", "width", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?height=-3", "height", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?width=1.5", "width", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?width=", "width", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?width=1e3", "width", {"minimum": 1, "maximum": 4096}),
        (f"{FRAME}?time=1000000001", "time", {"minimum": -1e9, "maximum": 1e9}),
        (f"{FRAME}?time=nan", "time", {"minimum": -1e9, "maximum": 1e9}),
        (f"{FRAME}?time=-inf", "time", {"minimum": -1e9, "maximum": 1e9}),
        (f"{FRAME}?time=soon", "time", {"minimum": -1e9, "maximum": 1e9}),
        (f"{FRAME}?quality=best", "quality", {"enum": ["draft", "standard", "high", "reference", "auto"]}),
        (f"{FRAME}?x=1e8", "x", {"minimum": -1e7, "maximum": 1e7}),
        (f"{FRAME}?y=-2000", "y", {"minimum": -1000.0, "maximum": 1e5}),
        (f"{FRAME}?fov=3", "fov", {"minimum": 0.01, "maximum": 2.6}),
        ("/api/frames/default.gif", "format", {"enum": ["png", "webp", "exr", "npy"]}),
        ("/api/masks/custom?family=vac&size=31", "size", {"minimum": 32, "maximum": 1024}),
        ("/api/masks/custom?family=vac&size=64&sigma=9", "sigma", {"minimum": 0.5, "maximum": 8.0}),
        ("/api/masks/custom?family=bubble&size=64&sigma=1", "sigma", {"minimum": 2.0, "maximum": 8.0}),
        ("/api/masks/custom?family=veil", "family", {"enum": ["vac", "blur", "clump", "bubble", "mix", "lace"]}),
        ("/api/masks/custom?family=lace&sigma=3", "sigma", {"minimum": 4.0, "maximum": 24.0}),
        ("/api/masks/custom?family=lace&age=1.5", "age", {"minimum": 0.0, "maximum": 1.0}),
        ("/api/masks/custom?family=vac&aspect=2", "aspect", {"enum": [1.0]}),
        ("/api/masks/custom?family=vac&seed=-1", "seed", {"minimum": 0, "maximum": 2**32 - 1}),
    ],
)
def test_a_bad_parameter_is_named_with_its_range(client, url, parameter, allowed):
    (error,) = problem(client.get(url), 422)["errors"]
    assert error["parameter"] == parameter
    assert error["allowed"] == allowed


@pytest.mark.parametrize(
    "url", ["/api/presets", FRAME, "/healthz", "/metrics", "/api/masks/vac-6", "/api/plans/default"]
)
def test_an_unknown_parameter_is_refused(client, url):
    (error,) = problem(client.get(f"{url}?widht=3"), 422)["errors"]
    assert error["parameter"] == "widht"


def test_unknown_parameters_come_with_the_known_ones(client):
    (error,) = problem(client.get(f"{FRAME}?widht=3"), 422)["errors"]
    assert "width" in error["allowed"]["members"]


def test_a_parameter_given_twice_is_refused(client):
    (error,) = problem(client.get(f"{FRAME}?width=8&width=9"), 422)["errors"]
    assert error["parameter"] == "width"


def test_all_bad_parameters_are_named_at_once(client):
    errors = problem(client.get(f"{FRAME}?width=0&time=nan&fov=9&zz=1"), 422)["errors"]
    assert {error["parameter"] for error in errors} == {"width", "time", "fov", "zz"}


@pytest.mark.parametrize(
    ("body", "pointer", "allowed"),
    [
        ({"width": 0}, "/width", {"minimum": 1, "maximum": 4096}),
        ({"width": 5000}, "/width", {"minimum": 1, "maximum": 4096}),
        ({"width": "64"}, "/width", {"minimum": 1, "maximum": 4096}),
        ({"width": True}, "/width", {"minimum": 1, "maximum": 4096}),
        ({"time": 2e9}, "/time", {"minimum": -1e9, "maximum": 1e9}),
        ({"time": None}, "/time", {"minimum": -1e9, "maximum": 1e9}),
        ({"format": "gif"}, "/format", {"enum": ["png", "webp", "exr", "npy"]}),
        ({"quality": "best"}, "/quality", {"enum": ["draft", "standard", "high", "reference", "auto"]}),
        ({"quality": {"samples": 5}}, "/quality/samples", {"enum": [1, 4, 9, 16, 25, 36, 49, 64]}),
        ({"quality": {"samples_max": 9}}, "/quality/samples_max", {"enum": [1, 4, 16]}),
        ({"quality": {"samples_max": True}}, "/quality/samples_max", {"enum": [1, 4, 16]}),
        ({"quality": {"samples_budget": 4.0}}, "/quality/samples_budget", {"minimum": 0.1, "maximum": 3.0}),
        ({"quality": {"samples_threshold": 0}}, "/quality/samples_threshold", {"minimum": 0.001, "maximum": 1.0}),
        ({"quality": {"surface": {"cells": 7}}}, "/quality/surface/cells", {"minimum": 8, "maximum": 1024}),
        ({"scene": {"waves": [{"amplitude": 99}]}}, "/scene/waves/0/amplitude", {"minimum": 0.0, "maximum": 50.0}),
        ({"scene": {"light": {"turbidity": 0}}}, "/scene/light/turbidity", {"minimum": 1.0, "maximum": 10.0}),
        (
            {"scene": {"foam": {"saturation": [{"source": "front"}, {"source": "height", "base": 999}]}}},
            "/scene/foam/saturation/1/base",
            {"minimum": -100.0, "maximum": 100.0},
        ),
        ({"camera": {"position": [0, 1, 2e7]}}, "/camera/position/2", {"minimum": -1e7, "maximum": 1e7}),
    ],
)
def test_a_bad_member_is_named_with_its_range(client, body, pointer, allowed):
    response = client.post("/api/frames", json={"scene": {}, "width": 8, "height": 8, **body})
    (error,) = problem(response, 422)["errors"]
    assert error["pointer"] == pointer
    assert error["allowed"] == allowed


def test_an_unknown_member_comes_with_the_known_ones(client):
    (error,) = problem(client.post("/api/plans", json={"scene": {"waters": {}}}), 422)["errors"]
    assert error["pointer"] == "/scene/waters"
    assert "water" in error["allowed"]["members"]


@pytest.mark.parametrize(
    ("body", "pointer"), [({}, "/scene"), ({"scene": {"camera": {"position": [1, 2]}}}, "/scene/camera/position/2")]
)
def test_a_missing_member_is_named(client, body, pointer):
    (error,) = problem(client.post("/api/plans", json=body), 422)["errors"]
    assert error["pointer"] == pointer


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "9" * 400])
def test_numbers_that_are_not_finite_are_refused(client, number):
    body = f'{{"scene": {{}}, "time": {number}}}'
    response = client.post("/api/frames", content=body, headers={"Content-Type": "application/json"})
    assert "/time" in json.dumps(problem(response, 422)["errors"])


@pytest.mark.parametrize("body", ["", "{", "[]", "7", "null", '"scene"'])
def test_a_body_that_is_no_object_is_refused(client, body):
    response = client.post("/api/plans", content=body, headers={"Content-Type": "application/json"})
    problem(response, 422)


@pytest.mark.parametrize("body", ["[" * 100_000, '{"scene": ' + "9" * 5000 + "}", b"\xff\xfe"])
def test_a_body_that_breaks_the_parser_is_refused(client, body):
    response = client.post("/api/plans", content=body, headers={"Content-Type": "application/json"})
    problem(response, 400 if response.status_code == 400 else 422)


def test_a_body_that_is_not_json_is_refused(client):
    problem(client.post("/api/plans", content="{}", headers={"Content-Type": "text/plain"}), 415)


@pytest.mark.parametrize("method", ["GET", "POST"])
def test_a_large_body_is_refused_by_its_announced_length(client, method):
    problem(client.request(method, "/api/plans", content=b" " * 300_000), 413)


def test_a_large_body_is_refused_as_it_arrives(client):
    parts = (b" " * 50_000 for _ in range(8))
    problem(client.post("/api/plans", content=parts, headers={"Content-Type": "application/json"}), 413)


@pytest.mark.parametrize("url", ["/api/nope", "/nope", "/assets/none.js"])
def test_nothing_there(client, url):
    assert problem(client.get(url), 404)["instance"] == url


@pytest.mark.parametrize(
    ("url", "parameter"),
    [
        ("/api/presets/nope", "preset"),
        ("/api/plans/nope", "preset"),
        ("/api/frames/nope.png", "preset"),
        ("/api/accuracy/nope", "preset"),
        ("/api/masks/nope", "mask"),
        ("/api/masks/nope/data.png", "mask"),
        ("/api/masks/vac:3:64:1", "mask"),
    ],
)
def test_a_wrong_name_comes_with_the_right_ones(client, url, parameter):
    (error,) = problem(client.get(url), 404)["errors"]
    assert error["parameter"] == parameter
    assert len(error["allowed"]["enum"]) > 1


@pytest.mark.parametrize(
    "name", ["nope", "mask/nope/ranks", "mask/vac-6/nope", "mask/vac:1/ranks", "front-integral/x/y", "../x", "%00"]
)
def test_a_wrong_texture(client, name):
    problem(client.get(f"/api/textures/{name}"), 404)


@pytest.mark.parametrize(("method", "url"), [("DELETE", "/api/presets"), ("GET", "/api/frames"), ("PUT", "/healthz")])
def test_a_wrong_method(client, method, url):
    response = client.request(method, url)
    problem(response, 405)
    assert response.headers["Allow"]


def test_a_mask_that_cannot_be_planned_is_named_where_it_was_given(client):
    (error,) = problem(client.get("/api/plans/default?mask=zzz"), 422)["errors"]
    assert error["parameter"] == "mask"
    (error,) = problem(client.post("/api/plans", json={"scene": {"foam": {"mask": "zzz"}}}), 422)["errors"]
    assert error["pointer"] == "/scene/foam/mask"
    (error,) = problem(client.get("/api/frames/default.png?mask=vac:99:64:1"), 422)["errors"]
    assert error["parameter"] == "mask"


def test_a_slow_mask_is_refused_with_the_range_that_is_quick(client):
    (error,) = problem(client.get("/api/masks/custom/data.png?family=vac&sigma=24&size=512"), 422)["errors"]
    assert error["parameter"] == "sigma"
    assert error["allowed"]["minimum"] == 0.5
    assert 2.0 < error["allowed"]["maximum"] < 24.0


def test_the_pixel_budget_counts_samples(client):
    fits = {"width": 2048, "height": 1024}
    problem(client.get("/api/frames/default.png", params=fits | {"quality": "reference"}), 422)
    errors = problem(client.get("/api/frames/default.png", params={"width": 4096, "height": 2051}), 422)["errors"]
    assert errors[0]["allowed"] == {"minimum": 1, "maximum": 2050}
    body = {"scene": {}, "width": 4096, "height": 8, "quality": {"samples": 64}}
    errors = problem(client.post("/api/frames", json=body), 422)["errors"]
    assert errors[0]["pointer"] == "/width"
    assert errors[0]["allowed"] == {"minimum": 1, "maximum": 1024}
    body = {"scene": {}, "width": 4096, "height": 1024, "quality": {"samples_max": 16}}
    errors = problem(client.post("/api/frames", json=body), 422)["errors"]
    assert errors[0]["allowed"] == {"minimum": 1, "maximum": 410}


def test_an_inner_error_tells_nothing_of_the_inside(client):
    body = problem(client.get("/api/frames/default.png", params={"time": RAISE, "width": 8, "height": 8}), 500)
    assert "secret" not in json.dumps(body)


def test_an_unforeseen_error_is_a_problem_too(client, monkeypatch):
    def fail() -> None:
        raise RuntimeError("secret")

    monkeypatch.setattr("seafoam.api.routers.masks.load_catalogue", fail)
    body = problem(client.get("/api/masks"), 500)
    assert "secret" not in json.dumps(body)


def test_what_is_allowed_in_words():
    schema = {
        "properties": {
            "a": {"anyOf": [{"type": "number", "minimum": 0, "maximum": 2.5}, {"type": "null"}]},
            "b": {"type": "integer", "minimum": 3},
            "c": {"enum": ["x", "y"]},
            "d": {"$ref": "#/$defs/D"},
            "e": {"type": "number", "exclusiveMinimum": 0},
        },
        "$defs": {"D": {"properties": {"f": {"type": "boolean"}}}},
    }
    words = {
        name: describe_allowed(allowed_at(schema, schema, path) or {})
        for name, path in {"a": ("a",), "b": ("b",), "c": ("c",), "d": ("d",), "e": ("e",), "f": ("d", "f")}.items()
    }
    assert words == {
        "a": "0 to 2.5",
        "b": "at least 3",
        "c": "one of x, y",
        "d": "members: f",
        "e": "above 0",
        "f": "boolean",
    }
    assert allowed_at(schema, schema, ("zz",)) is None
