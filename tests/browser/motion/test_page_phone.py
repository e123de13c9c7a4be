"""The page on a phone, and what must be large and clear enough on any screen."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page

from support.browser.lanes import Lane
from support.browser.visits import BLANK, DESKTOP, FINGER, PHONE, TARGETS, Held, Visit, differs, pixels_of, swipe, visit
from support.report import REPORT
from support.scenes import load_preset
from support.sweep import crossed

WINDOWS = {"phone": PHONE, "desktop": DESKTOP}


@pytest.fixture(scope="module")
def shared_phone(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, size=PHONE, has_touch=True, is_mobile=True) as made:
        yield made


@pytest.fixture
def phone(shared_phone: Visit) -> Iterator[Visit]:
    """The page on a phone, at rest, as it was when it opened; it may complain of nothing."""
    shared_phone.start_again()
    yield shared_phone
    assert shared_phone.complaints == []


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


def shot(page: Page, box: Any, part: str, style: str) -> NDArray[np.uint8]:
    """What a box shows while a part of the page has a style."""
    tag = page.add_style_tag(content=f"{part} {{ {style} }}")
    png = page.screenshot(clip=box)
    tag.evaluate("(tag) => tag.remove()")
    return pixels_of(png)


def beside(letters: NDArray[np.bool_], reach: int) -> NDArray[np.bool_]:
    """Pixels within that many of a letter's, and none of its own."""
    near = letters
    for axis in (0, 1):
        near = np.logical_or.reduce([np.roll(near, shift, axis) for shift in range(-reach, reach + 1)])
    return near & ~letters


@pytest.mark.parametrize(
    ("preset", "window"), crossed(("default", "storm", "moonlight", "shallows", "paper-threshold"), WINDOWS, 2)
)
def test_words_stand_out(llvmpipe: Lane, server: str, window: str, preset: str) -> None:
    """Over pale sky, night and white dots: what lies beside letters is of another tone, by their ink or their glow."""
    with visit(llvmpipe, server, BLANK, size=WINDOWS[window], settle=False) as made:
        page = made.page
        # The still stands, which shows what is drawn.
        Held(page, "**/api/plans")
        page.goto(f"{server}/water/{preset}")
        page.locator("#title", has_text=load_preset(preset).title).wait_for()
        page.wait_for_function("() => document.getElementById('still').complete")
        for part in ("#title", "#summary"):
            words = page.locator(part)
            colour = words.evaluate("(words) => getComputedStyle(words).color")
            ink = luminance([float(number) for number in re.findall(r"[\d.]+", colour)][:3])
            box = words.bounding_box()
            with_ink, without = (shot(page, box, part, style) for style in ("", "color: transparent"))
            behind = luminance(without)[beside((with_ink != without).any(axis=-1), 2)]
            contrast = (np.maximum(ink, behind) + 0.05) / (np.minimum(ink, behind) + 0.05)
            worst = np.percentile(contrast, 2)
            REPORT.add(
                f"Contrast of {part} with what lies beside its letters",
                water=preset,
                window=window,
                median=f"{np.median(contrast):.1f}",
                worst=f"{worst:.1f}",
            )
            assert worst > 4.5
