"""The gallery: addresses, search, list, keys, layout; and the keys and the hint of the whole page."""

from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from support.browser.lanes import Lane
from support.browser.visits import BLANK, DESKTOP, PHONE, STILL, Visit, drag, link, pixels_of, visit
from support.scenes import load_preset, preset_names

BOXES = """(selector) => [...document.querySelectorAll(selector)].map((one) => {
  const { x, y, width, height } = one.getBoundingClientRect();
  return [x, y, width, height]; })"""


def chosen(page: Page, name: str) -> None:
    """Wait until a preset is the page's own."""
    page.wait_for_function("(name) => window.seafoam.state().preset === name", arg=name)


def test_an_address_of_its_own_opens_a_water(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, f"water/lake-calm{STILL}") as made:
        assert made.state()["preset"] == "lake-calm"
        assert made.page.locator("#title").text_content() == load_preset("lake-calm").title
        assert made.page.title() == f"{load_preset('lake-calm').title} · Seafoam"
        made.page.locator("#gallery [data-preset=swell]").click()
        chosen(made.page, "swell")
        made.page.wait_for_function("() => location.pathname === '/water/swell'")
        made.page.go_back()
        chosen(made.page, "lake-calm")
        made.page.wait_for_function("() => location.pathname === '/water/lake-calm'")
        made.page.go_forward()
        chosen(made.page, "swell")
        # A link as it was before presets had addresses.
        made.follow(link(preset="lake-calm", time=7))
        chosen(made.page, "lake-calm")
        assert made.state()["time"] == 7
        made.page.wait_for_function(
            "() => location.pathname === '/water/lake-calm' && !location.hash.includes('preset')"
        )


def test_a_choice_on_the_first_page_has_its_still_and_its_thumbnails(small: Visit, server: str) -> None:
    """The path changes with the choice, the addresses of files do not."""
    small.page.locator("#gallery [role=option]").last.scroll_into_view_if_needed()
    small.page.locator("#gallery [data-preset=swell]").click()
    small.settle()
    small.page.locator("#gallery [data-preset=storm]").click()
    small.settle()
    files = [url for _, url in small.asked if "/stills/" in url]
    assert f"{server}/stills/storm.avif" in files
    assert {url.rsplit("/", 1)[0] for url in files} == {f"{server}/stills"}
    links = small.page.locator("#gallery [role=option]").evaluate_all("(all) => all.map((one) => one.href)")
    assert links == [f"{server}/water/{name}" for name in preset_names()]


def test_an_unknown_address_is_told(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "water/atlantis", settle=False) as made:
        made.expected = "404"
        assert "atlantis" in (made.page.get_by_role("heading").text_content() or "")
        made.page.get_by_role("link", name="Open Seafoam").click()
        made.begin()
        chosen(made.page, "default")


def test_waters_are_found_by_words(small: Visit) -> None:
    page = small.page
    page.locator("#canvas").press("/")
    search = page.get_by_label("Search waters")
    expect(search).to_be_focused()
    links = page.locator(".waters li a")
    assert links.count() == len(preset_names())
    for name in preset_names():
        assert page.locator(".waters li span", has_text=load_preset(name).summary).count() >= 1
    search.fill("caustics pool")
    expect(links).to_have_count(1)
    expect(page.locator(".waters output")).to_have_text("1 water")
    search.fill("no such water")
    expect(links).to_have_count(0)
    expect(page.get_by_text("No water has all of these words.")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.locator(".waters")).to_have_count(0)
    expect(page.get_by_role("button", name="Search and list all waters")).to_be_focused()
    # Once more, by its button; down the list and back, and a choice.
    page.keyboard.press("Enter")
    search.fill("lake")
    found = links.count()
    assert found > 2
    search.press("ArrowDown")
    expect(links.first).to_be_focused()
    page.keyboard.press("End")
    expect(links.nth(found - 1)).to_be_focused()
    page.keyboard.press("Home")
    page.keyboard.press("ArrowUp")
    expect(search).to_be_focused()
    search.fill("storm at")
    name = (links.first.get_attribute("href") or "").rsplit("/", 1)[1]
    search.press("Enter")
    chosen(page, name)
    expect(page.locator(".waters")).to_have_count(0)
    small.settle()


