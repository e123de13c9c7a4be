"""The page as a visitor meets it: its picture, stills, presets, looks side by side, masks and panel."""

import io
import re
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page, expect

from support.browser.lanes import Lane, rendered
from support.browser.visits import DESKTOP, PHONE, SMALL, Visit, differs, link, visit
from support.scenes import load_preset, preset_names


def overlap(a: dict[str, float], b: dict[str, float]) -> bool:
    return (
        a["x"] < b["x"] + b["width"]
        and b["x"] < a["x"] + a["width"]
        and a["y"] < b["y"] + b["height"]
        and b["y"] < a["y"] + a["height"]
    )


# What is there


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_opens_whole(llvmpipe: Lane, server: str, size: tuple[int, int]) -> None:
    with visit(llvmpipe, server, "#paused=1", size=size) as made:
        assert llvmpipe.name in made.page.evaluate("() => window.seafoam.renderer")
        assert made.canvas().std() > 5.0, "a blank picture"
        images = made.page.locator("#gallery img")
        assert images.count() == len(preset_names())
        # Those in sight are there; the others come when they are scrolled to.
        loaded = "(images) => images.filter((image) => image.complete && image.naturalWidth > 0).length"
        assert 2 <= images.evaluate_all(loaded) < len(preset_names())
        images.last.scroll_into_view_if_needed()
        made.page.wait_for_function("() => [...document.querySelectorAll('#gallery img')].at(-1).naturalWidth > 0")
        assert made.page.locator("#title").text_content() == load_preset("default").title
        foreign = [url for _, url in made.asked if not url.startswith((server, f"blob:{server}", "data:"))]
        assert foreign == []
        assert [url for _, url in made.asked if "/api/frames" in url] == [], (
            "nothing is drawn for a visitor who arrives"
        )
        assert made.plans() == 1
        overflow = made.page.evaluate("() => document.documentElement.scrollWidth - innerWidth")
        assert overflow <= 0
        boxes = {
            name: made.page.locator(name).bounding_box()
            for name in ("#title", "#summary", "#tools", "#gallery", "#transport")
        }
        for name, box in boxes.items():
            assert box is not None, name
            if name != "#gallery":
                assert box["x"] >= 0, name
                assert box["x"] + box["width"] <= size[0], name
        crossing = [(a, b) for a in boxes for b in boxes if a < b and overlap(boxes[a], boxes[b])]  # type: ignore[arg-type]
        assert crossing == []
        # The sea is seen first.
        assert not made.page.locator("#settings").is_visible()


def still_shown(page: Page) -> str:
    """Name of the still that the page shows; empty: none."""
    shown: str = page.evaluate(
        "() => { const still = document.querySelector('#still');"
        " return still.hidden ? '' : still.src.replace(/.*\\/|[.]avif$/g, ''); }"
    )
    return shown


@pytest.mark.parametrize("fragment", ["", "#paused=1", "#preset=paper-halftone", "#quality=draft&paused=1"])
def test_a_still_comes_first_and_the_water_takes_its_place(llvmpipe: Lane, server: str, fragment: str) -> None:
    """The server's own picture of the start stands until the live water, of the same moment, is there."""
    name = "paper-halftone" if "preset" in fragment else preset_names()[0]
    preset = load_preset(name)
    opened = llvmpipe.browser.new_context(viewport={"width": SMALL[0], "height": SMALL[1]})
    page = opened.new_page()
    waiting: list[Any] = []
    page.route(re.compile(r"/api/plans"), lambda route: waiting.append(route))
    try:
        page.goto(f"{server}/{fragment}", wait_until="load")
        page.wait_for_function("() => window.seafoam !== undefined && document.querySelector('#still').complete")
        assert still_shown(page) == name
        assert not page.locator("#loading").is_visible()
        page.wait_for_timeout(300)
        # The heading's shade reaches far down in a window this small, and the hint far up.
        page.evaluate("() => document.querySelectorAll('#heading, .hint').forEach((part) => { part.hidden = true; })")
        shot = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"), float)
        assert page.evaluate("() => window.seafoam.state().time") == preset.time, "time waits for the water"
        page.wait_for_function("() => window.seafoam.state().busy")
        while not waiting:
            page.wait_for_timeout(20)
        for route in waiting:
            route.continue_()
        page.unroute_all()
        page.evaluate("() => window.seafoam.ready")
        page.wait_for_function("() => document.querySelector('#still').hidden", timeout=10_000)
        water = rendered(page, name, time=preset.time, size=SMALL)[..., :3]
        # Where nothing of the page covers it; softened, since one sample a pixel is not four.
        middle = slice(int(0.45 * SMALL[1]), int(0.66 * SMALL[1]))
        soft = [
            np.asarray(Image.fromarray(part.astype(np.uint8)).resize((95, 16), Image.Resampling.BOX), float)
            for part in (shot[middle], water[middle])
        ]
        assert np.abs(soft[0] - soft[1]).mean() < 6.0, "the water is not where the still had it"
    finally:
        opened.close()


