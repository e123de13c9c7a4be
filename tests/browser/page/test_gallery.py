"""The gallery: addresses, search, list, keys; and what the page says and saves of a picture."""

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
    """The path changes with the choice, the addresses of stills and thumbnails do not."""
    page, before = small.page, small.picture()
    listed = page.request.get(f"{server}/api/presets").json()
    options = page.locator("#gallery [role=option]")
    assert options.all_text_contents() == [preset["title"] for preset in listed]
    addresses = options.evaluate_all("(all) => all.map((one) => one.href)")
    assert addresses == [f"{server}/water/{preset['name']}" for preset in listed]
    last = listed[-1]
    options.last.click()
    chosen(page, last["name"])
    page.wait_for_function("(path) => location.pathname === path", arg=f"/water/{last['name']}")
    small.settle()
    assert page.locator("#title").text_content() == last["title"]
    assert page.locator("#summary").text_content() == last["summary"]
    assert page.locator("#gallery [aria-selected=true]").count() == 1
    assert options.last.get_attribute("aria-selected") == "true"
    assert differs(small.picture(), before) > 0.5
    page.locator("#gallery [data-preset=paper-height]").click()
    small.settle()
    files = [url for _, url in small.asked if "/stills/" in url]
    assert {url.rsplit("/", 1)[0] for url in files} == {f"{server}/stills"}


def test_waters_are_found_by_words_and_keys(small: Visit) -> None:
    page, strip = small.page, small.page.locator("#gallery .strip")
    page.locator("#canvas").press("/")
    search = page.get_by_label("Search waters")
    expect(search).to_be_focused()
    links = page.locator(".waters li a")
    assert links.count() == len(preset_names())
    search.fill("caustics pool")
    expect(links).to_have_count(1)
    expect(page.locator(".waters output")).to_have_text("1 water")
    page.keyboard.press("Escape")
    expect(page.locator(".waters")).to_have_count(0)
    button = page.get_by_role("button", name="Search and list all waters")
    expect(button).to_be_focused()
    page.keyboard.press("Enter")
    search.fill("figure 2")
    search.press("ArrowDown")
    expect(links.first).to_be_focused()
    page.keyboard.press("ArrowUp")
    name = (links.first.get_attribute("href") or "").rsplit("/", 1)[1]
    search.press("Enter")
    chosen(page, name)
    expect(page.locator(".waters")).to_have_count(0)
    # Of the strip one thumbnail is in the order of the tab key: the chosen one.
    expect(strip.locator("[tabindex='0']")).to_have_attribute("data-preset", name)
    strip.locator("[tabindex='0']").focus()
    page.keyboard.press("End")
    assert page.evaluate("() => document.activeElement.dataset.preset") == preset_names()[-1]
    page.locator("#canvas").press("f")
    page.wait_for_function("() => document.fullscreenElement !== null")
    page.get_by_role("button", name="Full screen (F)").click()
    page.wait_for_function("() => document.fullscreenElement === null")
    small.settle()


def test_a_sharp_screens_png_is_as_sharp_and_a_hint_goes_with_the_first_move(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, link(time=3.25), size=(400, 300), device_scale_factor=2) as made:
        hint = made.page.locator(".hint")
        expect(hint).to_contain_text("Touch the water")
        drag(made.page, (200, 130))
        expect(hint).to_have_count(0)
        pixels, name = made.saved()
        assert pixels.shape == (600, 800, 3)
        assert pixels.std() > 5.0
        assert name == "seafoam-paper-halftone-3.25s.png"