def test_the_strip_goes_by_keys(small: Visit) -> None:
    page, names = small.page, preset_names()
    strip = page.locator("#gallery .strip")
    # One thumbnail is in the order of the tab key: the chosen one.
    expect(strip.locator("[tabindex='0']")).to_have_attribute("data-preset", "default")
    strip.locator("[tabindex='0']").focus()
    for key, name in (("End", names[-1]), ("ArrowLeft", names[-2]), ("Home", names[0]), ("ArrowRight", names[1])):
        page.keyboard.press(key)
        assert page.evaluate("() => document.activeElement.dataset.preset") == name
    page.keyboard.press("Enter")
    chosen(page, names[1])
    small.settle()


def test_time_steps_by_frames_and_is_typed_exactly(small: Visit) -> None:
    page = small.page
    small.follow(link(time=1))
    page.locator("#canvas").press(".")
    assert small.state()["time"] == 61 / 60
    page.keyboard.press(",")
    page.keyboard.press(",")
    assert small.state()["time"] == 59 / 60
    moment = page.get_by_label("Time in seconds")
    moment.focus()
    assert float(moment.input_value()) == 59 / 60, "the field shows every digit while it is edited"
    # In the field these keys are text.
    moment.fill("")
    moment.type("4.25")
    moment.press("Enter")
    assert small.state()["time"] == 4.25
    assert moment.input_value() == "4.25"
    page.get_by_role("button", name="Play").click()
    page.locator("#canvas").press(".")
    assert small.state()["playing"] is False


def test_f_fills_the_screen(small: Visit) -> None:
    page = small.page
    page.locator("#canvas").press("f")
    page.wait_for_function("() => document.fullscreenElement !== null")
    page.get_by_role("button", name="Full screen (F)").click()
    page.wait_for_function("() => document.fullscreenElement === null")
    small.settle()


def hints(page: Page) -> Any:
    return page.locator(".hint:not(.gone)").all_text_contents()


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_nothing_of_the_gallery_overlaps_and_the_heading_is_type_alone(
    llvmpipe: Lane, server: str, size: tuple[int, int]
) -> None:
    """No box and no shade of the heading lie over the sky: without its words a white page is white."""
    with visit(llvmpipe, server, size=size) as made:
        left, _, width, _ = np.array(made.page.evaluate(BOXES, "#gallery [role=option]")).T
        assert len(left) == len(preset_names())
        assert (left[1:] >= left[:-1] + width[:-1] + 8).all()
        left, _, width, _ = np.array(made.page.evaluate(BOXES, "#gallery [role=group]")).T
        assert (left[1:] >= left[:-1] + width[:-1]).all()
        made.page.keyboard.press("/")
        box = made.page.locator(".waters").bounding_box() or {}
        assert min(box["x"], box["y"]) >= 0
        assert box["x"] + box["width"] <= size[0]
        assert box["y"] + box["height"] <= size[1]
        made.page.keyboard.press("Escape")
        made.page.add_style_tag(
            content="body > :not(#heading), #heading > * { visibility: hidden } html, body { background: #fff }"
        )
        assert (pixels_of(made.page.screenshot()) == 255).all()


def test_a_hint_goes_with_the_first_move_or_after_half_a_minute(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server) as made:
        assert "Touch the water" in hints(made.page)[0]
        drag(made.page, (200, 200))
        assert hints(made.page) == []
        expect(made.page.locator(".hint")).to_have_count(0)
    with visit(llvmpipe, server, BLANK, size=(400, 300), settle=False) as made:
        made.page.clock.install()
        made.page.goto(f"{server}/{STILL}", wait_until="load")
        for _ in range(600):
            made.page.clock.run_for(50)
            if hints(made.page):
                break
        made.page.clock.run_for(29_000)
        assert len(hints(made.page)) == 1
        made.page.clock.run_for(1_100)
        assert hints(made.page) == []
