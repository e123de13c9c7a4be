"""Every refusal is problem+json, names the parameter or the member, and says what is allowed; of extensions too."""

import importlib
import json
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.settings import Settings
from seafoam.effects import register
from seafoam.scene import load_preset
from support.api_fakes import RAISE, FakeRenderer
from support.cases import unregister
from support.serving import SMALL, problem

FRAME, CUSTOM = "/api/frames/default.png", "/api/masks/custom"
WHERE = "x=0&y=4&z=0&yaw=0&pitch=0&roll=0"
VIEW = f"width=8&height=8&{WHERE}&fov=1"
PLANNED, STREAMED = f"/api/plans/{'0' * 64}/frames", "/api/streams/none/frame.jpg"


def between(least, most):
    return {"minimum": least, "maximum": most}


def one_of(*values):
    return {"enum": list(values)}


SIDE, TIME, FOV, PLACE = between(1, 4096), between(-1e9, 1e9), between(0.01, 2.6), between(-1e7, 1e7)
WHOLE = between(1, 16384)
QUALITIES = one_of("fast", "standard", "high", "reference", "auto")
FORMATS = one_of("png", "webp", "exr", "npy")
PARAMETERS = [
    (f"{FRAME}?width=0", "width", WHOLE), (f"{FRAME}?width=4097", "width", SIDE),
    (f"{FRAME}?time=1000000001", "time", TIME), (f"{FRAME}?time=nan", "time", TIME),
    (f"{FRAME}?quality=best", "quality", QUALITIES), (f"{FRAME}?y=-2000", "y", between(-1000.0, 1e5)),
    ("/api/frames/lake-calm.png?look=halftone", "look", "no foam"),
    (f"{FRAME}?dither=maybe", "dither", {"type": "boolean"}),
    (f"{FRAME}?precision=double", "precision", one_of("half", "float")), (f"{FRAME}?mask=zzz", "mask", None),
    (f"{FRAME}?mask=clump:2:1024:1", "mask", "32, 64, 128, 256, 512 texels"),
    ("/api/frames/default.gif", "format", FORMATS),
    ("/api/presets/default/thumbnail.png?width=2000", "width", between(16, 640)),
    (f"{CUSTOM}?family=vac&size=64&sigma=9", "sigma", "0.5..8"),
    (f"{CUSTOM}?family=veil", "family", one_of("vac", "blur", "clump", "bubble", "mix", "lace")),
    (f"{CUSTOM}?family=vac&aspect=2", "aspect", "only for lace"),
    (f"{CUSTOM}?family=vac&seed=-1", "seed", between(0, 2**32 - 1)),
    (f"/api/plans/{'0' * 63}/frames/1.png?{VIEW}", "plan", None), (f"{PLANNED}/2e9.png?{VIEW}", "time", TIME),
    (f"{PLANNED}/1.png?width=8&height=8&{WHERE}", "fov", FOV),
    (f"{STREAMED}?time=1&width=8&height=8&{WHERE.replace('x=0', 'x=1e8')}&fov=1", "x", PLACE),
    (f"{STREAMED}?time=1&{VIEW}&format=png", "format", "pitch"),
    ("/healthz?widht=3", "widht", None), (f"{FRAME}?widht=3", "widht", "width"),
]  # fmt: skip
FRAMES, SEQUENCES, EXPORT = "/api/frames", "/api/sequences", "/api/export"
BASES = {
    "/api/plans": {"scene": {}},
    "/api/streams": {"scene": {}, "quality": "fast"},
    FRAMES: {"scene": {}, "width": 8, "height": 8},
    SEQUENCES: {"scene": {}, "quality": "fast", "stop": 0.25, "format": "zip", **SMALL},
    EXPORT: {"scene": load_preset("paper-halftone").scene.model_dump(mode="json"), "quality": "fast"},
}
"""A body that is taken, by path."""
MEMBERS = [
    (FRAMES, {"width": 5000}, "/width", SIDE), (FRAMES, {"width": "64"}, "/width", WHOLE),
    (FRAMES, {"width": True}, "/width", WHOLE), (FRAMES, {"time": 2e9}, "/time", TIME),
    (FRAMES, {"preset": "atlantis"}, "/preset", "default"), (FRAMES, {"quality": "best"}, "/quality", QUALITIES),
    (FRAMES, {"quality": {"samples": 5}}, "/quality/samples", one_of(1, 4, 9, 16, 25, 36, 49, 64)),
    (FRAMES, {"quality": {"samples_max": True}}, "/quality/samples_max", one_of(1, 4, 16)),
    (FRAMES, {"scene": {"waves": [{"amplitude": 99}]}}, "/scene/waves/0/amplitude", between(0.0, 50.0)),
    (
        FRAMES, {"scene": {"foam": {"saturation": [{"source": "front"}, {"source": "height", "base": 999}]}}},
        "/scene/foam/saturation/1/base", between(-100.0, 100.0),
    ),
    (FRAMES, {"scene": {"touches": [{"place": [0.0, 2e7]}]}}, "/scene/touches/0/place/1", PLACE),
    ("/api/plans", {"scene": {"waters": {}}}, "/scene/waters", "water"),
    ("/api/plans", {"scene": {"waves": [{"model": "gerstner"}]}}, "/scene/waves/0/model", "parametric"),
    ("/api/plans", {"scene": {"foam": {"saturation": []}}}, "/scene/foam/saturation", None),
    ("/api/plans", {"scene": {"foam": {"look": "dotted"}}}, "/scene/foam/look", "filtered"),
    ("/api/plans", {"scene": {"camera": {"position": [1, 2]}}}, "/scene/camera/position/2", None),
    ("/api/plans", {"scene": {"extensions": {"windrows": {}}}}, "/scene/extensions/windrows", None),
    (SEQUENCES, {"stop": 0.0}, "/stop", "above the start"),
    (SEQUENCES, {"stop": 1000.0}, "/stop", "24,000 frames exceed the limit of 3,600"),
    (SEQUENCES, {"fps": 0.0}, "/fps", "0.001"), (SEQUENCES, {"fps": "30000 / 1001"}, "/fps", "0.001"),
    (SEQUENCES, {"fps": "1/0"}, "/fps", "30000/1001"),
    (SEQUENCES, {"width": 25, "format": "mp4"}, "/width", "even"),
    (SEQUENCES, {"height": 62, "width": 64, "format": "mp4", "codec": "av1"}, "/height", "at least 64"),
    (SEQUENCES, {"scene": {"foam": {"mask": "zzz"}}}, "/scene/foam/mask", "zzz"),
    (EXPORT, {"preset": "atlantis"}, "/preset", "default"), (EXPORT, {"unknown": 1}, "/unknown", "scene"),
]  # fmt: skip


