"""The gallery: addresses, search, list, keys; and the hint of the whole page."""

from typing import Any

from playwright.sync_api import Page, expect

from support.browser.lanes import Lane
from support.browser.visits import Visit, differs, drag, link, visit
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
        page.goto(f"{server}/water/paper-halftone#paused=1&quality=fast")
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
        made.follow(link(time=7))
        chosen(page, "paper-halftone")
        assert made.state()["time"] == 7
        page.wait_for_function(
            "() => location.pathname === '/water/paper-halftone' && !location.hash.includes('preset')"
        )


def test_presets_are_listed_and_chosen(small: Visit, server: str) -> None:
    """The path changes with the choice, the addresses of stills, thumbnails and links do not."""
    page, before = small.page, small.picture()
    listed = page.request.get(f"{server}/api/presets").json()
    options = page.locator("#gallery [role=option]")
    assert options.all_text_contents() == [preset["title"] for preset in listed]
    chosen = listed[-1]
    options.last.click()
    page.wait_for_function("(title) => document.querySelector('#title').textContent === title", arg=chosen["title"])
    small.settle()
    assert small.state()["preset"] == chosen["name"]
    assert page.locator("#summary").text_content() == chosen["summary"]
    assert options.last.get_attribute("aria-selected") == "true"
    assert page.locator("#gallery [aria-selected=true]").count() == 1
    assert differs(small.picture(), before) > 0.5
    page.wait_for_function("(path) => location.pathname === path", arg=f"/water/{chosen['name']}")
    page.locator("#gallery [data-preset=paper-height]").click()
    small.settle()
    files = [url for _, url in small.asked if "/stills/" in url]
    assert f"{server}/stills/{chosen['name']}.avif" in files
    assert {url.rsplit("/", 1)[0] for url in files} == {f"{server}/stills"}
    assert options.evaluate_all("(all) => all.map((one) => one.href)") == [
        f"{server}/water/{name}" for name in preset_names()
    ]


def test_waters_are_found_by_words(small: Visit) -> None:
    page = small.page
    page.locator("#canvas").press("/")
    search = page.get_by_label("Search waters")
    expect(search).to_be_focused()
    links = page.locator(".waters li a")
    assert links.count() == len(preset_names())
    summaries = page.locator(".waters li span").all_text_contents()
    assert {load_preset(name).summary for name in preset_names()} <= set(summaries)
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
    search.fill("figure 2")
    name = (links.first.get_attribute("href") or "").rsplit("/", 1)[1]
    search.press("Enter")
    chosen(page, name)
    expect(page.locator(".waters")).to_have_count(0)
    small.settle()


def test_the_strip_goes_by_keys(small: Visit) -> None:
    page, names = small.page, preset_names()
    strip = page.locator("#gallery .strip")
    # One thumbnail is in the order of the tab key: the chosen one.
    expect(strip.locator("[tabindex='0']")).to_have_attribute("data-preset", "paper-halftone")
    strip.locator("[tabindex='0']").focus()
    for key, name in (("Home", names[0]), ("ArrowRight", names[1]), ("End", names[-1]), ("ArrowLeft", names[-2])):
        page.keyboard.press(key)
        assert page.evaluate("() => document.activeElement.dataset.preset") == name
    page.keyboard.press("Enter")
    chosen(page, names[-2])
    small.settle()


def test_f_fills_the_screen(small: Visit) -> None:
    page = small.page
    page.locator("#canvas").press("f")
    page.wait_for_function("() => document.fullscreenElement !== null")
    page.get_by_role("button", name="Full screen (F)").click()
    page.wait_for_function("() => document.fullscreenElement === null")
    small.settle()


def hints(page: Page) -> Any:
    return page.locator(".hint:not(.gone)").all_text_contents()


def test_a_sharp_screens_png_is_as_sharp_and_a_hint_goes_with_the_first_move_or_after_half_a_minute(
    llvmpipe: Lane, server: str
) -> None:
    with visit(llvmpipe, server, link(time=3.25), size=(400, 300), device_scale_factor=2) as made:
        page = made.page
        assert "Touch the water" in hints(page)[0]
        drag(page, (200, 130))
        assert hints(page) == []
        expect(page.locator(".hint")).to_have_count(0)
        pixels, name = made.saved()
        assert pixels.shape == (600, 800, 3)
        assert pixels.std() > 5.0
        assert name == "seafoam-paper-halftone-3.25s.png"
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
