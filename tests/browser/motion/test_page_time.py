"""The page's time, speed, resolution and quality."""

import numpy as np
import pytest

from support.browser.lanes import Lane
from support.browser.visits import BLANK, SMALL, Held, Visit, differs, visit
from support.scenes import load_preset


def test_the_resolution_is_fixed_and_set_free(small: Visit) -> None:
    width, height = SMALL
    small.settings().get_by_label("resolution").select_option("0.5")
    small.settle()
    timing = small.state()["timing"]
    assert (timing["width"], timing["height"], timing["scale"]) == (width // 2, height // 2, 0.5)
    small.page.wait_for_function("() => location.hash.includes('scale=0.5')")
    small.settings().get_by_label("resolution").select_option("auto")
    small.settle()
    # At rest it grows as sharp as the window.
    assert small.state()["timing"]["width"] == width
    small.page.wait_for_function("() => !location.hash.includes('scale')")


def test_quality_follows_what_was_measured_unless_it_is_named(llvmpipe: Lane, server: str) -> None:
    """The page in motion goes to the tier whose picture is the best in time; who names one keeps it."""
    measured = [
        {"tier": "standard", "fixed": 1.0, "pixels": 600.0, "errors": [20.0, 30.0]},
        {"tier": "fast", "fixed": 1.0, "pixels": 60.0, "errors": [5.0, 6.0]},
    ]
    fronts = {"scales": [1.0, 0.25], "presets": {"default": measured}}
    stats = "(tier) => document.querySelector('.frame-stats')?.textContent.startsWith(tier) === true"
    with visit(llvmpipe, server, BLANK, size=(320, 500), settle=False) as made:
        page, held = made.page, Held(made.page, "**/fronts.json")
        # On a busy machine the server would win, and the first tier be gone before anybody looked.
        page.goto(f"{server}/#draw=browser", wait_until="load")
        page.wait_for_function(stats, arg="standard", timeout=120_000)
        for route in held.routes:
            route.fulfill(json=fronts)
        page.wait_for_function(stats, arg="fast", timeout=120_000)
        assert made.state()["quality"] is None
        made.settings()
        assert page.locator("#quality").input_value() == "auto"
        page.locator("#quality").select_option("standard")
        page.wait_for_function(stats, arg="standard", timeout=60_000)
        page.wait_for_function("() => !window.seafoam.state().busy", timeout=60_000)
        page.wait_for_timeout(3000)
        assert made.state()["quality"] == "standard"


def test_a_pause_stops_every_pixel(small: Visit) -> None:
    before, time = small.canvas(), small.state()["time"]
    small.frames(12)
    assert (small.canvas() == before).all()
    assert small.state()["time"] == time
    small.press("Play")
    small.page.wait_for_function("(time) => window.seafoam.state().time > time", arg=time + 0.5)
    small.press("Pause")
    small.settle()
    after, later = small.canvas(), small.state()["time"]
    assert differs(after, before) > 0.2
    small.frames(12)
    assert (small.canvas() == after).all()
    assert small.state()["time"] == later
    small.press("Reset time")
    small.settle()
    assert small.state()["time"] == load_preset("default").time
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is True
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is False


def test_time_is_set(small: Visit) -> None:
    before = small.picture()
    small.page.get_by_label("Time within the minute").fill("30")
    assert small.state()["time"] == pytest.approx(30.0, abs=1e-6)
    assert differs(small.picture(), before) > 0.2
    moment = small.page.get_by_label("Time in seconds")
    assert moment.input_value() == "30.00"
    for typed, time in (("-12.5", -12.5), ("1e9", 1e9), ("4,25", 4.25)):
        small.enter("Time in seconds", typed)
        assert small.state()["time"] == time
        assert small.picture().std() > 5.0
    small.enter("Time in seconds", "never")
    assert small.state()["time"] == 4.25
    assert moment.input_value() == "4.25"


def test_speed_scales_time(small: Visit) -> None:
    small.page.get_by_label("Speed", exact=True).select_option("4")
    assert small.state()["speed"] == 4
    small.press("Play")
    # The page asks for its next frame before this does, so each sample follows the page's own step.
    samples = small.page.evaluate(
        "() => new Promise((done) => { const seen = [];"
        " const next = (now) => { seen.push([now / 1000, window.seafoam.state().time]);"
        " if (seen.length === 12) done(seen); else requestAnimationFrame(next); };"
        " requestAnimationFrame(next); })"
    )
    wall, time = np.diff(np.array(samples), axis=0)[1:].T
    assert (time > 0).all()
    # A gap of more than 0.4 s is no time that anyone saw.
    np.testing.assert_allclose(time, 4 * np.minimum(wall, 0.4), atol=1e-6)


@pytest.mark.parametrize(("motion", "playing"), [("reduce", False), ("no-preference", True)])
def test_starts_still_where_motion_is_unwelcome(llvmpipe: Lane, server: str, motion: str, playing: bool) -> None:
    with visit(llvmpipe, server, "#quality=fast", size=(400, 300), settle=False, reduced_motion=motion) as made:
        made.begin()
        assert made.state()["playing"] is playing
        assert made.page.get_by_role("button", name="Pause" if playing else "Play").count() == 1


def test_a_hidden_tab_stands_still_and_goes_on_where_it_was(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "#preset=paper-height&quality=fast", size=SMALL, settle=False) as made:
        page = made.page
        page.wait_for_function("() => window.seafoam?.state().playing && window.seafoam.state().time > 0")
        tab = page.context.new_cdp_session(page)
        before = made.state()["time"]
        tab.send("Page.setWebLifecycleState", {"state": "frozen"})
        # The browser's own clock: the page has none meanwhile.
        page.context.new_page().wait_for_timeout(2500)
        tab.send("Page.setWebLifecycleState", {"state": "active"})
        after = made.state()["time"]
        assert after - before < 1.5
        page.wait_for_function("(after) => window.seafoam.state().time > after + 0.2", arg=after)