def check(error, allowed):
    """What is allowed is exactly this, or said in these words."""
    assert error["allowed"] == allowed if isinstance(allowed, dict) else (allowed or "") in json.dumps(error)


@pytest.mark.parametrize(("url", "parameter", "allowed"), PARAMETERS)
def test_a_bad_parameter_is_named_with_what_it_may_be(client, url, parameter, allowed):
    (error,) = problem(client.get(url), 422)["errors"]
    assert error["parameter"] == parameter
    check(error, allowed)


@pytest.mark.parametrize(("path", "changes", "pointer", "allowed"), MEMBERS)
def test_a_bad_member_is_named_with_what_it_may_be(client, path, changes, pointer, allowed):
    (error,) = problem(client.post(path, json=BASES[path] | changes), 422)["errors"]
    assert error["pointer"] == pointer
    check(error, allowed)


def test_all_that_is_bad_or_missing_is_named_at_once(client):
    errors = problem(client.get(f"{FRAME}?width=0&time=nan&fov=9&zz=1"), 422)["errors"]
    assert {error["parameter"] for error in errors} == {"width", "time", "fov", "zz"}
    (error,) = problem(client.post("/api/plans", json={}), 422)["errors"]
    assert error["pointer"] == "/scene"


def test_a_body_that_is_no_object_of_finite_numbers_of_another_kind_or_too_large_is_refused(client):
    def refused(status, content, kind="application/json", path="/api/plans"):
        return problem(client.post(path, content=content, headers={"Content-Type": kind}), status)

    for number in ("NaN", "Infinity", "-Infinity", "1e999", "9" * 400):
        told = refused(422, f'{{"scene": {{}}, "time": {number}}}', path="/api/frames")
        assert "/time" in json.dumps(told["errors"]), number
    for body in ("", "{", "[]", "7", "null", '"scene"', '{"scene": ' + "9" * 5000 + "}"):
        refused(422, body)
    refused(415, "{}", "text/plain")
    refused(413, b" " * 300_000)
    refused(413, (b" " * 50_000 for _ in range(8)))


