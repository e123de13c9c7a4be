"""The page in two windows: all of it in sight, nothing over anything else, and what axe finds wrong for people who use
a keyboard or a screen reader."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
import pytest

from support.browser.accuracy_answers import awaited
from support.browser.axe import violations
from support.browser.lanes import Lane
from support.browser.visits import DESKTOP, FINGER, PHONE, TARGETS, Visit, link, pixels_of, visit
from support.scenes import load_preset, preset_names

BOXES = """(selector) => [...document.querySelectorAll(selector)].map((one) => {
  const { x, y, width, height } = one.getBoundingClientRect();
  return [x, y, width, height]; })"""
PARTS = ("#title", "#summary", "#tools", "#gallery", "#transport")
BARE = "body > :not(#heading), #heading > * { visibility: hidden } html, body { background: #fff }"


@pytest.fixture(scope="module", params=[DESKTOP, PHONE], ids=["desktop", "phone"])
def window(llvmpipe: Lane, server: str, request: pytest.FixtureRequest) -> Iterator[Visit]:
    """The page in one of the windows, as its tests leave it."""
    with visit(llvmpipe, server, "#paused=1", size=request.param, reduced_motion="reduce") as made:
        yield made


def overlap(a: dict[str, float], b: dict[str, float]) -> bool:
    return (
        a["x"] < b["x"] + b["width"]
        and b["x"] < a["x"] + a["width"]
        and a["y"] < b["y"] + b["height"]
        and b["y"] < a["y"] + a["height"]
    )


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
    assert page.locator("#title").text_content() == load_preset("default").title
    urls = [url for _, url in window.asked]
    assert [url for url in urls if not url.startswith((server, f"blob:{server}", "data:"))] == []
    assert [url for url in urls if "/api/frames" in url] == [], "nothing is drawn for a visitor who arrives"
    assert window.plans() == 1
    assert page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    boxes = {name: page.locator(name).bounding_box() or {} for name in PARTS}
    for name in set(PARTS) - {"#gallery"}:
        assert boxes[name]["x"] >= 0, name
        assert boxes[name]["x"] + boxes[name]["width"] <= wide(window), name
    assert [pair for pair in combinations(PARTS, 2) if overlap(*(boxes[name] for name in pair))] == []
    # The sea is seen first.
    assert not page.locator("#settings").is_visible()


def test_nothing_of_the_gallery_overlaps_and_the_heading_is_type_alone(window: Visit) -> None:
    """No box and no shade of the heading lie over the sky: without its words a white page is white."""
    page = window.page
    left, _, width, _ = np.array(page.evaluate(BOXES, "#gallery [role=option]")).T
    assert len(left) == len(preset_names())
    assert (left[1:] >= left[:-1] + width[:-1] + 8).all()
    left, _, width, _ = np.array(page.evaluate(BOXES, "#gallery [role=group]")).T
    assert (left[1:] >= left[:-1] + width[:-1]).all()
    page.keyboard.press("/")
    box = page.locator(".waters").bounding_box() or {}
    assert min(box["x"], box["y"]) >= 0
    assert box["x"] + box["width"] <= wide(window)
    assert box["y"] + box["height"] <= page.viewport_size["height"]
    page.keyboard.press("Escape")
    style = page.add_style_tag(content=BARE)
    try:
        # Beside other tests a screenshot may show what was before the style.
        assert any((pixels_of(page.screenshot()) == 255).all() for _ in range(5))
    finally:
        style.evaluate("(style) => style.remove()")


def test_axe_finds_nothing(window: Visit) -> None:
    page = window.page
    # A cheap picture is enough from here on.
    window.start_again(link(preset="paper-halftone", scene={"/light/exposure": 1}))
    assert violations(page) == [], "the page"
    page.keyboard.press("/")
    page.locator(".waters").wait_for()
    assert violations(page) == [], "the list of waters"
    page.keyboard.press("Escape")
    window.settings().get_by_role("button", name="light", exact=True).click()
    page.get_by_role("button", name="Paste scene").click()
    page.locator(".changes summary").click()
    assert violations(page) == [], "the settings"


def test_forced_colours_leave_what_is_set_visible(window: Visit) -> None:
    """Colours of the system's: axe finds nothing, and line and place of the playback are not of the ground's colour."""
    page = window.page
    page.emulate_media(forced_colors="active", reduced_motion="reduce")
    window.settings()
    assert page.evaluate("matchMedia('(forced-colors: active)').matches")
    assert violations(page) == []
    ground, line, place = page.evaluate(
        """() => {
          const color = (part, pseudo) => getComputedStyle(part, pseudo).backgroundColor;
          const [line, , place] = document.querySelectorAll('#transport i');
          return [color(document.querySelector('#transport')), color(line), color(place, '::before')];
        }"""
    )
    assert ground not in (line, place)
    ranges = page.locator("#settings input[type=range]")
    assert ranges.first.evaluate("(one) => getComputedStyle(one).appearance") == "auto"
    page.emulate_media(forced_colors="none", reduced_motion="reduce")


def test_axe_would_find_something(window: Visit) -> None:
    button = window.page.locator("#tools button").first
    told = {name: said for name in ("aria-label", "title") if (said := button.get_attribute(name)) is not None}
    button.evaluate("(button, names) => names.forEach((name) => button.removeAttribute(name))", list(told))
    assert [rule for rule, _ in violations(window.page)] == ["button-name"]
    button.evaluate("(button, told) => Object.entries(told).forEach((each) => button.setAttribute(...each))", told)


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
    """By its address. The stage is dark in both themes."""
    page = window.page
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    window.start_again(link(preset="paper-threshold", open="plan"))
    fits(window)
    for tab in ("Passes", "Effects", "GLSL", "Changes"):
        page.locator(".sheet").get_by_role("button", name=tab, exact=True).click()
        assert violations(page) == [], f"the plan's {tab}"
    closed(window)
    window.follow(link(preset="paper-threshold", open="take"))
    page.locator("[data-surface=take] pre").first.wait_for()
    fits(window)
    assert violations(page) == [], "take home"
    closed(window)
    awaited(page)
    page.get_by_role("button", name="Accuracy benchmark").click()
    page.locator("#accuracy.open").wait_for()
    assert violations(page) == [], "accuracy"
