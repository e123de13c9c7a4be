"""The gallery: addresses, search, list, keys; and the keys and the hint of the whole page."""

from typing import Any

from playwright.sync_api import Page, expect

from support.browser.lanes import Lane
from support.browser.visits import STILL, Visit, drag, link, visit
from support.scenes import load_preset, preset_names


def chosen(page: Page, name: str) -> None:
    """Wait until a preset is the page's own."""
    page.wait_for_function("(name) => window.seafoam.state().preset === name", arg=name)


def test_an_unknown_address_is_told_and_one_of_its_own_opens_a_water(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "water/atlantis", settle=False) as made:
        page = made.page
        made.expected = "404"
        assert "atlantis" in (page.get_by_role("heading").text_content() or "")
        page.get_by_role("link", name="Open Seafoam").click()
        made.begin()
        chosen(page, "default")
        page.goto(f"{server}/water/paper-halftone{STILL}")
        made.settle()
        assert made.state()["preset"] == "paper-halftone"
        title = load_preset("paper-halftone").title
        assert page.locator("#title").text_content() == title
        assert page.title() == f"{title} · Seafoam"
        page.locator("#gallery [data-preset=paper-height]").click()
        chosen(page, "paper-height")
        page.wait_for_function("() => location.pathname === '/water/paper-height'")
        page.go_back()
        chosen(page, "paper-halftone")
        page.wait_for_function("() => location.pathname === '/water/paper-halftone'")
        page.go_forward()
        chosen(page, "paper-height")
        # A link as it was before presets had addresses.
        made.follow(link(preset="paper-halftone", time=7))
        chosen(page, "paper-halftone")
        assert made.state()["time"] == 7
        page.wait_for_function(
            "() => location.pathname === '/water/paper-halftone' && !location.hash.includes('preset')"
        )


def test_a_choice_on_the_first_page_has_its_still_and_its_thumbnails(small: Visit, server: str) -> None:
    """The path changes with the choice, the addresses of files do not."""
    small.page.locator("#gallery [role=option]").last.scroll_into_view_if_needed()
    small.page.locator("#gallery [data-preset=paper-height]").click()
    small.settle()
    small.page.locator("#gallery [data-preset=paper-halftone]").click()
    small.settle()
    files = [url for _, url in small.asked if "/stills/" in url]
    assert f"{server}/stills/paper-halftone.avif" in files
    assert {url.rsplit("/", 1)[0] for url in files} == {f"{server}/stills"}
    links = small.page.locator("#gallery [role=option]").evaluate_all("(all) => all.map((one) => one.href)")
    assert links == [f"{server}/water/{name}" for name in preset_names()]


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


def test_a_hint_goes_with_the_first_move_or_after_half_a_minute(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, link(preset="paper-halftone")) as made:
        page = made.page
        assert "Touch the water" in hints(page)[0]
        drag(page, (200, 200))
        assert hints(page) == []
        expect(page.locator(".hint")).to_have_count(0)
        page.clock.install()
        page.reload(wait_until="load")
        for _ in range(600):
            page.clock.run_for(50)
            if hints(page):
                break
        page.clock.run_for(29_000)
        assert len(hints(page)) == 1
        page.clock.run_for(1_100)
        assert hints(page) == []
