"""Chromium on a machine without a GPU, started as people start it: the water moves, answers, and says what is so."""

import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from playwright.sync_api import Playwright

from support.browser.starts import SPLIT, STARTS, Started, browser_started, opened
from support.sweep import REST

USUAL = {
    "default flags": "desktop",
    "ANGLE on GL": "phone",
    "SwiftShader": "phone",
    "llvmpipe": "desktop",
    "WebGL off": "phone",
}
"""The window that every run tries; the sweep has the other."""
SOFTWARE = ("SwiftShader", "llvmpipe", "WebGL off")
"""Starts that draw without a GPU on every machine."""
CASES = [
    pytest.param((start, window), id=f"{start}-{window}", marks=() if USUAL[start] == window else REST)
    for start in STARTS
    for window in ("desktop", "phone")
]


@pytest.fixture(params=CASES)
def started(request: pytest.FixtureRequest, playwright: Playwright, server: str) -> Iterator[Started]:
    start, window = request.param
    with browser_started(playwright, start) as (browser, _), opened(browser, server, window) as made:
        yield made
        assert made.said() == []
        if start in SOFTWARE:
            assert {frame["by"] for frame in made.frames()} == {"server"}, "nothing is compiled that draws slowly"


def test_the_water_moves_and_answers(started: Started) -> None:
    page = started.page
    page.wait_for_function("() => window.seafoam !== undefined")
    page.evaluate("() => window.seafoam.ready")
    pictures = [started.picture()]
    for _ in range(2):
        started.more_frames(4)
        pictures.append(started.picture())
    steps = [np.abs(a - b).mean() for a, b in pairwise(pictures)]
    assert min(steps) > 0.2, "the pixels change from picture to picture"
    began = page.evaluate("() => window.seafoam.state().camera")
    started.drag_seconds()
    assert page.evaluate("() => window.seafoam.state().camera") != began
    readout = page.locator(".frame-stats").inner_text()
    assert re.search(r"\b[1-9]\d* fps\b", readout), readout
    assert " 0.0 ms" not in readout
    drawer = started.frames()[-1]["by"]
    assert ("server" in readout) == (drawer == "server")
    size = [int(pixels) for pixels in re.findall(r"(\d+) × (\d+)", readout)[0]]
    assert size in [[frame["width"], frame["height"]] for frame in started.frames()]


@pytest.mark.parametrize("started", [pytest.param(("WebGL off", "phone"), id="WebGL off")], indirect=True)
def test_play_leaves_no_message_and_without_a_divider_the_other_sides_stream_is_given_back(started: Started) -> None:
    started.page.wait_for_function("() => window.seafoam !== undefined")
    started.page.evaluate("() => window.seafoam.ready")
    started.play(20.0)
    started.more_frames(2)
    assert "touches" in started.page.url or "split" in started.page.url
    page = started.page
    page.evaluate("(hash) => { location.hash = hash; }", f"#preset=default&split={SPLIT}")
    page.locator(".served canvas").nth(1).wait_for()
    with page.expect_request(lambda request: request.method == "DELETE" and "/api/streams/" in request.url):
        page.evaluate("(hash) => { location.hash = hash; }", "#preset=default")