@pytest.mark.parametrize(
    ("url", "parameter"),
    [
        *((url, None) for url in ("/api/nope", "/assets/none.js")),
        *((f"/api/textures/{name}", None) for name in ("nope", "mask/nope/ranks", "mask/vac-6/nope", "../x")),
        *((f"/api/textures/{name}", None) for name in ("front-integral/x/y", "mask/clump:2:96:1/atlas")),
        *((url, "preset") for url in ("/api/presets/nope", "/api/plans/nope", "/api/frames/nope.png")),
        *((f"/api/masks/{name}", "mask") for name in ("nope/data.png", "vac:3:64:1")),
    ],
)
def test_a_wrong_name_is_not_found_and_comes_with_the_right_ones(client, url, parameter):
    told = problem(client.get(url), 404)
    if parameter is None:
        assert ".." in url or told["instance"] == url
        return
    (error,) = told["errors"]
    assert error["parameter"] == parameter
    assert len(error["allowed"]["enum"]) > 1


def test_a_wrong_method(client):
    for method, url in (("DELETE", "/api/presets"), ("GET", "/api/frames"), ("PUT", "/healthz")):
        response = client.request(method, url)
        problem(response, 405)
        assert response.headers["Allow"]


def test_the_pixel_budget_counts_samples(client):
    def allowed(response):
        return problem(response, 422)["errors"][0]["allowed"]

    def posted(height, **quality):
        return client.post(FRAMES, json={"scene": {}, "width": 4096, "height": height, "quality": quality})

    problem(client.get(f"{FRAME}?width=2048&height=1024&quality=reference"), 422)
    assert allowed(client.get(f"{FRAME}?width=4096&height=2051")) == between(1, 2050)
    assert problem(posted(8, samples=64), 422)["errors"][0]["pointer"] == "/width"
    assert allowed(posted(8, samples=64)) == between(1, 1024)
    assert allowed(posted(1024, samples_max=16)) == between(1, 410)


def test_an_inner_error_tells_nothing_of_the_inside(client, monkeypatch):
    def fail() -> None:
        raise RuntimeError("secret")

    monkeypatch.setattr("seafoam.api.routers.masks.load_catalogue", fail)
    for url in (f"{FRAME}?time={RAISE}&width=8&height=8", "/api/masks"):
        assert "secret" not in json.dumps(problem(client.get(url), 500))


EXAMPLE = Path(__file__).parents[4] / "docs" / "example"


@pytest.fixture
def windrows(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLE))
    effect = importlib.import_module("windrows").EFFECT
    register(effect)
    yield effect
    unregister(effect)


def test_a_registered_extension_is_described_and_checked(client, windrows):
    scene = {"foam": {}, "extensions": {"windrows": {"spacing": 20.0}}}
    app = create_app(Settings(), renderer=FakeRenderer)
    app.state.context = client.app.state.context
    client = TestClient(app)
    schemas = client.get("/openapi.json").json()["components"]["schemas"]
    assert schemas["Scene"]["properties"]["extensions"]["$ref"].endswith("/SceneExtensions")
    model, _ = schemas["SceneExtensions"]["properties"]["windrows"]["anyOf"]
    assert model["properties"]["spacing"]["maximum"] == 500.0
    assert "filter" in str(schemas["QualityExtensions"])
    response = client.post(
        "/api/plans", json={"scene": scene, "quality": {"extensions": {"windrows": {"filter": False}}}}
    )
    assert response.status_code == 200
    made = response.json()
    assert "windrows" in {note["name"] for note in made["effects"]}
    assert "/extensions/windrows/strength" in made["live"]
    for wrong, pointer, allowed in (
        ({"windrows": {"spacing": 1e9}}, "windrows/spacing", {"minimum": 2.0, "maximum": 500.0}),
        ({"windrow": {}}, "windrow", {"members": ["windrows"]}),
    ):
        refused = client.post("/api/plans", json={"scene": {"foam": {}, "extensions": wrong}})
        (error,) = problem(refused, 422)["errors"]
        assert (error["pointer"], error["allowed"]) == (f"/scene/extensions/{pointer}", allowed)
