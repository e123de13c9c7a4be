"""What a visitor transfers and sees until the water moves, by every start of Chromium."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Playwright, expect

from support.browser.lanes import Lane
from support.browser.starts import SPLIT, STARTS, WINDOWS, Started, browser_started, opened
from support.browser.visits import BLANK, SMALL, Held, Visit, differs, link, pixels_of, until, visit
from support.sweep import REST

MOST = 900_000
"""Bytes from navigation until the water moves, as they come over the network."""
WINDOW = (1280, 720)
MOVING = "#draw=browser&scale=0.25"
"""Small pictures by the browser alone: a slow machine asks for neither frames of the server's nor another tier."""
LOWER = "**part=lower"
PLANS = "**/api/plans"


@contextmanager
def counted(visit: Visit) -> Iterator[dict[str, int]]:
    """Bytes by address of what is asked for here, with headers, compressed as it comes."""
    session = visit.page.context.new_cdp_session(visit.page)
    asked: dict[str, str] = {}
    bytes_of: dict[str, int] = {}

    def asks(event: dict[str, Any]) -> None:
        asked[event["requestId"]] = event["request"]["url"]

    def ends(event: dict[str, Any]) -> None:
        # What was asked for before is not of this visit.
        if (url := asked.get(event["requestId"])) is None:
            return
        bytes_of[url] = bytes_of.get(url, 0) + event["encodedDataLength"]

    session.on("Network.requestWillBeSent", asks)
    session.on("Network.loadingFinished", ends)
    session.send("Network.enable")
    yield bytes_of
    session.detach()


def moves(visit: Visit) -> None:
    """Wait until the water moves."""
    until(visit.page, "() => window.seafoam !== undefined")
    visit.page.evaluate("() => window.seafoam.ready")


def test_a_first_visit_is_light_until_the_water_moves_and_saves_no_picture_that_is_not_exact(
    llvmpipe: Lane, server: str
) -> None:
    with visit(llvmpipe, server, BLANK, size=WINDOW, settle=False) as made, counted(made) as bytes_of:
        page = made.page
        # What comes as soon as the water moves is held back: it would be counted where it came before we looked.
        lower, small = (Held(page, pattern) for pattern in (LOWER, "**/*.small.webp"))
        page.goto(f"{server}/{MOVING}", wait_until="load")
        moves(made)
        before = dict(bytes_of)
        assert sum(before.values()) <= MOST, sorted(((size, url) for url, size in before.items()), reverse=True)
        assert any("/stills/default.avif" in url for url in before)
        assert len([url for url in before if "part=upper" in url]) == 3
        small.arrived()
        small.let_go()
        until(
            page,
            "() => [...document.querySelectorAll('.strip img')].filter((one) => one.complete && one.src).length > 8",
        )
        page.keyboard.press("Space")
        page.set_viewport_size({"width": SMALL[0], "height": SMALL[1]})
        made.follow(link(preset="default", quality="standard", time=12.5, draw="browser"))
        assert made.state()["rough"]
        saved: list[str] = []
        page.on("download", lambda one: saved.append(one.suggested_filename))
        made.press("Save image as PNG")
        lower.arrived()
        made.frames(20)
        assert made.state()["rough"]
        assert saved == [], "a picture was saved that is not exact"
        with page.expect_download(timeout=180_000):
            lower.let_go()
        made.settle()
        query = f"time=12.5&quality=standard&dither=false&width={SMALL[0]}&height={SMALL[1]}"
        exact = page.request.get(f"{server}/api/frames/default.png?{query}")
        assert differs(made.picture(), pixels_of(exact.body())) < 1e-4
        assert len([url for url in bytes_of if "part=lower" in url]) == 3
        assert not [url for url in bytes_of if re.search(r"/ranks\?sha256=\w+$", url)], "what was here came again"


def test_the_picture_stays_on_a_slow_network_and_the_last_choice_counts(small: Visit) -> None:
    page, before = small.page, small.picture()
    small.settings()
    held = Held(page, PLANS)
    for look in ("textured", "filtered"):
        page.evaluate("(hash) => { location.hash = hash; }", link(scene={"/foam/look": look}))
        page.wait_for_function("() => window.seafoam.state().busy")
        page.wait_for_timeout(300)  # longer than the page waits for a slider to come to rest
    expect(page.locator(".busy")).to_be_visible()
    assert (small.saved()[0] == before).all()
    held.let_go()
    page.wait_for_function("() => !window.seafoam.state().busy")
    expect(page.locator(".busy")).to_be_hidden()
    filtered = small.picture()
    small.follow(link(scene={"/foam/look": "filtered"}))
    assert (small.picture() == filtered).all()
    assert (filtered != before).any()


USUAL = {"default flags": "desktop", "WebGL off": "phone"}
"""The windows that every run tries; the sweep has the others."""
SOFTWARE = ("SwiftShader", "llvmpipe", "WebGL off")
"""Starts that draw without a GPU on every machine."""
SIZES = {"desktop": (800, 450), "phone": (320, 480)}
"""Of the windows: who draws fewer pixels is sooner done."""
CASES = [
    pytest.param(start, window, id=f"{start}-{window}", marks=() if USUAL.get(start) == window else REST)
    for start in STARTS
    for window in WINDOWS
]


@pytest.mark.parametrize(("start", "window"), CASES)
def test_the_water_moves_and_answers(playwright: Playwright, server: str, start: str, window: str) -> None:
    with (
        browser_started(playwright, start) as browser,
        opened(browser, server, window, SIZES[window]) as started,
    ):
        started.page.wait_for_function("() => window.seafoam !== undefined")
        started.page.evaluate("() => window.seafoam.ready")
        moves_and_answers(started)
        if start == "WebGL off":
            plays_and_gives_back_the_stream_of_the_other_side(started)
        assert started.said() == []
        if start in SOFTWARE:
            assert {frame["by"] for frame in started.frames()} == {"server"}, "nothing is compiled that draws slowly"


def moves_and_answers(started: Started) -> None:
    page = started.page
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


def plays_and_gives_back_the_stream_of_the_other_side(started: Started) -> None:
    """Play leaves no message, and without a divider the other side's stream is given back."""
    page = started.page
    started.play(0.0)
    started.more_frames(2)
    assert "touches" in page.url or "split" in page.url
    page.evaluate("(hash) => { location.hash = hash; }", f"#preset=default&split={SPLIT}")
    page.locator(".served canvas").nth(1).wait_for()
    with page.expect_request(lambda request: request.method == "DELETE" and "/api/streams/" in request.url):
        page.evaluate("(hash) => { location.hash = hash; }", "#preset=default")
