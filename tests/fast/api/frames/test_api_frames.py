"""Frames: their headers, identity and parameters; the same frame once, from memory, disk, and by its plan's address."""

import io
import json
import re
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from urllib.parse import urljoin

import numpy as np
import pytest

from seafoam.api.frames.plans import PlanIndex
from seafoam.render.encode import read_recipe
from seafoam.render.service.pool import BACKGROUND_QUEUE
from seafoam.scene import load_preset, preset_names
from support.api_fakes import SLOW
from support.serving import SMALL, busy, eventually, frame, picture, problem, serving


def test_headers_of_a_frame(client):
    response = frame(client)
    expected = {
        "Content-Type": "image/png", "Seafoam-Renderer": "gradient", "Cache-Control": "public, no-cache",
        "Seafoam-Plan": client.get("/api/plans/default").headers["Seafoam-Plan"],
    }  # fmt: skip
    assert {name: response.headers[name] for name in expected} == expected
    timing = response.headers["Server-Timing"]
    assert re.fullmatch(r"(\w+;dur=\d+\.\d\d(, )?){5}", timing)
    assert [part.split(";")[0] for part in timing.split(", ")] == ["queue", "plan", "render", "read", "encode"]


def test_formats_of_a_frame(client):
    png, webp = picture(frame(client)), picture(frame(client, "webp"))
    assert (png.format, png.mode, png.size) == ("PNG", "RGB", (24, 16))
    assert (webp.format, webp.size) == ("WEBP", (24, 16))
    assert "gamma" not in png.info
    np.testing.assert_array_equal(np.asarray(png), np.asarray(webp.convert("RGB")))
    linear = np.load(io.BytesIO(frame(client, "npy").content), allow_pickle=False)
    assert (linear.shape, linear.dtype) == ((16, 24, 4), np.dtype("<f4"))


def test_what_is_absent_is_the_presets_own(client):
    preset = load_preset("default")
    bare = client.get("/api/frames/default.png")
    assert picture(bare).size == preset.size
    camera = preset.scene.camera
    x, y, z = camera.position
    spelled = {
        "time": preset.time, "width": preset.size[0], "height": preset.size[1], "quality": "standard",
        "x": x, "y": y, "z": z, "yaw": camera.yaw, "pitch": camera.pitch, "roll": camera.roll, "fov": camera.fov,
    }  # fmt: skip
    assert client.get("/api/frames/default.png", params=spelled).headers["ETag"] == bare.headers["ETag"]


def test_whatever_changes_the_frame_changes_its_tag(client):
    changes = {
        "suffix": "webp", "time": 1.25, "width": 25, "height": 17, "quality": "fast", "look": "halftone",
        "mask": "vac-6", "x": 1, "y": 9, "z": 2, "yaw": 0.5, "pitch": 0.1, "roll": 0.1, "fov": 0.5,
    }  # fmt: skip
    tags = {frame(client, **{name: value}).headers["ETag"] for name, value in changes.items()}
    assert len(tags | {frame(client).headers["ETag"]}) == len(changes) + 1


def test_a_posted_frame_is_the_frame_of_the_same_preset(client):
    preset = load_preset("default")
    body = {"scene": preset.scene.model_dump(mode="json"), "preset": "default", "time": 3.0, **SMALL}
    posted = client.post("/api/frames", json=body)
    got = frame(client, time=3.0)
    assert posted.content == got.content
    assert posted.headers["ETag"] == got.headers["ETag"]
    assert posted.headers["Cache-Control"] == "no-store"
    # Its recipe names the preset that it began from.
    unnamed = client.post("/api/frames", json=body | {"preset": None})
    assert unnamed.headers["ETag"] != posted.headers["ETag"]
    assert unnamed.content != posted.content
    # A camera beside the scene wins over the scene's.
    camera = {"position": [1, 2, 3], "yaw": 0.5}
    bodies = ({"scene": {"camera": camera}}, {"scene": {}, "camera": camera}, {"scene": {}})
    inside, beside, neither = (client.post("/api/frames", json=body | SMALL).content for body in bodies)
    assert inside == beside != neither


