"""Frames that GL draws: pictures, the same ones for the same request, at the ends of time and size."""

import io
from collections.abc import Iterator

import numpy as np
import OpenEXR
import pytest
from starlette.testclient import TestClient

from support.serving import frame, picture, serving


@pytest.fixture(scope="module")
def real() -> Iterator[TestClient]:
    """With the GL executor."""
    with serving(None, deadline=60.0) as running:
        response = running.get("/api/frames/default.png?width=8&height=8")
        assert response.status_code == 200, response.text
        yield running


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


def test_open_exr_holds_what_npy_holds(real):
    size = {"width": 96, "height": 54, "time": 4.0}
    linear = np.load(io.BytesIO(frame(real, "npy", **size).content))
    for precision, type in (("float", np.float32), ("half", np.float16)):
        content = frame(real, "exr", **size, precision=precision).content
        channels = OpenEXR.File(io.BytesIO(content)).channels()
        np.testing.assert_array_equal(channels["RGB"].pixels, linear[..., :3].astype(type))
        np.testing.assert_array_equal(channels["coverage"].pixels, linear[..., 3].astype(type))


def test_the_renderer_is_told(real):
    ready = real.get("/readyz").json()
    assert ready["status"] == "ready"
    assert frame(real).headers["Seafoam-Renderer"] == ready["renderer"]["renderer"]
    assert "Mesa" in ready["renderer"]["version"] or ready["renderer"]["version"][0].isdigit()
