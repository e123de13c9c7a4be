"""Frames that GL draws: pictures, the same ones for the same request, at the ends of time and size."""

import io
from collections.abc import Iterator

import numpy as np
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
