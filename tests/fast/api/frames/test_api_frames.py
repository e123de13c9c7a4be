"""Frames: their headers, identity and parameters, with a renderer that draws gradients."""

import io
import re

import numpy as np
import pytest

from seafoam.scene.presets import load_preset
from support.serving import SMALL, frame, picture, problem


def test_headers_of_a_frame(client):
    response = frame(client)
    plan = client.get("/api/plans/default").headers["Seafoam-Plan"]
    assert response.headers["Content-Type"] == "image/png"
    assert response.headers["Seafoam-Plan"] == plan
    assert response.headers["Seafoam-Renderer"] == "gradient"
    assert response.headers["Cache-Control"] == "public, no-cache"
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
    assert linear.shape == (16, 24, 4)
    assert linear.dtype == np.dtype("<f4")


def test_what_is_absent_is_the_presets_own(client):
    preset = load_preset("default")
    bare = client.get("/api/frames/default.webp")
    assert picture(bare).size == preset.size
    camera = preset.scene.camera
    x, y, z = camera.position
    spelled = {
        "time": preset.time, "width": preset.size[0], "height": preset.size[1], "quality": "standard",
        "x": x, "y": y, "z": z, "yaw": camera.yaw, "pitch": camera.pitch, "roll": camera.roll, "fov": camera.fov,
    }  # fmt: skip
    assert client.get("/api/frames/default.webp", params=spelled).headers["ETag"] == bare.headers["ETag"]


@pytest.mark.parametrize(
    "change",
    [
        {"suffix": "webp"}, {"suffix": "npy"}, {"time": 1.25}, {"width": 25}, {"height": 17}, {"quality": "fast"},
        {"look": "halftone"}, {"mask": "vac-6"}, {"x": 1}, {"y": 9}, {"z": 2}, {"yaw": 0.5}, {"pitch": 0.1},
        {"roll": 0.1}, {"fov": 0.5},
    ],
)  # fmt: skip
def test_whatever_changes_the_frame_changes_its_tag(client, change):
    assert frame(client, **change).headers["ETag"] != frame(client).headers["ETag"]


def test_a_posted_frame_is_the_frame_of_the_same_preset(client):
    preset = load_preset("default")
    body = {"scene": preset.scene.model_dump(mode="json"), "preset": "default", "time": 3.0, **SMALL}
    posted = client.post("/api/frames", json=body)
    got = frame(client, time=3.0)
    assert posted.content == got.content
    assert posted.headers["ETag"] == got.headers["ETag"]
    assert posted.headers["Cache-Control"] == "no-store"
    for name in ("png", "webp", "npy"):
        posted = client.post("/api/frames", json={"scene": {}, "format": name, **SMALL})
        assert posted.headers["Content-Type"] == frame(client, name).headers["Content-Type"]


def test_a_posted_camera_wins_over_the_scenes(client):
    camera = {"position": [1, 2, 3], "yaw": 0.5}
    inside = client.post("/api/frames", json={"scene": {"camera": camera}, **SMALL})
    beside = client.post("/api/frames", json={"scene": {}, "camera": camera, **SMALL})
    neither = client.post("/api/frames", json={"scene": {}, **SMALL})
    assert inside.content == beside.content
    assert inside.content != neither.content


def test_a_current_frame_is_answered_without_the_queue(client):
    pool = client.app.state.context.pool
    tag = frame(client, time=9.0).headers["ETag"]
    drawn = pool.succeeded_at
    response = client.get("/api/frames/default.png", params=SMALL | {"time": 9.0}, headers={"If-None-Match": tag})
    assert response.status_code == 304
    assert "Server-Timing" not in response.headers
    assert response.headers["Seafoam-Plan"]
    assert pool.succeeded_at == drawn


def test_looks_and_masks_need_foam(client, monkeypatch):
    bare = load_preset("default")
    bare = bare.model_copy(update={"scene": bare.scene.model_copy(update={"foam": None})})
    monkeypatch.setattr("seafoam.api.http.validation.load_preset", lambda name: bare)
    # At a time of its own: what has been asked before is known without looking at the preset.
    response = client.get("/api/frames/default.png", params=SMALL | {"look": "halftone", "time": 0.125})
    assert problem(response, 422)["errors"][0]["parameter"] == "look"
