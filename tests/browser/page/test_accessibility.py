"""What axe finds wrong with the page and its parts for people who use a keyboard or a screen reader."""

import pytest
from playwright.sync_api import expect

from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import DESKTOP, FINGER, PHONE, TARGETS, Visit, link, visit

SIZES = pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])


@SIZES
def test_axe_finds_nothing(llvmpipe: Lane, server: str, size: tuple[int, int]) -> None:
    with visit(llvmpipe, server, link(scene={"/light/exposure": 1}), size=size, reduced_motion="reduce") as made:
        page = made.page
        assert violations(made.page) == [], "the page"
        page.keyboard.press("/")
        page.locator(".waters").wait_for()
        assert violations(made.page) == [], "the list of waters"
        page.keyboard.press("Escape")
        made.settings().get_by_role("button", name="light", exact=True).click()
        page.get_by_role("button", name="Paste scene").click()
        page.locator(".changes summary").click()
        assert violations(made.page) == [], "the settings"


def fits(made: Visit, size: tuple[int, int]) -> None:
    """What opened beside the picture is no wider than the page, and fingers hit what is in it."""
    sheet = made.page.locator(".sheet")
    sheet.get_by_role("heading", level=2).wait_for()
    sheet.get_by_role("heading", level=3).first.wait_for()
    box = sheet.bounding_box() or {}
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= size[0]
    assert made.page.evaluate("() => document.querySelector('.sheet').scrollWidth") <= box["width"]
    small = [one for one in made.page.evaluate(TARGETS) if one[2] < FINGER - 1]
    inside = {one.strip()[:40] for one in sheet.locator("button, select").all_inner_texts()}
    assert [one for one in small if one[0] in inside] == []


def closed(made: Visit) -> None:
    made.page.locator(".sheet").get_by_role("button", name="Close").press("Escape")
    made.page.locator(".sheet").wait_for(state="detached")
    made.page.wait_for_function("() => !location.hash.includes('open=')")


@SIZES
def test_what_opens_beside_the_picture_fits_closes_and_axe_finds_nothing(
    llvmpipe: Lane, server: str, size: tuple[int, int]
) -> None:
    """By its address. The stage is dark in both themes; a cheap picture is enough behind it."""
    light = {"color_scheme": "light", "reduced_motion": "reduce"}
    with visit(llvmpipe, server, link(preset="paper-threshold", open="plan"), size=size, **light) as made:
        page = made.page
        fits(made, size)
        for tab in ("Passes", "Effects", "GLSL", "Changes"):
            page.locator(".sheet").get_by_role("button", name=tab, exact=True).click()
            assert violations(page) == [], f"the plan's {tab}"
        closed(made)
        made.follow(link(preset="paper-threshold", open="take"))
        page.locator("[data-surface=take] pre").first.wait_for()
        fits(made, size)
        assert violations(page) == [], "take home"
        closed(made)
        page.get_by_role("button", name="Accuracy benchmark").click()
        page.locator("#accuracy.open").wait_for()
        assert violations(page) == [], "accuracy"


@SIZES
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_chapter_and_laboratories(
    llvmpipe: Lane, server: str, size: tuple[int, int], scheme: str
) -> None:
    seen = {"color_scheme": scheme, "reduced_motion": "reduce", "has_touch": size == PHONE}
    with visit(llvmpipe, server, "learn/", size=size, settle=False, **seen) as made:
        page = made.page
        assert violations(page) == [], "the chapter"
        page.goto(f"{server}/learn/laboratory/")
        page.locator("#strips[data-live=true]").wait_for()
        assert violations(page) == [], "the foam laboratory"
        page.goto(f"{server}/masks/")
        expect(page.locator(".side[aria-busy=false]")).to_have_count(1, timeout=60_000)
        assert violations(page) == [], "the mask laboratory"


def test_axe_would_find_something(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server) as made:
        made.page.evaluate("() => document.querySelector('#tools button').removeAttribute('aria-label')")
        made.page.evaluate("() => document.querySelector('#tools button').removeAttribute('title')")
        assert [rule for rule, _ in violations(made.page)] == ["button-name"]


@SIZES
def test_forced_colours_leave_what_is_set_visible(llvmpipe: Lane, server: str, size: tuple[int, int]) -> None:
    """Colours of the system's: axe finds nothing, and line and place of the playback are not of the ground's colour."""
    seen = {"forced_colors": "active", "reduced_motion": "reduce"}
    with visit(llvmpipe, server, link(preset="paper-threshold"), size=size, **seen) as made:
        made.settings()
        assert made.page.evaluate("matchMedia('(forced-colors: active)').matches")
        assert violations(made.page) == []
        ground, line, place = made.page.evaluate(
            """() => {
              const color = (part, pseudo) => getComputedStyle(part, pseudo).backgroundColor;
              const [line, , place] = document.querySelectorAll('#transport i');
              return [color(document.querySelector('#transport')), color(line), color(place, '::before')];
            }"""
        )
        assert ground not in (line, place)
        assert (
            made.page.locator("#settings input[type=range]").first.evaluate("(one) => getComputedStyle(one).appearance")
            == "auto"
        )