@pytest.mark.parametrize(
    "fragment",
    ["#time=3.5", "#camera=0,9,0,0.5,-0.3,0,0.9", "#scene={%22/light/exposure%22:-1}", "#preset=no-such-sea"],
)
def test_no_still_of_what_was_not_asked_for(llvmpipe: Lane, server: str, fragment: str) -> None:
    opened = llvmpipe.browser.new_context(viewport={"width": 400, "height": 300})
    page = opened.new_page()
    page.route(re.compile(r"/api/presets"), lambda route: route.abort())
    try:
        page.goto(f"{server}/{fragment}", wait_until="load")
        page.wait_for_timeout(200)
        assert page.evaluate("() => document.documentElement.classList.contains('still')") is False
        assert page.locator("#loading").is_visible()
    finally:
        opened.close()


def test_the_canvas_shows_what_the_plan_draws(small: Visit) -> None:
    for time in (0.0, 12.5):
        small.follow(link(time=time))
        want = rendered(small.page, "default", time=time, size=SMALL, quality="draft")[..., :3]
        assert (small.picture() == want).all()
    # And on the screen, once it stands alone there.
    style = small.page.add_style_tag(content="body > :not(#stage) { display: none !important }")
    small.settle()
    at = int(0.4 * SMALL[1])
    shown = small.canvas()
    style.evaluate("(style) => style.remove()")
    assert (np.abs(shown.astype(int) - want[at : at + len(shown)]) <= 1).all()


def test_presets_are_listed_and_chosen(small: Visit, server: str) -> None:
    listed = small.page.request.get(f"{server}/api/presets").json()
    options = small.page.locator("#gallery [role=option]")
    assert options.all_text_contents() == [preset["title"] for preset in listed]
    chosen = listed[-1]
    before = small.picture()
    options.last.click()
    small.page.wait_for_function(
        "(title) => document.querySelector('#title').textContent === title", arg=chosen["title"]
    )
    small.settle()
    assert small.state()["preset"] == chosen["name"]
    assert small.page.locator("#summary").text_content() == chosen["summary"]
    assert options.last.get_attribute("aria-selected") == "true"
    assert small.page.locator("#gallery [aria-selected=true]").count() == 1
    assert differs(small.picture(), before) > 0.5
    small.page.wait_for_function("(path) => location.pathname === path", arg=f"/water/{chosen['name']}")


# Two looks side by side


def test_two_looks_side_by_side(small: Visit) -> None:
    width = SMALL[0]
    whole = {}
    for look in ("textured", "halftone"):
        small.follow(link(scene={"/foam/look": look}))
        whole[look] = small.picture()
    assert differs(whole["textured"], whole["halftone"]) > 0.1

    small.page.get_by_role("button", name="Compare side by side").click()
    small.page.get_by_label("Compared field").select_option("/foam/look")
    small.page.get_by_label("Left value").select_option("textured")
    small.page.get_by_label("Right value").select_option("halftone")
    assert small.page.locator("#split-view .handle").get_attribute("aria-valuenow") == "50"

    def check() -> float:
        at: float = small.state()["split"]["at"]
        x = round(width * at)
        both = small.picture()
        assert (both[:, :x] == whole["textured"][:, :x]).all()
        assert (both[:, x:] == whole["halftone"][:, x:]).all()
        return at

    assert check() == 0.5
    asked = small.plans()
    box = small.page.locator("#split-view .handle").bounding_box()
    assert box is not None
    small.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    small.page.mouse.down()
    small.page.mouse.move(width * 0.3, box["y"] + 5, steps=4)
    small.page.mouse.up()
    assert check() == pytest.approx(0.3, abs=0.01)
    small.page.locator("#split-view .handle").press("ArrowRight")
    assert check() == pytest.approx(0.32, abs=0.01)
    assert small.plans() == asked
    small.page.get_by_role("button", name="Compare side by side").click()
    assert not small.page.locator("#split-view").is_visible()
    assert (small.picture() == whole["halftone"]).all(), "the scene's own look is the right one's"


