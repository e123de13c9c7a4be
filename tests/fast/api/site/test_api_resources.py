"""What is not a frame: presets, plans, textures, quality, pages, previews of links, health, metrics."""

import hashlib
import html
import json
import re
from itertools import pairwise
from typing import Any, get_args

from prometheus_client.parser import text_string_to_metric_families
from starlette.testclient import TestClient

from seafoam.api.site import PREVIEW
from seafoam.framegraph.plan import FramePlan
from seafoam.quality import TIERS
from seafoam.scene import Group, Scene, load_preset, preset_names
from support.serving import answering, picture, problem


def test_presets_are_listed_in_the_order_of_the_menu(client):
    listed = client.get("/api/presets").json()
    assert [preset["name"] for preset in listed] == list(preset_names())
    for preset in listed:
        assert set(preset) == {"name", "group", "title", "summary", "size", "time", "effects"}
        assert preset["effects"]
    groups = [preset["group"] for preset in listed]
    assert list(dict.fromkeys(groups)) == list(get_args(Group)), "each group stands together, in the menu's order"
    assert len([1 for a, b in pairwise(groups) if a != b]) == len(get_args(Group)) - 1


def test_a_preset_comes_with_a_scene_that_is_accepted_back_and_a_plan_is_what_its_headers_say(client):
    preset = client.get("/api/presets/default").json()
    assert Scene.model_validate(preset["scene"]).waves
    sent = client.post("/api/plans", json={"scene": preset["scene"]})
    assert sent.content == client.get("/api/plans/default").content
    plain = {"Accept-Encoding": "identity"}
    response = client.get("/api/plans/default", params={"quality": "fast"}, headers=plain)
    digest = hashlib.sha256(response.content).hexdigest()
    assert response.headers["Seafoam-Plan"] == digest
    assert response.headers["ETag"] == f'"{digest}"'
    assert FramePlan.model_validate_json(response.content).sha256 == digest


def test_overrides_and_single_knobs_change_the_plan(client):
    plans = {
        client.get("/api/plans/default", params=params).headers["Seafoam-Plan"]
        for params in ({}, {"quality": "high"}, {"look": "halftone"}, {"mask": "vac-6"}, {"mask": "vac:3:64:1"})
    }
    assert len(plans) == 5
    qualities = ("standard", TIERS["standard"].model_dump(mode="json"), {"samples": 4})
    tier, same, other = (client.post("/api/plans", json={"scene": {}, "quality": each}) for each in qualities)
    assert tier.content == same.content
    assert other.json()["samples"] == 4


def test_every_texture_of_a_plan_is_there(client):
    """Those of every preset: test_every_plan.py, without a server."""
    for described in client.get("/api/plans/default").json()["textures"].values():
        response = client.get(described["url"], headers={"Accept-Encoding": "identity"})
        assert hashlib.sha256(response.content).hexdigest() == described["sha256"]
        assert response.headers["Cache-Control"] == "public, no-cache"
        assert response.headers["ETag"] == f'"{described["sha256"]}"'


def test_a_texture_is_kept_for_ever_by_its_hash_and_what_is_in_parts_is_as_well(client):
    digest = client.get("/api/textures/foam").headers["ETag"].strip('W/"')
    kept = client.get("/api/textures/foam", params={"sha256": digest})
    assert kept.headers["Cache-Control"] == "public, max-age=31536000, immutable"
    other = client.get("/api/textures/foam", params={"sha256": "0" * 64})
    assert problem(other, 422)["errors"][0]["allowed"] == {"enum": [digest]}
    url = "/api/textures/mask/lace/ranks"
    whole = client.get(url)
    digest = whole.headers["ETag"].strip('"')
    packed = client.get(url, params={"sha256": digest, "part": "upper"}, headers={"Accept-Encoding": "gzip"})
    plain = client.get(url, params={"part": "upper"}, headers={"Accept-Encoding": "identity"})
    lower = client.get(url, params={"part": "lower"})
    assert packed.headers["Content-Encoding"] == "gzip"
    assert int(packed.headers["Content-Length"]) < 0.3 * len(whole.content)
    assert packed.content == plain.content
    assert len(plain.content) == len(whole.content) / 2
    assert len(lower.content) == len(whole.content) * 10 / 16
    assert packed.headers["Cache-Control"] == "public, max-age=31536000, immutable"
    assert len({each.headers["ETag"] for each in (whole, plain, lower)}) == 3
    (error,) = client.get("/api/textures/foam", params={"part": "upper"}).json()["errors"]
    assert error["parameter"] == "part"
    assert client.get(url, params={"part": "middle"}).status_code == 422


