"""What the server answers to the page's accuracy benchmark: a small truth, so that a test need not wait for its own."""

import io
import re
from functools import cache
from typing import Any

import numpy as np
from playwright.sync_api import Page, Route

from seafoam.accuracy.points import points_of
from seafoam.reference import render
from support.scenes import load_preset

SIZE = (32, 18)
PRESET = "paper-textured"
RUNNING: dict[str, Any] = {
    "status": 202,
    "headers": {"Retry-After": "1"},
    "json": {"status": "running", "stage": "float64 truth", "progress": 0.4, "eta_s": 7.0},
}
"""While the server computes."""


@cache
def truth() -> bytes:
    """A small true picture, as the server would give it."""
    preset = load_preset(PRESET)
    width, height = SIZE
    frame = render(preset.scene, time=preset.time, width=width, height=height, samples=3, mode="converged")
    buffer = io.BytesIO()
    np.save(buffer, np.concatenate((frame.rgb, frame.alpha[..., None]), axis=-1).astype(np.float32))
    return buffer.getvalue()


@cache
def points() -> tuple[dict[str, Any], ...]:
    """The tiers, and one value of every third parameter: enough of them to choose from."""
    found = [point.model_dump(mode="json") for point in points_of(load_preset(PRESET).scene)]
    parameters = {point["parameter"]["pointer"]: point for point in found if point["parameter"]}
    return tuple([point for point in found if point["tier"]] + list(parameters.values())[::3])


def answers() -> dict[str, Any]:
    width, height = SIZE
    info = {"url": f"/api/accuracy/{PRESET}/truth.npy", "width": width, "height": height, "samples": 9}
    return {"preset": PRESET, "truth": info | {"time": load_preset(PRESET).time}, "points": points()}


def sweep() -> dict[str, Any]:
    """What a server might have measured, as far as the page reads it."""
    measured = [
        point
        | {
            "time": {"median_ms": 2.0 + index, "low_ms": 1.5 + index, "high_ms": 2.5 + index},
            "model": {"fixed_ms": 0.5 + index, "ns_per_pixel": 40.0},
            "error": {"rmse": 30.0 - 0.1 * index, "max": 200.0, "coverage": 0.1, "flip": 0.05},
        }
        for index, point in enumerate(points())
    ]
    return {"machine": {"renderer": "the server's own"}, "points": measured}


def awaited(page: Page) -> None:
    """Have the truth come never: a server that computes it takes a processor from the tests."""
    page.route("**/truth.npy*", lambda route: route.fulfill(**RUNNING))


def staged(page: Page) -> None:
    """Answer for the server: it computes the truth, and its own sweep, for one request each."""
    asked: list[str] = []
    # Once before the page asks, since this takes seconds on a busy machine.
    points()

    def answer(route: Route) -> None:
        url = route.request.url
        last = url.rpartition("/")[2]
        waits = last != "points" and url not in asked
        asked.append(url)
        if waits:
            route.fulfill(**RUNNING)
        elif last == "truth.npy":
            route.fulfill(body=truth(), content_type="application/x-npy")
        else:
            route.fulfill(json=answers() if last == "points" else sweep())

    page.route(re.compile("/api/accuracy/"), answer)