# Masks


def test_masks_come_from_the_server(small: Visit, server: str) -> None:
    listed = [mask["name"] for mask in small.page.request.get(f"{server}/api/masks").json()]
    choice = small.settings().get_by_label("mask", exact=True)
    # The panel stands before the list of masks has come.
    expect(choice.locator("option")).to_have_count(len(listed))
    # The name leads each text, before the mask's title.
    texts = choice.locator("option").all_text_contents()
    assert [text.split(" · ")[0] for text in texts] == listed
    # A moment at which foam covers much of the view.
    small.follow(link(time=13.0))
    before, asked = small.picture(), small.plans()
    choice.select_option(label=next(text for text in texts if text.startswith("vac-1.5")))
    assert differs(small.picture(), before) > 0.05
    assert small.state()["changes"] == [["/foam/mask", "vac-1.5"]]
    assert small.plans() == asked + 1


def test_a_visitor_dives(llvmpipe: Lane, server: str) -> None:
    """Down through the surface by key, once that is compiled; an orbit alone stays over it."""
    bright = link(preset="lake-calm", scene={"/light/exposure": 1.0})
    with visit(llvmpipe, server, bright, size=(400, 300), reduced_motion="reduce") as made:
        over = made.picture()
        mouse, keyboard = made.page.mouse, made.page.keyboard
        mouse.move(200, 150)
        mouse.down(button="right")
        mouse.move(200, 20, steps=4)
        mouse.up(button="right")
        made.frames(6)
        assert made.state()["camera"]["position"][1] > 0.0
        made.page.locator("#canvas").focus()
        keyboard.down("q")
        made.page.wait_for_function("() => window.seafoam.state().camera.position[1] < -0.4", timeout=60_000)
        keyboard.up("q")
        made.frames(3)
        under = made.picture()
        assert differs(under, over) > 0.9
        assert np.ptp(under.astype(int), axis=(0, 1)).max() > 8, "nothing to see"
        made.settings()
        served, _ = made.saved("Render on server")
        assert differs(served, under) < 1e-3


# The panel


def test_fields_keep_to_the_ranges_of_the_schema(small: Visit, server: str) -> None:
    schemas = small.page.request.get(f"{server}/openapi.json").json()["components"]["schemas"]

    def bounds(model: str, name: str) -> tuple[float, float]:
        said = schemas[model]["properties"][name]
        return said["minimum"], said["maximum"]

    def held(pointer: str) -> Any:
        return dict(small.state()["changes"])[pointer]

    degrees = np.pi / 180
    for model, name, folder, pointer, unit in (
        ("Light", "exposure", "light", "/light/exposure", 1.0),
        ("Light", "turbidity", "light", "/light/turbidity", 1.0),
        ("Light", "sun_elevation", "light", "/light/sun_elevation", degrees),
        ("Foam", "albedo", "foam", "/foam/albedo", 1.0),
        ("Foam", "fade", "foam", "/foam/fade", 1.0),
    ):
        label = name.replace("_", " ")
        for limit, beyond in zip(bounds(model, name), (-1e6, 1e6), strict=True):
            small.type(label, f"{beyond:.0f}", folder=folder)
            assert held(pointer) == pytest.approx(limit, abs=1e-4), f"{pointer} beyond {limit}"
            shown = float(small.settings().get_by_role("textbox", name=label, exact=True).input_value().rstrip("°"))
            assert shown == pytest.approx(limit / unit, rel=1e-3)
    # A range of many decades has a slider of its own, in decades.
    small.follow(link())
    least, most = bounds("Light", "visibility")
    row = small.settings().locator(".tp-lblv", has=small.page.get_by_role("textbox", name="visibility", exact=True))
    slider = row.locator("input.log")
    assert float(slider.get_attribute("min") or "nan") == pytest.approx(np.log10(least))
    assert float(slider.get_attribute("max") or "nan") == pytest.approx(np.log10(most))
    slider.fill(str(np.log10(least)))
    assert held("/light/visibility") == pytest.approx(least)
