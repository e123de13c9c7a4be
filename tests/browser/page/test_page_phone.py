"""The page on a phone, what must be large and clear enough on any screen; time, resolution and quality."""

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
    link,
    pixels_of,
    swipe,
    visit,
)
from support.report import REPORT
from support.scenes import load_preset
from support.sweep import REST


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


def test_fingers_touch_and_move_the_camera(phone: Visit) -> None:
    before, start = phone.picture(), phone.state()["camera"]
    swipe(phone.page, ((6, 560), (200, 560)))
    assert not phone.state()["touches"], "a swipe from the edge is the browser's"
    swipe(phone.page, ((120, 500), (40, 540)), ((260, 500), (350, 540)))
    phone.settle()
    closer = phone.state()["camera"]
    assert closer["position"] != start["position"]
    assert not phone.state()["touches"]
    phone.page.touchscreen.tap(200, 520)
    phone.page.wait_for_function("() => window.seafoam.state().touches?.length === 1 && !window.seafoam.state().busy")
    assert phone.state()["camera"] == closer
    phone.press("Touch water")
    asked = phone.plans()
    swipe(phone.page, ((100, 400), (220, 400)))
    phone.settle()
    turned = phone.state()["camera"]
    # The sea stays under the finger, so the view turns the other way.
    assert turned["yaw"] < closer["yaw"] - 0.05
    assert turned["fov"] == start["fov"]
    assert differs(phone.picture(), before) > 0.2
    assert phone.plans() == asked
    phone.press("Touch water")


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


COVERED = """(within) => [...document.querySelectorAll(within)].flatMap((part) =>
  [...part.querySelectorAll('button, select, input, [role=slider]')]
    .filter((target) => target.checkVisibility({ checkVisibilityCSS: true }))
    .filter((target) => {
      const { x, y, width, height } = target.getBoundingClientRect();
      const top = document.elementFromPoint(x + width / 2, y + height / 2);
      return !target.contains(top);
    })
    .map((target) => target.getAttribute('aria-label')))"""
"""Names of what cannot be hit in the parts that a selector names."""


def test_targets_fit_a_finger_and_nothing_covers_them(phone: Visit) -> None:
    page = phone.page
    phone.press("Compare side by side")
    targets = page.evaluate(TARGETS)
    assert page.evaluate(COVERED, "#transport, #tools, #split-view") == []
    phone.settings()
    for folder in ("light", "waves (2)"):
        phone.settings().get_by_role("button", name=folder).click()
    page.wait_for_function("() => document.querySelector('#settings').getAnimations({ subtree: true }).length === 0")
    targets += page.evaluate(TARGETS)
    assert page.evaluate(COVERED, "#settings .head, #transport") == []
    assert len(targets) > 40
    assert [target for target in targets if min(target[1:]) < FINGER] == []


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


WATERS = ("default", "storm", "moonlight", "shallows", "paper-threshold")


@pytest.mark.parametrize(
    ("waters", "turn"),
    [(WATERS[::2], 0), pytest.param(WATERS[1::2], 0, marks=REST), pytest.param(WATERS, 1, marks=REST)],
    ids=["some", "others", "in the other window"],
)
def test_words_stand_out(llvmpipe: Lane, server: str, waters: tuple[str, ...], turn: int) -> None:
    """Over pale sky, night and white dots: what lies beside letters is of another tone, by their ink or their glow."""
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        page = made.page
        # The still stands, which shows what is drawn.
        Held(page, "**/api/plans")
        for i, preset in enumerate(waters, turn):
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
    assert small.state()["time"] == load_preset("paper-halftone").time
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is True
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is False


def test_time_is_set_typed_exactly_and_steps_by_frames(small: Visit) -> None:
    page, before = small.page, small.picture()
    page.get_by_label("Time within the minute").fill("30")
    assert small.state()["time"] == pytest.approx(30.0, abs=1e-6)
    assert differs(small.picture(), before) > 0.2
    moment = page.get_by_label("Time in seconds")
    assert moment.input_value() == "30.00"
    for typed, time in (("-12.5", -12.5), ("1e9", 1e9), ("4,25", 4.25)):
        small.enter("Time in seconds", typed)
        assert small.state()["time"] == time
        assert small.picture().std() > 5.0
    small.enter("Time in seconds", "never")
    assert small.state()["time"] == 4.25
    assert moment.input_value() == "4.25"
    small.follow(link(time=1))
    page.locator("#canvas").press(".")
    assert small.state()["time"] == 61 / 60
    page.keyboard.press(",")
    page.keyboard.press(",")
    assert small.state()["time"] == 59 / 60
    moment.focus()
    assert float(moment.input_value()) == 59 / 60, "the field shows every digit while it is edited"
    # In the field these keys are text.
    moment.fill("")
    moment.type("4.25")
    moment.press("Enter")
    assert small.state()["time"] == 4.25
    small.press("Play")
    page.locator("#canvas").press(".")
    assert small.state()["playing"] is False
