"""The page on a phone, what must be large and clear enough on any screen; time, speed, resolution and quality."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page

from support.browser.lanes import Lane
from support.browser.visits import (
    BLANK,
    DESKTOP,
    FINGER,
    PHONE,
    SMALL,
    TARGETS,
    Held,
    Visit,
    differs,
    pixels_of,
    swipe,
    visit,
)
from support.report import REPORT
from support.scenes import load_preset
from support.sweep import spread


@pytest.fixture(scope="module")
def shared_phone(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, size=PHONE, has_touch=True, is_mobile=True) as made:
        yield made


@pytest.fixture
def phone(shared_phone: Visit) -> Iterator[Visit]:
    """The page on a phone, at rest, as it was when it opened; it may complain of nothing."""
    with shared_phone.awake():
        shared_phone.start_again()
        yield shared_phone
    assert shared_phone.complaints == []


def test_fingers_touch_and_two_move_the_camera(phone: Visit) -> None:
    start = phone.state()["camera"]
    swipe(phone.page, ((6, 560), (200, 560)))
    assert not phone.state()["touches"], "a swipe from the edge is the browser's"
    swipe(phone.page, ((120, 500), (40, 540)), ((260, 500), (350, 540)))
    phone.settle()
    turned = phone.state()["camera"]
    assert turned["position"] != start["position"]
    assert not phone.state()["touches"]
    phone.page.touchscreen.tap(200, 520)
    phone.page.wait_for_function("() => window.seafoam.state().touches?.length === 1 && !window.seafoam.state().busy")
    assert phone.state()["camera"] == turned


def test_fingers_move_the_camera(phone: Visit) -> None:
    before, start = phone.picture(), phone.state()["camera"]
    phone.press("Touch water")
    asked = phone.plans()
    swipe(phone.page, ((100, 400), (220, 400)))
    phone.settle()
    turned = phone.state()["camera"]
    # The sea stays under the finger, so the view turns the other way.
    assert turned["yaw"] < start["yaw"] - 0.05
    assert turned["fov"] == start["fov"]
    assert differs(phone.picture(), before) > 0.2
    swipe(phone.page, ((180, 400), (80, 400)), ((210, 400), (310, 400)))
    phone.settle()
    closer = phone.state()["camera"]
    assert closer["position"] != turned["position"]
    assert closer["yaw"] == pytest.approx(turned["yaw"])
    assert phone.plans() == asked


def test_the_settings_are_a_sheet_from_below(phone: Visit) -> None:
    panel = phone.settings()
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).transform === 'none'")
    box = panel.bounding_box()
    assert (box["x"], box["width"]) == (0, PHONE[0])
    assert box["y"] + box["height"] == pytest.approx(PHONE[1], abs=1)
    assert box["y"] > PHONE[1] / 3, "no picture is left to judge by"
    play = phone.page.get_by_role("button", name="Play")
    play.click()
    assert phone.state()["playing"] is True, "time stays in reach"
    phone.press("Pause")
    assert phone.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    phone.press("Close settings")
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).visibility === 'hidden'")
    assert panel.evaluate("(panel) => panel.inert") is True


def test_targets_fit_a_finger(phone: Visit) -> None:
    phone.press("Compare side by side")
    targets = phone.page.evaluate(TARGETS)
    phone.settings()
    for folder in ("light", "waves (5)"):
        phone.settings().get_by_role("button", name=folder).click()
    phone.page.wait_for_function(
        "() => document.querySelector('#settings').getAnimations({ subtree: true }).length === 0"
    )
    targets += phone.page.evaluate(TARGETS)
    assert len(targets) > 40
    assert [target for target in targets if min(target[1:]) < FINGER] == []


@pytest.mark.parametrize("opened", [False, True], ids=["compared", "settings"])
def test_nothing_covers_what_must_be_reached(phone: Visit, opened: bool) -> None:
    phone.press("Compare side by side")
    if opened:
        phone.settings()
        phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).transform === 'none'")
    within = "#settings .head, #transport" if opened else "#transport, #tools, #split-view"
    covered = phone.page.evaluate(
        """(within) => [...document.querySelectorAll(within)].flatMap((part) =>
          [...part.querySelectorAll('button, select, input, [role=slider]')]
            .filter((target) => target.checkVisibility({ checkVisibilityCSS: true }))
            .filter((target) => {
              const { x, y, width, height } = target.getBoundingClientRect();
              const top = document.elementFromPoint(x + width / 2, y + height / 2);
              return !target.contains(top);
            })
            .map((target) => target.getAttribute('aria-label')))""",
        within,
    )
    assert covered == []


def luminance(srgb: Any) -> Any:
    """Relative luminance (WCAG 2) of colours in [0, 255]."""
    share = np.asarray(srgb, float) / 255
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722]


def beside(letters: NDArray[np.bool_], reach: int) -> NDArray[np.bool_]:
    """Pixels within that many of a letter's, and none of its own."""
    near = letters
    for axis in (0, 1):
        near = np.logical_or.reduce([np.roll(near, shift, axis) for shift in range(-reach, reach + 1)])
    return near & ~letters


