"""The page as a visitor meets it: stills, the picture, looks, masks, links."""

import re

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from support.browser.lanes import Lane, rendered
from support.browser.visits import BLANK, SMALL, Held, Visit, differs, drag, link, pixels_of, visit
from support.scenes import load_preset


def test_a_still_comes_first_and_the_water_takes_its_place(llvmpipe: Lane, server: str) -> None:
    """The server's own picture of the start stands until the live water, of the same moment, is there."""
    name = "paper-halftone"
    preset = load_preset(name)
    with visit(llvmpipe, server, BLANK, settle=False) as made:
        page, held = made.page, Held(made.page, re.compile(r"/api/plans"))
        page.goto(f"{server}/#preset={name}", wait_until="load")
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


def test_the_canvas_shows_what_the_plan_draws(small: Visit) -> None:
    for time in (0.0, 12.5):
        small.follow(link(time=time))
        want = rendered(small.page, "paper-halftone", time=time, size=SMALL, quality="fast")[..., :3]
        assert (small.picture() == want).all()
    # And on the screen, once it stands alone there.
    style = small.page.add_style_tag(content="body > :not(#stage) { display: none !important }")
    small.settle()
    at = int(0.4 * SMALL[1])
    shown = small.canvas()
    style.evaluate("(style) => style.remove()")
    assert (np.abs(shown.astype(int) - want[at : at + len(shown)]) <= 1).all()


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


def test_masks_come_from_the_server_and_an_unknown_one_is_told(small: Visit, server: str) -> None:
    listed = [mask["name"] for mask in small.page.request.get(f"{server}/api/masks").json()]
    choice = small.settings().get_by_label("mask", exact=True)
    # The panel stands before the list of masks has come.
    expect(choice.locator("option")).to_have_count(len(listed))
    # The name leads each text, before the mask's title.
    texts = choice.locator("option").all_text_contents()
    assert [text.split(" · ")[0] for text in texts] == listed
    before, asked = small.picture(), small.plans()
    choice.select_option(label=next(text for text in texts if text.startswith("vac-1.5")))
    chosen = small.picture()
    assert differs(chosen, before) > 0.05
    assert small.state()["changes"] == [["/foam/mask", "vac-1.5"]]
    assert small.plans() == asked + 1
    small.page.evaluate("(fragment) => { location.hash = fragment; }", link(scene={"/foam/mask": "no-such-mask"}))
    expect(small.page.locator(".toast.error")).to_contain_text("mask")
    assert (small.picture() == chosen).all()
    # The browser itself notes a refused request.
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    small.follow(link())
    assert (small.picture() == before).all()


def test_a_link_restores_everything(small: Visit, llvmpipe: Lane, server: str) -> None:
    page = small.page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    changes = {"/foam/mask_tile": 3.5, "/light/exposure": -0.75}
    small.follow(link(time=4.1234567890123, scene=changes))
    page.mouse.move(100, 140)
    page.mouse.wheel(0, -120)
    page.get_by_label("Speed", exact=True).select_option("0.5")
    small.press("Compare side by side")
    handle = page.locator("#split-view .handle")
    handle.wait_for()  # What is not in sight yet takes no key, and says nothing of it.
    handle.press("ArrowLeft")
    first = small.picture()
    small.press("Copy link to this view")
    page.get_by_text("Link copied").wait_for()
    address = page.evaluate("() => navigator.clipboard.readText()")
    state = small.state()
    assert address == page.url
    assert dict(state["changes"]) == changes
    assert state["split"]["at"] == pytest.approx(0.48)
    assert state["camera"]["position"] != list(load_preset("paper-halftone").scene.camera.position)
    with visit(llvmpipe, server, address.removeprefix(f"{server}/")) as made:
        second, again = made.picture(), made.state()
    for told in (state, again):
        del told["timing"], told["settled"]
    assert again == state
    assert (second == first).all()