CACHED = {"cache_size": 16 << 20, "cache_memory": 4 << 20}


def origin(response) -> str:
    return re.sub(r'cache;desc="(\w+)"', r"\1", response.headers["Server-Timing"].split(",")[0].split(";dur")[0])


@pytest.fixture(scope="module")
def cached(tmp_path_factory):
    with serving(cache=tmp_path_factory.mktemp("cache"), **CACHED) as client:
        yield client


def test_nothing_is_kept_where_the_caches_are_off(client):
    assert origin(frame(client, time=70.0)) == origin(frame(client, time=70.0)) == "queue"
    assert client.app.state.context.frames.disk is None


def test_a_repeat_is_answered_from_memory_without_planning(cached, monkeypatch):
    first = frame(cached, time=1.5)
    body = {"scene": load_preset("default").scene.model_dump(mode="json"), "preset": "default", "time": 1.5, **SMALL}
    assert cached.post("/api/frames", json=body).content == first.content
    assert origin(cached.post("/api/frames", json=body)) == "memory"
    monkeypatch.setattr("seafoam.api.context.compile_scene", None)
    again = frame(cached, time=1.5)
    assert (origin(first), origin(again)) == ("queue", "memory")
    # In a folder of the cache for measurements.
    assert cached.app.state.context.frames.disk.directory == Path(cached.app.state.context.settings.cache) / "frames"
    assert again.content == first.content
    for name in ("ETag", "Seafoam-Plan", "Seafoam-Renderer", "Cache-Control", "Link", "Content-Type"):
        assert again.headers[name] == first.headers[name]


def test_a_restarted_server_answers_from_disk_and_knows_plans_but_not_of_another_version(tmp_path, monkeypatch):
    body = {"scene": {"waves": [{"model": "parametric"}]}, "quality": "fast"}
    where = "width=8&height=8&x=0&y=4&z=0&yaw=0&pitch=0&roll=0&fov=1"
    with serving(cache=tmp_path, **CACHED) as client:
        first = frame(client, time=3.5)
        told = client.post("/api/plans", json=body), client.get("/api/plans/paper-halftone?quality=fast")
        posted, preset = (each.headers["Seafoam-Plan"] for each in told)
        url = f"/api/plans/{posted}/frames/1.png?{where}"
        by_plan = client.get(url)
        assert by_plan.status_code == 200
    with serving(cache=tmp_path, **CACHED) as client:
        again = frame(client, time=3.5)
        assert origin(again) == "disk"
        assert again.content == first.content
        assert again.headers["ETag"] == first.headers["ETag"]
        assert origin(frame(client, time=3.5)) == "memory"
        text = client.get("/metrics").text
        for told in ('frame_origins_total{origin="disk"} 1.0', 'frame_origins_total{origin="memory"} 1.0'):
            assert f"seafoam_{told}" in text
        assert "seafoam_cache_damaged_total 0.0" in text
        assert client.get(url).content == by_plan.content
        unknown = client.get(url.replace(posted, "0" * 64))
        assert problem(unknown, 404)["errors"][0]["parameter"] == "plan"
    disk = client.app.state.context.frames.disk
    assert None not in map(PlanIndex(disk).find, (posted, preset))
    monkeypatch.setattr("seafoam.api.frames.plans.plan_hash", lambda scene, quality: "0" * 64)
    assert PlanIndex(disk).find(posted) is None


def test_requests_in_flight_share_a_render(client):
    drawn = client.app.state.context.metrics.frames.labels("png")._value
    before = drawn.get()
    with ThreadPoolExecutor(6) as threads:
        answers = list(threads.map(lambda _: frame(client, time=SLOW), range(6)))
    # No cache: all of them were in flight at once, in a queue that holds two.
    assert len({(answer.content, answer.headers["ETag"]) for answer in answers}) == 1
    assert sorted(map(origin, answers)) == ["queue", *["shared"] * 5]
    assert drawn.get() == before + 1


