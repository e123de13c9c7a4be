"""What a visitor transfers and sees until the water moves, on a slow network too, and the exact picture afterwards."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import expect

from support.browser.lanes import Lane
from support.browser.visits import BLANK, Held, Visit, link, until, visit

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


def test_a_first_visit_is_light_until_the_water_moves(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, BLANK, size=WINDOW, settle=False) as made, counted(made) as bytes_of:
        # What comes as soon as the water moves is held back: it would be counted where it came before we looked.
        later = [Held(made.page, pattern) for pattern in (LOWER, "**/*.small.webp")]
        made.page.goto(f"{server}/{MOVING}", wait_until="load")
        moves(made)
        before = dict(bytes_of)
        assert sum(before.values()) <= MOST, sorted(((size, url) for url, size in before.items()), reverse=True)
        assert any("/stills/default.avif" in url for url in before)
        assert len([url for url in before if "part=upper" in url]) == 3
        for held in later:
            held.arrived()
            held.let_go()
        until(made.page, "() => !window.seafoam.state().rough")
        until(
            made.page,
            "() => [...document.querySelectorAll('.strip img')].filter((one) => one.complete && one.src).length > 8",
        )
        assert len([url for url in bytes_of if "part=lower" in url]) == 3
        assert not [url for url in bytes_of if re.search(r"/ranks\?sha256=\w+$", url)], "what was here came again"


def test_the_picture_becomes_the_exact_one_and_none_is_saved_before(llvmpipe: Lane, server: str) -> None:
    at = {"time": 12.5, "preset": "default", "draw": "browser"}
    with visit(llvmpipe, server, link(**at)) as made:
        exact = made.picture()
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        held = Held(made.page, LOWER)
        made.page.goto(f"{server}/#quality=fast&draw=browser&scale=0.25&time=12.5", wait_until="load")
        moves(made)
        made.page.keyboard.press("Space")
        made.follow(link(**at))
        assert made.state()["rough"]
        saved: list[str] = []
        made.page.on("download", lambda one: saved.append(one.suggested_filename))
        made.press("Save image as PNG")
        held.arrived()
        made.frames(20)
        assert made.state()["rough"]
        assert saved == [], "a picture was saved that is not exact"
        with made.page.expect_download(timeout=180_000):
            held.let_go()
        made.settle()
        assert (made.picture() == exact).all()


def test_the_picture_stays_on_a_slow_network_and_the_last_choice_counts(small: Visit) -> None:
    page, before = small.page, small.picture()
    small.settings()
    held = Held(page, PLANS)
    for look in ("textured", "halftone"):
        page.evaluate("(hash) => { location.hash = hash; }", link(scene={"/foam/look": look}))
        page.wait_for_function("() => window.seafoam.state().busy")
        page.wait_for_timeout(300)  # longer than the page waits for a slider to come to rest
    expect(page.locator(".busy")).to_be_visible()
    assert (small.saved()[0] == before).all()
    held.let_go()
    page.wait_for_function("() => !window.seafoam.state().busy")
    expect(page.locator(".busy")).to_be_hidden()
    halftone = small.picture()
    small.follow(link(scene={"/foam/look": "halftone"}))
    assert (small.picture() == halftone).all()
    assert (halftone != before).any()