def test_head_answers_what_get_would_without_the_body(client):
    names = ("content-type", "content-length", "etag", "cache-control")
    for url in ("/", "/api/presets", "/api/plans/default", "/api/frames/default.png?width=9&height=9"):
        got, head = client.get(url), client.head(url)
        assert (got.status_code, head.status_code, head.content) == (200, 200, b"")
        assert [head.headers.get(name) for name in names] == [got.headers.get(name) for name in names]


def test_the_manual_loads_nothing_from_elsewhere_and_a_browser_finds_the_icon(client):
    page = client.get("/docs").text
    addresses = re.findall(r"""(?:src=|href=|data-description=)["']([^"']+)""", page)
    assert len(addresses) == 5
    for address in addresses:
        # Relative, so that it holds below a path of a proxy too.
        assert not re.match(r"/|\w+:", address), address
        assert client.get(address).status_code == 200, address
    icon = client.get("/favicon.ico")
    assert (icon.status_code, icon.headers["Content-Type"]) == (200, "image/svg+xml")
    assert icon.content == client.get("/icon.svg").content


def test_what_needs_a_package_that_is_not_installed_says_so(client, monkeypatch):
    monkeypatch.setattr("seafoam.extras.find_spec", lambda name: None if name == "matplotlib" else object())
    for url in ("/api/masks/custom/spectrum.png?family=vac&sigma=2&size=64&seed=9", "/api/accuracy/default"):
        told = problem(client.get(url), 501)
        assert told["type"] == "urn:seafoam:problem:not-installed"
        assert told["remedy"] == "pip install 'seafoam[reports]'"


def test_the_page_is_revalidated_and_its_hashed_files_are_kept(tmp_path, monkeypatch):
    monkeypatch.setattr("seafoam.api.site.data_dir", lambda kind: tmp_path / kind)
    client = answering()
    for page in ("/", "/docs", "/learn", "/learn/laboratory"):
        assert "make webclient" in client.get(page).text, page
    # Built while the server runs.
    for name in ("index.html", "learn/index.html", "assets/index-abc.js"):
        (tmp_path / "webclient" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "webclient" / name).write_text(f"<title>{name}</title>")
    page, chapter = client.get("/"), client.get("/learn")
    assert page.headers["Content-Type"].startswith("text/html")
    assert page.headers["Cache-Control"] == chapter.headers["Cache-Control"] == "public, no-cache"
    # Its links are relative.
    assert (chapter.url.path, chapter.text) == ("/learn/", "<title>learn/index.html</title>")
    assert "immutable" in client.get("/assets/index-abc.js").headers["Cache-Control"]
    assert client.get("/../conftest.py").status_code == 404


def test_health_and_readiness_which_ends_where_nothing_was_drawn_lately(client, monkeypatch):
    assert client.get("/healthz").json() == {"status": "alive"}
    client.get("/api/frames/default.png?width=4&height=4")
    ready = client.get("/readyz")
    assert ready.headers["Cache-Control"] == "no-store"
    body = ready.json()
    assert body["renderer"] == {"vendor": "Nobody", "renderer": "gradient", "version": "0"}
    assert 0 <= body["last_drawn"] < 60
    pool = client.app.state.context.pool
    monkeypatch.setattr(pool, "succeeded_at", pool.succeeded_at - 1000.0)
    response = client.get("/readyz")
    assert re.search(r"drawn \d{4} s ago, which is more than 180 s", problem(response, 503)["detail"])
    assert response.headers["Retry-After"] == "60"
    # The next frame is proof.
    client.get("/api/frames/default.png?width=4&height=5")
    assert client.get("/readyz").status_code == 200


def test_metrics_count_requests_by_route_and_frames_by_stage(client):
    def read():
        families = text_string_to_metric_families(client.get("/metrics").text)
        return {(s.name, *sorted(s.labels.items())): s.value for f in families for s in f.samples}

    route = ("route", "/api/frames/{preset}.{format}")
    before = read()
    client.get("/api/frames/default.png?width=5&height=5")
    client.get("/api/frames/nope.png")
    after = read()

    once = [("seafoam_requests_total", ("method", "GET"), route, ("status", status)) for status in ("200", "404")]
    once.append(("seafoam_frames_total", ("format", "png")))
    stages = ("queue", "plan", "render", "read", "encode")
    once += [("seafoam_frame_stage_seconds_count", ("stage", stage)) for stage in stages]
    assert {key: after[key] - before.get(key, 0.0) for key in once} == dict.fromkeys(once, 1)
    pool = {"seafoam_workers": 1, "seafoam_queue_limit": 2, "seafoam_queue_waiting": 0}
    assert {name: after[name,] for name in pool} == pool
    assert after["seafoam_renderer_state", ("state", "ready")] == 1