def test_no_visitor_waits_behind_a_queued_thumbnail(client):
    assert 2 * len(preset_names()) <= BACKGROUND_QUEUE, "thumbnails have a queue of their own"
    names = preset_names()[:4]
    with ThreadPoolExecutor(len(names) + 2) as threads:
        with busy(client) as pool:
            urls = [f"/api/presets/{name}/thumbnail.webp?width=16" for name in names]
            answers = [threads.submit(client.get, url) for url in urls]
            client.portal.call(eventually, lambda: pool.waiting_background == len(names))
            assert pool.waiting == 0
            answers.append(threads.submit(client.get, "/api/frames/default.png?width=9&height=9"))
            client.portal.call(eventually, lambda: pool.waiting == 1)
            order: list[Future] = []
            for each in answers:
                each.add_done_callback(order.append)
        assert {each.result().status_code for each in answers} == {200}
    assert order[0] is answers[-1]
    assert "seafoam_background_waiting 0.0" in client.get("/metrics").text


def test_a_thumbnail_is_a_small_frame_of_its_preset(cached):
    preset = load_preset("default")
    response = cached.get("/api/presets/default/thumbnail.png?width=160")
    assert picture(response).size == (160, round(160 * preset.size[1] / preset.size[0]))
    assert response.headers["Cache-Control"] == "public, no-cache"
    assert origin(cached.get("/api/presets/default/thumbnail.png?width=160")) == "memory"
    size = {"width": 160, "height": picture(response).size[1]}
    assert frame(cached, **size).content == response.content
    tag = response.headers["ETag"]
    current = cached.get("/api/presets/default/thumbnail.png?width=160", headers={"If-None-Match": tag})
    assert current.status_code == 304


def test_every_frame_names_its_immutable_address(cached):
    asked = {"time": -1e-7, "yaw": 0.1}
    for response in (
        frame(cached, **asked),
        frame(cached, dither=False, **asked),
        frame(cached, "exr", precision="float", **asked),
        cached.post("/api/frames", json={"scene": {}, "time": 2.0, **SMALL}),
        cached.get("/api/presets/default/thumbnail.webp?width=32"),
    ):
        address = re.fullmatch(r'<(\S+)>; rel="canonical"', response.headers["Link"])[1]
        found = cached.get(urljoin(str(response.url), address))
        assert found.status_code == 200, found.text
        assert found.headers["Cache-Control"] == "public, max-age=31536000, immutable"
        assert found.headers["Seafoam-Plan"] == response.headers["Seafoam-Plan"]
        assert urljoin(str(found.url), re.match("<(.+)>", found.headers["Link"])[1]) == str(found.url)
        if "exr" not in response.headers["Content-Type"]:  # the same picture; its recipe names no preset
            assert picture(found).tobytes() == picture(response).tobytes()
        tag = found.headers["ETag"]
        assert cached.get(str(found.url), headers={"If-None-Match": tag}).status_code == 304


def test_what_a_frame_carries_is_its_recipe(cached):
    for suffix, own in (("png", "dither"), ("webp", "dither"), ("exr", "precision")):
        response = frame(cached, suffix, time=6.5)
        recipe = json.loads(read_recipe(response.content))
        assert recipe["plan"] == response.headers["Seafoam-Plan"]
        assert (recipe["time"], recipe["width"], recipe["height"], recipe["format"]) == (6.5, 24, 16, suffix)
        assert {"dither", "precision"} & set(recipe) == {own}
        asked = {name: recipe[name] for name in recipe if name not in ("recipe", "seafoam", "renderer", "plan")}
        assert cached.post("/api/frames", json=asked).content == response.content
