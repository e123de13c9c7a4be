"""The page in two windows: all of it in sight, nothing over anything else, and what axe finds wrong for people who use
a keyboard or a screen reader."""

from collections.abc import Iterator

import pytest

from support.browser.accuracy_answers import awaited
from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import DESKTOP, FINGER, OVERLAPS, PHONE, TARGETS, UNMOVED, Visit, link, visit
from support.scenes import load_preset, preset_names


@pytest.fixture(scope="module", params=[DESKTOP, PHONE], ids=["desktop", "phone"])
def window(llvmpipe: Lane, server: str, request: pytest.FixtureRequest) -> Iterator[Visit]:
    """The page in one of the windows, as its tests leave it."""
    if request.param == PHONE:
        phone: Visit = request.getfixturevalue("shared_phone")
        with phone.awake():
            yield phone
    else:
        with visit(llvmpipe, server, UNMOVED, size=DESKTOP, reduced_motion="reduce") as made:
            yield made


def wide(made: Visit) -> int:
    width: int = made.page.viewport_size["width"]
    return width


def test_opens_whole(window: Visit, llvmpipe: Lane, server: str) -> None:
    page = window.page
    assert llvmpipe.name in page.evaluate("() => window.seafoam.renderer")
    assert window.canvas().std() > 5.0, "a blank picture"
    images = page.locator("#gallery img")
    assert images.count() == len(preset_names())
    # Those in sight are there; the others come when they are scrolled to.
    loaded = "(images) => images.filter((image) => image.complete && image.naturalWidth > 0).length"
    assert 2 <= images.evaluate_all(loaded) < len(preset_names())
    images.last.scroll_into_view_if_needed()
    page.wait_for_function("() => [...document.querySelectorAll('#gallery img')].at(-1).naturalWidth > 0")
    assert page.locator("#title").text_content() == load_preset("paper-halftone").title
    assert window.state()["playing"] is False, "it starts still where motion is unwelcome"
    assert page.get_by_role("button", name="Play").count() == 1
    urls = [url for _, url in window.asked]
    assert [url for url in urls if not url.startswith((server, f"blob:{server}", "data:"))] == []
    assert [url for url in urls if "/api/frames" in url] == [], "nothing is drawn for a visitor who arrives"
    for name, path in (("Foam laboratory", "learn/laboratory/"), ("Mask laboratory", "masks/")):
        assert page.get_by_role("link", name=name).evaluate("(link) => link.href") == f"{server}/{path}"
    pages = [url for url in urls if "/api/" not in url]
    assert not any("laboratory" in url or "/masks/" in url for url in pages), "loaded before it was opened"
    assert window.plans() == 1
    assert page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    for name in ("#title", "#summary", "#tools", "#transport"):
        box = page.locator(name).bounding_box() or {}
        assert box["x"] >= 0, name
        assert box["x"] + box["width"] <= wide(window), name
    assert page.evaluate(OVERLAPS) == []
    # The sea is seen first.
    assert not page.locator("#settings").is_visible()


def test_axe_finds_nothing_and_the_list_of_waters_fits(window: Visit) -> None:
    page = window.page
    window.start_again(link(scene={"/light/exposure": 1}, scale=0.25))
    assert violations(page) == [], "the page"
    page.keyboard.press("/")
    page.locator(".waters").wait_for()
    assert violations(page) == [], "the list of waters"
    box = page.locator(".waters").bounding_box() or {}
    assert min(box["x"], box["y"]) >= 0
    assert box["x"] + box["width"] <= wide(window)
    assert box["y"] + box["height"] <= page.viewport_size["height"]
    page.keyboard.press("Escape")
    window.settings().get_by_role("button", name="light", exact=True).click()
    page.get_by_role("button", name="Paste scene").click()
    page.locator(".changes summary").click()
    assert violations(page) == [], "the settings"
    # The system's colours: line and place of the playback are not of the ground's.
    page.emulate_media(forced_colors="active", reduced_motion="reduce")
    ground, line, place = page.evaluate(
        """() => {
          const color = (part, pseudo) => getComputedStyle(part, pseudo).backgroundColor;
          const [line, , place] = document.querySelectorAll('#transport i');
          return [color(document.querySelector('#transport')), color(line), color(place, '::before')];
        }"""
    )
    page.emulate_media(forced_colors="none", reduced_motion="reduce")
    assert ground not in (line, place)


def fits(made: Visit) -> None:
    """What opened beside the picture is no wider than the page, and fingers hit what is in it."""
    sheet = made.page.locator(".sheet")
    sheet.get_by_role("heading", level=2).wait_for()
    sheet.get_by_role("heading", level=3).first.wait_for()
    box = sheet.bounding_box() or {}
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= wide(made)
    assert made.page.evaluate("() => document.querySelector('.sheet').scrollWidth") <= box["width"]
    small = [one for one in made.page.evaluate(TARGETS) if one[2] < FINGER - 1]
    inside = {one.strip()[:40] for one in sheet.locator("button, select").all_inner_texts()}
    assert [one for one in small if one[0] in inside] == []


def closed(made: Visit) -> None:
    made.page.locator(".sheet").get_by_role("button", name="Close").press("Escape")
    made.page.locator(".sheet").wait_for(state="detached")
    made.page.wait_for_function("() => !location.hash.includes('open=')")


def test_what_opens_beside_the_picture_fits_closes_and_axe_finds_nothing(window: Visit) -> None:
    """By its address. The stage is dark in both themes; what axe finds is the same beside the picture and over it."""
    page, phone = window.page, wide(window) == PHONE[0]
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    window.start_again(link(open="plan"))
    fits(window)
    for tab in ("Passes", "Effects", "GLSL", "Changes"):
        page.locator(".sheet").get_by_role("button", name=tab, exact=True).click()
        assert not phone or violations(page) == [], f"the plan's {tab}"
    closed(window)
    window.follow(link(open="take"))
    page.locator("[data-surface=take] pre").first.wait_for()
    fits(window)
    assert not phone or violations(page) == [], "take home"
    closed(window)
    awaited(page)
    page.get_by_role("button", name="Accuracy benchmark").click()
    page.locator("#accuracy.open").wait_for()
    assert violations(page) == [], "accuracy"
    if not phone:
        page.locator("#tools button").first.evaluate(
            "(one) => ['aria-label', 'title'].forEach((n) => one.removeAttribute(n))"
        )
        assert [rule for rule, _ in violations(page)] == ["button-name"], "axe finds something"
    page.keyboard.press("Escape")
