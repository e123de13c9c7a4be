"""Frames: their headers, identity and parameters, with a renderer that draws gradients; then with GL itself."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from seafoam.scene.presets import load_preset

SMALL = {"width": 24, "height": 16}


def frame(client, suffix="png", preset="default", **params):
    response = client.get(f"/api/frames/{preset}.{suffix}", params=SMALL | params)
    assert response.status_code == 200, response.text
    return response


def picture(response):
    return Image.open(io.BytesIO(response.content))


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
        {"time": 1.25}, {"width": 25}, {"height": 17}, {"quality": "draft"}, {"look": "halftone"}, {"mask": "vac-6"},
        {"x": 1}, {"y": 9}, {"z": 2}, {"yaw": 0.5}, {"pitch": 0.1}, {"roll": 0.1}, {"fov": 0.5},
    ],
)  # fmt: skip
def test_whatever_changes_the_frame_changes_its_tag(client, change):
    assert frame(client, **change).headers["ETag"] != frame(client).headers["ETag"]


def test_the_format_changes_the_tag(client):
    assert len({frame(client, suffix).headers["ETag"] for suffix in ("png", "webp", "npy")}) == 3


def test_a_posted_frame_is_the_frame_of_the_same_preset(client):
    preset = load_preset("default")
    body = {"scene": preset.scene.model_dump(mode="json"), "time": 3.0, **SMALL}
    posted = client.post("/api/frames", json=body)
    got = frame(client, time=3.0)
    assert posted.content == got.content
    assert posted.headers["ETag"] == got.headers["ETag"]
    assert posted.headers["Cache-Control"] == "no-store"


def test_a_posted_camera_wins_over_the_scenes(client):
    camera = {"position": [1, 2, 3], "yaw": 0.5}
    inside = client.post("/api/frames", json={"scene": {"camera": camera}, **SMALL})
    beside = client.post("/api/frames", json={"scene": {}, "camera": camera, **SMALL})
    neither = client.post("/api/frames", json={"scene": {}, **SMALL})
    assert inside.content == beside.content
    assert inside.content != neither.content


@pytest.mark.parametrize("name", ["png", "webp", "npy"])
def test_a_posted_format(client, name):
    response = client.post("/api/frames", json={"scene": {}, "format": name, **SMALL})
    assert response.headers["Content-Type"] == frame(client, name).headers["Content-Type"]


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
    monkeypatch.setattr("seafoam.api.routers.presets.load_preset", lambda name: bare)
    response = client.get("/api/frames/default.png", params=SMALL | {"look": "halftone"})
    assert response.status_code == 422
    assert response.json()["errors"][0]["parameter"] == "look"


# With GL


def test_a_real_frame_is_a_picture(real):
    response = frame(real, width=96, height=54)
    pixels = np.asarray(picture(response))
    assert pixels.shape == (54, 96, 3)
    assert pixels.std() > 10
    assert pixels[:10].mean() > pixels[-10:].mean()  # the sky is brighter than the water: rows run from the top


def test_the_same_request_gives_the_same_bytes_also_after_a_restart(real, serve):
    query = {"width": 96, "height": 54, "time": 4.0}
    first, second = frame(real, **query), frame(real, **query)
    assert first.content == second.content
    with serve(None, deadline=60.0) as restarted:
        again = frame(restarted, **query)
    assert again.content == first.content
    assert again.headers["ETag"] == first.headers["ETag"]


@pytest.mark.parametrize("time", [1e9, -1e9, 0.0])
def test_a_frame_at_the_ends_of_time(real, time):
    linear = np.load(io.BytesIO(frame(real, "npy", width=48, height=27, time=time).content))
    assert np.isfinite(linear).all()
    assert linear[..., :3].std() > 0.01
    assert linear[..., 3].min() >= 0.0
    assert linear[..., 3].max() <= 1.0


@pytest.mark.parametrize("size", [(1, 1), (1, 33), (257, 1)])
def test_the_smallest_frames(real, size):
    assert picture(frame(real, width=size[0], height=size[1])).size == size


def test_the_renderer_is_told(real):
    ready = real.get("/readyz").json()
    assert ready["status"] == "ready"
    assert frame(real).headers["Seafoam-Renderer"] == ready["renderer"]["renderer"]
    assert "Mesa" in ready["renderer"]["version"] or ready["renderer"]["version"][0].isdigit()