@pytest.mark.parametrize("turn", spread(range(2), 2))
def test_words_stand_out(llvmpipe: Lane, server: str, turn: int) -> None:
    """Over pale sky, night and white dots: what lies beside letters is of another tone, by their ink or their glow.

    Each water in one of the windows; the sweep has the other.
    """
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        page = made.page
        # The still stands, which shows what is drawn.
        Held(page, "**/api/plans")
        for i, preset in enumerate(("default", "storm", "moonlight", "shallows", "paper-threshold"), turn):
            width, height = (PHONE, DESKTOP)[i % 2]
            page.set_viewport_size({"width": width, "height": height})
            page.goto(f"{server}/water/{preset}")
            page.locator("#title", has_text=load_preset(preset).title).wait_for()
            page.wait_for_function("() => document.getElementById('still').complete")
            for part, contrast in contrasts(page, ("#title", "#summary")).items():
                worst = np.percentile(contrast, 2)
                REPORT.add(
                    f"Contrast of {part} with what lies beside its letters",
                    water=preset,
                    width=str(width),
                    median=f"{np.median(contrast):.1f}",
                    worst=f"{worst:.1f}",
                )
                assert worst > 4.5, preset


def contrasts(page: Page, parts: tuple[str, ...]) -> dict[str, NDArray[np.float64]]:
    """Of the ink of each part's words with every pixel beside a letter."""
    inked = pixels_of(page.screenshot())
    bare = page.add_style_tag(content=f"{', '.join(parts)} {{ color: transparent }}")
    behind = pixels_of(page.screenshot())
    bare.evaluate("(tag) => tag.remove()")
    found = {}
    for part in parts:
        words = page.locator(part)
        colour = words.evaluate("(words) => getComputedStyle(words).color")
        ink = luminance([float(number) for number in re.findall(r"[\d.]+", colour)][:3])
        x, y, width, height = (round(side) for side in (words.bounding_box() or {}).values())
        place = (slice(y, y + height), slice(x, x + width))
        near = luminance(behind[place])[beside((inked[place] != behind[place]).any(axis=-1), 2)]
        found[part] = (np.maximum(ink, near) + 0.05) / (np.minimum(ink, near) + 0.05)
    return found


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
    fronts = {"scales": [1.0, 0.25], "presets": {"paper-halftone": measured}}
    stats = "(tier) => document.querySelector('.frame-stats')?.textContent.startsWith(tier) === true"
    with visit(llvmpipe, server, BLANK, size=(320, 500), settle=False) as made:
        page, held = made.page, Held(made.page, "**/fronts.json")
        # On a busy machine the server would win, and the first tier be gone before anybody looked.
        page.goto(f"{server}/#draw=browser&preset=paper-halftone", wait_until="load")
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


def test_starts_still_where_motion_is_unwelcome(llvmpipe: Lane, server: str) -> None:
    """Elsewhere it plays, as the next test's page does."""
    start = "#preset=paper-height&quality=fast"
    with visit(llvmpipe, server, start, size=(400, 300), settle=False, reduced_motion="reduce") as made:
        made.begin()
        assert made.state()["playing"] is False
        assert made.page.get_by_role("button", name="Play").count() == 1


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
