"""The page as a visitor meets it: its picture, stills, presets, looks side by side, masks and panel."""

import re
from itertools import combinations

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from support.browser.lanes import Lane, rendered
from support.browser.visits import BLANK, DESKTOP, PHONE, SMALL, Held, Visit, differs, drag, link, pixels_of, visit
from support.scenes import load_preset, preset_names


def overlap(a: dict[str, float], b: dict[str, float]) -> bool:
    return (
        a["x"] < b["x"] + b["width"]
        and b["x"] < a["x"] + a["width"]
        and a["y"] < b["y"] + b["height"]
        and b["y"] < a["y"] + a["height"]
    )


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
        urls = [url for _, url in made.asked]
        assert [url for url in urls if not url.startswith((server, f"blob:{server}", "data:"))] == []
        assert [url for url in urls if "/api/frames" in url] == [], "nothing is drawn for a visitor who arrives"
        assert made.plans() == 1
        assert made.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
        parts = ("#title", "#summary", "#tools", "#gallery", "#transport")
        boxes = {name: made.page.locator(name).bounding_box() or {} for name in parts}
        for name in set(parts) - {"#gallery"}:
            assert boxes[name]["x"] >= 0, name
            assert boxes[name]["x"] + boxes[name]["width"] <= size[0], name
        assert [pair for pair in combinations(parts, 2) if overlap(*(boxes[name] for name in pair))] == []
        # The sea is seen first.
        assert not made.page.locator("#settings").is_visible()


@pytest.mark.parametrize("fragment", ["", "#paused=1", "#preset=paper-halftone", "#quality=fast&paused=1"])
def test_a_still_comes_first_and_the_water_takes_its_place(llvmpipe: Lane, server: str, fragment: str) -> None:
    """The server's own picture of the start stands until the live water, of the same moment, is there."""
    name = "paper-halftone" if "preset" in fragment else preset_names()[0]
    preset = load_preset(name)
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        page, held = made.page, Held(made.page, re.compile(r"/api/plans"))
        page.goto(f"{server}/{fragment}", wait_until="load")
        page.wait_for_function("() => window.seafoam !== undefined && document.querySelector('#still').complete")
        assert page.locator("#still").is_visible()
        assert (page.locator("#still").get_attribute("src") or "").endswith(f"/{name}.avif")
        assert not page.locator("#loading").is_visible()
        page.wait_for_timeout(300)
        # The heading's shade reaches far down in a window this small, and the hint far up.
        page.evaluate("() => document.querySelectorAll('#heading, .hint').forEach((part) => { part.hidden = true; })")
        shot = pixels_of(page.screenshot())
        assert made.state()["time"] == preset.time, "time waits for the water"
        page.wait_for_function("() => window.seafoam.state().busy")
        held.arrived()
        held.let_go()
        page.evaluate("() => window.seafoam.ready")
        page.wait_for_function("() => document.querySelector('#still').hidden", timeout=10_000)
        water = rendered(page, name, time=preset.time, size=SMALL)[..., :3]
        # Where nothing of the page covers it; softened, since one sample a pixel is not four.
        middle = slice(int(0.45 * SMALL[1]), int(0.66 * SMALL[1]))
        soft = [
            np.asarray(Image.fromarray(part[middle]).resize((95, 16), Image.Resampling.BOX), float)
            for part in (shot, water)
        ]
        assert np.abs(soft[0] - soft[1]).mean() < 6.0, "the water is not where the still had it"


@pytest.mark.parametrize(
    "fragment",
    ["#time=3.5", "#camera=0,9,0,0.5,-0.3,0,0.9", "#scene={%22/light/exposure%22:-1}", "#preset=no-such-sea"],
)
def test_no_still_of_what_was_not_asked_for(llvmpipe: Lane, server: str, fragment: str) -> None:
    with visit(llvmpipe, server, BLANK, size=(400, 300), settle=False) as made:
        made.expected = "ERR_FAILED"
        made.page.route(re.compile(r"/api/presets"), lambda route: route.abort())
        made.page.goto(f"{server}/{fragment}", wait_until="load")
        made.page.wait_for_timeout(200)
        assert made.page.evaluate("() => document.documentElement.classList.contains('still')") is False
        assert made.page.locator("#loading").is_visible()


def test_the_canvas_shows_what_the_plan_draws(small: Visit) -> None:
    for time in (0.0, 12.5):
        small.follow(link(time=time))
        want = rendered(small.page, "default", time=time, size=SMALL, quality="fast")[..., :3]
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


def test_two_looks_side_by_side(small: Visit) -> None:
    width = SMALL[0]
    whole = {}
    for look in ("textured", "halftone"):
        small.follow(link(scene={"/foam/look": look}))
        whole[look] = small.picture()
    assert differs(whole["textured"], whole["halftone"]) > 0.1

    small.press("Compare side by side")
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
    handle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    drag(small.page, handle, (width * 0.3, box["y"] + 5))
    assert check() == pytest.approx(0.3, abs=0.01)
    small.page.locator("#split-view .handle").press("ArrowRight")
    assert check() == pytest.approx(0.32, abs=0.01)
    assert small.plans() == asked
    small.press("Compare side by side")
    assert not small.page.locator("#split-view").is_visible()
    assert (small.picture() == whole["halftone"]).all(), "the scene's own look is the right one's"


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
        keyboard = made.page.keyboard
        drag(made.page, (200, 150), (200, 20), button="right")
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