def test_openapi_describes_every_operation_with_its_problems(client):
    document = client.get("/openapi.json").json()
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            assert operation.get("description"), f"{method} {path}"
            assert "application/problem+json" in operation["responses"]["422"]["content"], f"{method} {path}"
            for parameter in operation.get("parameters", ()):
                assert parameter.get("description"), f"{method} {path}: {parameter['name']}"
                told = any(word in str(parameter["schema"]) for word in ("example", "enum", "pattern", "default"))
                assert told, f"{method} {path}: {parameter['name']}"
    text = json.dumps(document)
    assert set(re.findall(r"#/components/schemas/(\w+)", text)) <= set(document["components"]["schemas"])
    assert "HTTPValidationError" not in text


def test_a_preset_has_a_page_with_its_title_text_and_picture(client: TestClient) -> None:
    preset, name = load_preset("storm"), "storm"
    response = client.get(f"/water/{name}")
    assert (response.status_code, response.headers["Content-Type"].partition(";")[0]) == (200, "text/html")
    assert "Content-Security-Policy" in response.headers
    page = response.text
    assert f'data-preset="{name}"' in page
    assert html.unescape(page.split("<title>")[1].split("</title>")[0]) == f"{preset.title} · Seafoam"
    tags = re.findall(r'<meta (?:name|property)="([\w:-]+)" content="([^"]*)"', page)
    found = {tag: html.unescape(content) for tag, content in tags}
    title, url = f"{preset.title} · Seafoam", f"http://testserver/water/{name}"
    assert found["description"] == found["og:description"] == preset.summary
    assert (found["og:title"], found["og:url"], found["twitter:card"]) == (title, url, "summary_large_image")
    assert found["og:image"] == f"{url}.jpg"
    response = client.get(found["og:image"])
    assert response.headers["Content-Type"] == "image/jpeg"
    assert (picture(response).format, picture(response).size) == ("JPEG", PREVIEW)
    assert len(response.content) < 400_000


def test_an_unknown_water_is_told_by_a_page(client: TestClient) -> None:
    for suffix in ("", ".jpg", "%00.jpg"):
        response = client.get(f"/water/%3Cb%3Eatlantis{suffix}")
        assert (response.status_code, response.headers["Content-Type"].partition(";")[0]) == (404, "text/html")
        assert "Content-Security-Policy" in response.headers
        assert "&lt;b&gt;atlantis" in response.text
        assert "<b>" not in response.text
    assert client.get("/message.css").status_code == 200


def without_none(value: Any) -> Any:
    """FastAPI leaves out members that are null, which stand in defaults."""
    if isinstance(value, dict):
        return {name: without_none(inner) for name, inner in value.items() if inner is not None}
    return [without_none(inner) for inner in value] if isinstance(value, list) else value


def test_the_schema_is_the_documents_and_complete(client: TestClient) -> None:
    schema = client.get("/api/schema").json()
    whole = client.get("/openapi.json").json()["components"]["schemas"]
    own = schema["components"]["schemas"]
    assert schema["tiers"] == list(TIERS)
    assert {"Scene", "Quality", "Light", "Foam"} <= set(own) < set(whole)
    assert "FramePlan" not in own
    assert all(whole[name] == without_none(described) for name, described in own.items())
    assert set(re.findall(r'"#/components/schemas/(\w+)"', json.dumps(own))) <= set(own)


def test_a_scene_is_completed_or_what_cannot_be_drawn_is_told(client: TestClient) -> None:
    completed = client.post("/api/scenes", json={"light": {"exposure": -1.0}}).json()
    assert completed["light"]["exposure"] == -1.0
    assert {"waves", "foam", "camera", "water"} <= set(completed)
    own = client.get("/api/presets/storm").json()["scene"]
    assert client.post("/api/scenes", json=own).json() == own
    for scene, pointer in (
        ({"light": {"exposure": 1e9}}, "/light/exposure"),
        ({"foam": {"mask": "none"}}, "/foam/mask"),
    ):
        assert problem(client.post("/api/scenes", json=scene), 422)["errors"][0]["pointer"] == pointer
