"""Frames that GL draws: pictures, the same ones for the same request, at the ends of time and size."""

import io
from collections.abc import Iterator

import numpy as np
import OpenEXR
import pytest
from starlette.testclient import TestClient

from support.scenes import load_preset
from support.serving import frame, picture, serving


@pytest.fixture(scope="module")
def real() -> Iterator[TestClient]:
    """With the GL executor."""
    with serving(None, deadline=60.0) as running:
        response = running.get("/api/frames/default.png?width=8&height=8")
        assert response.status_code == 200, response.text
        yield running


def test_a_real_frame_is_a_picture(real):
    response = frame(real, width=96, height=54)
    pixels = np.asarray(picture(response))
    assert pixels.shape == (54, 96, 3)
    assert pixels.std() > 10
    assert pixels[:10].mean() > pixels[-10:].mean()  # the sky is brighter than the water: rows run from the top


def test_the_same_request_gives_the_same_bytes_also_after_a_restart(real):
    query = {"width": 96, "height": 54, "time": 4.0}
    first, second = frame(real, **query), frame(real, **query)
    assert first.content == second.content
    with serving(None, deadline=60.0) as restarted:
        again = frame(restarted, **query)
    assert again.content == first.content
    assert again.headers["ETag"] == first.headers["ETag"]


def test_a_dithered_picture_is_the_exact_one_within_a_level_and_in_the_mean(real):
    size = {"width": 192, "height": 108}
    dithered = np.asarray(picture(frame(real, **size)), np.int64)
    exact = np.asarray(picture(frame(real, **size, dither=False)), np.int64)
    off = dithered - exact
    assert np.abs(off).max() == 1
    assert np.abs(off.mean(axis=(0, 1))).max() < 0.1
    assert np.abs(off[:32].reshape(2, 16, 12, 16, 3).mean(axis=(1, 3))).max() <= 0.5  # in the sky, too


def test_a_frame_of_a_stream_is_near_the_exact_one_and_much_smaller(real):
    scene = load_preset("default").scene.model_dump(mode="json")
    camera = load_preset("default").scene.camera
    size = {"width": 320, "height": 180, "time": 4.0}
    stream = real.post("/api/streams", json={"scene": scene}).json()["id"]
    view = dict(zip("xyz", camera.position, strict=True)) | camera.model_dump(exclude={"position"})
    moving = real.get(f"/api/streams/{stream}/frame.webp", params=size | view)
    assert moving.status_code == 200, moving.text
    exact = frame(real, "webp", **size, dither=False)
    off = np.asarray(picture(moving).convert("RGB"), float) - np.asarray(picture(exact), float)
    assert 0.0 < np.sqrt(np.mean(off**2)) < 5.0
    assert np.abs(off.mean(axis=(0, 1))).max() < 1.0
    assert len(moving.content) < len(exact.content) / 3


def test_open_exr_holds_what_npy_holds(real):
    size = {"width": 96, "height": 54, "time": 4.0}
    linear = np.load(io.BytesIO(frame(real, "npy", **size).content))
    for precision, type in (("float", np.float32), ("half", np.float16)):
        content = frame(real, "exr", **size, precision=precision).content
        channels = OpenEXR.File(io.BytesIO(content)).channels()
        np.testing.assert_array_equal(channels["RGB"].pixels, linear[..., :3].astype(type))
        np.testing.assert_array_equal(channels["coverage"].pixels, linear[..., 3].astype(type))


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
