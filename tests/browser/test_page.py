"""The page as a visitor meets it: what it shows, what moves it, what it asks the server for."""

import base64
import io
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Locator, Page, TimeoutError, expect

from seafoam.scene.presets import load_preset, preset_names
from support.browsers import Lane
from support.report import REPORT

DESKTOP = (1280, 800)
PHONE = (390, 844)
SMALL = (760, 500)
"""The desktop's layout on as few pixels as hold it: llvmpipe is slow."""
STILL = "#paused=1&quality=draft"
FINGER = 44
"""Least side of what a finger must hit, px."""

Pixels = NDArray[np.uint8]


@dataclass
class Visit:
    """A page, with all that it complained of and asked for."""

    page: Page
    complaints: list[str] = field(default_factory=list)
    asked: list[tuple[str, str]] = field(default_factory=list)
    """Method and address of every request."""
    followed: int = 0

    def settle(self) -> None:
        """Wait until the picture shows what was asked for, at rest and sharp."""
        try:
            self.page.wait_for_function("() => window.seafoam?.state().settled === true", timeout=60_000)
        except TimeoutError as error:
            state = self.page.evaluate("() => window.seafoam?.state()")
            raise AssertionError(
                f"never at rest: {state}, {self.complaints}, {self.page.inner_text('body')}"
            ) from error

    def state(self) -> dict[str, Any]:
        state: dict[str, Any] = self.page.evaluate("() => window.seafoam.state()")
        return state

    def plans(self) -> int:
        """How often a plan was asked for."""
        return sum(method == "POST" and url.endswith("/api/plans") for method, url in self.asked)

    def saved(self, button: str = "Save image as PNG") -> tuple[Pixels, str]:
        """The PNG behind a button, (height, width, 3), and its name."""
        with self.page.expect_download(timeout=60_000) as download:
            self.page.get_by_role("button", name=button).click()
        png = Image.open(io.BytesIO(Path(download.value.path()).read_bytes()))
        assert png.format == "PNG"
        return np.asarray(png.convert("RGB")), download.value.suggested_filename

    def picture(self) -> Pixels:
        """What the canvas shows, at full size, once the plans that were asked for are here."""
        self.page.wait_for_function("() => !window.seafoam.state().busy", timeout=60_000)
        return self.saved()[0]

    def canvas(self) -> Pixels:
        """The middle of the page as it is on the screen: water alone, nothing of the page over it."""
        size = self.page.viewport_size
        assert size is not None
        width, height = size["width"], size["height"]
        clip = {"x": 0, "y": 0.4 * height, "width": width, "height": 0.25 * height}
        shot = self.page.screenshot(clip=clip)  # type: ignore[arg-type]
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"))

    def follow(self, fragment: str) -> None:
        """Go where a link points, without loading the page again."""
        # The address lags behind the visitor's choices: a mark of its own makes it another one for certain.
        self.followed += 1
        self.page.evaluate("(hash) => { location.hash = hash; }", f"{fragment}&mark={self.followed}")
        # The event comes in a task of its own.
        self.frames(2)
        self.page.wait_for_function("() => !window.seafoam.state().busy", timeout=60_000)

    def frames(self, count: int) -> None:
        """Let that many animation frames pass."""
        self.page.evaluate(
            "(count) => new Promise((done) => {"
            " const next = (left) => (left === 0 ? done() : requestAnimationFrame(() => next(left - 1)));"
            " next(count); })",
            count,
        )

    def settings(self) -> Locator:
        """The panel, opened."""
        panel = self.page.locator("#settings")
        if "open" not in (panel.get_attribute("class") or ""):
            self.page.get_by_role("button", name="Settings", exact=True).click()
        panel.get_by_role("heading", name="Settings").wait_for()
        return panel

    def type(self, label: str, text: str, folder: str | None = None) -> None:
        """Type into a field of the panel."""
        panel = self.settings()
        box = panel.get_by_role("textbox", name=label, exact=True)
        if folder is not None and not box.is_visible():
            panel.get_by_role("button", name=folder).click()
        box.fill(text)
        box.press("Enter")


@contextmanager
def visit(
    lane: Lane,
    server: str,
    address: str = STILL,
    *,
    size: tuple[int, int] = SMALL,
    settle: bool = True,
    **context: Any,
) -> Iterator[Visit]:
    """The page at an address below the server's, in a browser that remembers nothing."""
    width, height = size
    opened = lane.browser.new_context(viewport={"width": width, "height": height}, **context)
    page = opened.new_page()
    made = Visit(page)
    page.on("console", lambda said: made.complaints.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: made.complaints.append(str(error)))
    page.on("request", lambda request: made.asked.append((request.method, request.url)))
    try:
        page.goto(f"{server}/{address}", wait_until="load")
        if settle:
            made.settle()
            page.locator("#loading").wait_for(state="hidden")
        yield made
    finally:
        opened.close()


@pytest.fixture(scope="module")
def shared(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server) as made:
        yield made


@pytest.fixture
def small(shared: Visit) -> Iterator[Visit]:
    """The page, small, as it was when it opened; nothing may have gone wrong on it by the end."""
    shared.page.locator(".toast").evaluate_all("(toasts) => toasts.forEach((toast) => toast.remove())")
    shared.page.evaluate("() => document.activeElement?.blur()")
    if shared.page.locator("#settings.open").count():
        shared.page.get_by_role("button", name="Close settings").click()
    shared.follow(link(preset="default"))
    shared.settle()
    shared.complaints.clear()
    shared.asked.clear()
    yield shared
    assert shared.complaints == []


def link(**parts: Any) -> str:
    """An address's fragment."""
    words = {key: json.dumps(value) if isinstance(value, dict) else value for key, value in parts.items()}
    return "#" + "&".join(f"{key}={value}" for key, value in ({"paused": 1, "quality": "draft"} | words).items())


def differs(a: Pixels, b: Pixels) -> float:
    """Share of pixels that are not the same."""
    return float((a != b).any(axis=-1).mean())


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
        assert made.complaints == []


def still_shown(page: Page) -> str:
    """Name of the still that the page shows; empty: none."""
    shown: str = page.evaluate(
        "() => { const still = document.querySelector('#still');"
        " return still.hidden ? '' : still.src.replace(/.*\\/|[.]avif$/g, ''); }"
    )
    return shown


@pytest.mark.parametrize("fragment", ["", "#paused=1", "#preset=storm", "#quality=draft&paused=1"])
def test_a_still_comes_first_and_the_water_takes_its_place(llvmpipe: Lane, server: str, fragment: str) -> None:
    """The server's own picture of the start stands until the live water, of the same moment, is there."""
    name = "storm" if "storm" in fragment else preset_names()[0]
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
        drawn = page.evaluate(
            "([name, options]) => window.seafoam.render(name, options)",
            [name, {"time": preset.time, "width": SMALL[0], "height": SMALL[1]}],
        )
        water = np.frombuffer(base64.b64decode(drawn["pixels"]), np.uint8).reshape(*SMALL[::-1], 4)[..., :3]
        # Where nothing of the page covers it; softened, since one sample a pixel is not four.
        middle = slice(int(0.45 * SMALL[1]), int(0.7 * SMALL[1]))
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
    width, height = SMALL
    for time in (0.0, 12.5):
        small.follow(link(time=time))
        answer = small.page.evaluate(
            "(options) => window.seafoam.render('default', options)",
            {"time": time, "width": width, "height": height, "quality": "draft"},
        )
        want = np.frombuffer(base64.b64decode(answer["pixels"]), np.uint8).reshape(height, width, 4)[..., :3]
        assert (small.picture() == want).all()
    # And on the screen, once it stands alone there.
    style = small.page.add_style_tag(content="body > :not(#stage) { display: none !important }")
    small.settle()
    at = int(0.4 * height)
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
    small.page.wait_for_function("(name) => location.hash.includes(name)", arg=f"preset={chosen['name']}")


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
    before, asked = small.picture(), small.plans()
    choice.select_option(label=next(text for text in texts if text.startswith("vac-1.5")))
    assert differs(small.picture(), before) > 0.05
    assert small.state()["changes"] == [["/foam/mask", "vac-1.5"]]
    assert small.plans() == asked + 1


# Time


def test_the_resolution_is_fixed_and_set_free(small: Visit) -> None:
    width, height = SMALL
    small.settings().get_by_label("resolution").select_option("0.5")
    small.settle()
    timing = small.state()["timing"]
    assert (timing["width"], timing["height"], timing["scale"]) == (width // 2, height // 2, 0.5)
    small.page.wait_for_function("() => location.hash.includes('scale=0.5')")
    small.settings().get_by_label("resolution").select_option("auto")
    small.settle()
    # At rest it grows as sharp as the window.
    assert small.state()["timing"]["width"] == width
    small.page.wait_for_function("() => !location.hash.includes('scale')")


def test_quality_follows_what_was_measured_unless_it_is_named(llvmpipe: Lane, server: str) -> None:
    """The page in motion goes to the tier whose picture is the best in time; who names one keeps it."""
    measured = [
        {"tier": "standard", "fixed": 1.0, "pixels": 600.0, "errors": [20.0, 30.0]},
        {"tier": "draft", "fixed": 1.0, "pixels": 60.0, "errors": [5.0, 6.0]},
    ]
    fronts = {"scales": [1.0, 0.25], "presets": {"default": measured}}
    opened = llvmpipe.browser.new_context(viewport={"width": 320, "height": 500})
    page = opened.new_page()
    page.route(re.compile(r"/fronts[.]json"), lambda route: route.fulfill(json=fronts))
    stats = "(tier) => document.querySelector('.frame-stats')?.textContent.startsWith(tier) === true"
    try:
        page.goto(f"{server}/", wait_until="load")
        page.wait_for_function(stats, arg="standard", timeout=60_000)
        page.wait_for_function(stats, arg="draft", timeout=120_000)
        assert page.evaluate("() => window.seafoam.state().quality") is None
        page.get_by_role("button", name="Settings", exact=True).click()
        assert page.locator("#quality").input_value() == "auto"
        page.locator("#quality").select_option("standard")
        page.wait_for_function(stats, arg="standard", timeout=60_000)
        page.wait_for_function("() => !window.seafoam.state().busy", timeout=60_000)
        page.wait_for_timeout(3000)
        assert page.evaluate("() => window.seafoam.state().quality") == "standard"
    finally:
        opened.close()


def test_a_pause_stops_every_pixel(small: Visit) -> None:
    before, time = small.canvas(), small.state()["time"]
    small.frames(12)
    assert (small.canvas() == before).all()
    assert small.state()["time"] == time
    small.page.get_by_role("button", name="Play").click()
    small.page.wait_for_function("(time) => window.seafoam.state().time > time", arg=time + 0.5)
    small.page.get_by_role("button", name="Pause").click()
    small.settle()
    after, later = small.canvas(), small.state()["time"]
    assert differs(after, before) > 0.2
    small.frames(12)
    assert (small.canvas() == after).all()
    assert small.state()["time"] == later
    small.page.get_by_role("button", name="Reset time").click()
    small.settle()
    assert small.state()["time"] == load_preset("default").time
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is True
    small.page.locator("#canvas").press("Space")
    assert small.state()["playing"] is False


def test_time_is_set(small: Visit) -> None:
    before = small.picture()
    small.page.get_by_label("Time within the minute").fill("30")
    assert small.state()["time"] == pytest.approx(30.0, abs=1e-6)
    assert differs(small.picture(), before) > 0.2
    moment = small.page.get_by_label("Time in seconds")
    assert moment.input_value() == "30.00"
    for typed, time in (("-12.5", -12.5), ("1e9", 1e9), ("4,25", 4.25)):
        moment.fill(typed)
        moment.press("Enter")
        assert small.state()["time"] == time
        assert small.picture().std() > 5.0
    moment.fill("never")
    moment.press("Enter")
    assert small.state()["time"] == 4.25
    assert moment.input_value() == "4.25"


def test_speed_scales_time(small: Visit) -> None:
    small.page.get_by_label("Speed", exact=True).select_option("4")
    assert small.state()["speed"] == 4
    small.page.get_by_role("button", name="Play").click()
    # The page asks for its next frame before this does, so each sample follows the page's own step.
    samples = small.page.evaluate(
        "() => new Promise((done) => { const seen = [];"
        " const next = (now) => { seen.push([now / 1000, window.seafoam.state().time]);"
        " if (seen.length === 12) done(seen); else requestAnimationFrame(next); };"
        " requestAnimationFrame(next); })"
    )
    wall, time = np.diff(np.array(samples), axis=0)[1:].T
    assert (time > 0).all()
    # A gap of more than a quarter of a second is no time that anyone saw.
    np.testing.assert_allclose(time, 4 * np.minimum(wall, 0.25), atol=1e-6)


@pytest.mark.parametrize(("motion", "playing"), [("reduce", False), ("no-preference", True)])
def test_starts_still_where_motion_is_unwelcome(llvmpipe: Lane, server: str, motion: str, playing: bool) -> None:
    with visit(llvmpipe, server, "#quality=draft", size=(400, 300), settle=False, reduced_motion=motion) as made:
        made.page.wait_for_function("() => window.seafoam !== undefined")
        made.page.evaluate("() => window.seafoam.ready")
        assert made.state()["playing"] is playing
        assert made.page.get_by_role("button", name="Pause" if playing else "Play").count() == 1


# Links and files


def test_a_link_restores_everything(llvmpipe: Lane, server: str) -> None:
    permissions = ["clipboard-read", "clipboard-write"]
    changes = {"/foam/mask_tile": 3.5, "/light/exposure": -0.75}
    start = link(preset="paper-halftone", time=4.1234567890123, scene=changes)
    size = (400, 300)
    with visit(llvmpipe, server, start, size=size, permissions=permissions) as made:
        made.page.mouse.move(100, 140)
        made.page.mouse.wheel(0, -120)
        made.page.get_by_label("Speed", exact=True).select_option("0.5")
        made.page.get_by_role("button", name="Compare side by side").click()
        made.page.locator("#split-view .handle").press("ArrowLeft")
        first = made.picture()
        made.page.get_by_role("button", name="Copy link to this view").click()
        made.page.get_by_text("Link copied").wait_for()
        address = made.page.evaluate("() => navigator.clipboard.readText()")
        state = made.state()
        assert address == made.page.url
        assert made.complaints == []
    assert dict(state["changes"]) == changes
    assert state["split"]["at"] == pytest.approx(0.48)
    assert state["camera"]["position"] != list(load_preset("paper-halftone").scene.camera.position)
    with visit(llvmpipe, server, address.removeprefix(f"{server}/"), size=size) as made:
        second, again = made.picture(), made.state()
        assert made.complaints == []
    for told in (state, again):
        del told["timing"], told["settled"]
    assert again == state
    assert (second == first).all()


@pytest.mark.parametrize("ratio", [1, 2])
def test_the_png_is_the_canvas(llvmpipe: Lane, server: str, ratio: int) -> None:
    with visit(llvmpipe, server, link(time=3.25), size=(400, 300), device_scale_factor=ratio) as made:
        pixels, name = made.saved()
        assert pixels.shape == (300 * ratio, 400 * ratio, 3)
        assert pixels.std() > 5.0
        assert name == "seafoam-default-3.25s.png"


def test_the_server_draws_the_same(small: Visit) -> None:
    small.settings()
    served, name = small.saved("Render on server")
    assert name.endswith("-server.png")
    assert differs(served, small.picture()) < 1e-4


def test_a_visitor_dives(llvmpipe: Lane, server: str) -> None:
    """Down through the surface by key, once that is compiled; an orbit alone stays over it."""
    with visit(llvmpipe, server, link(preset="lake-calm"), size=(400, 300), reduced_motion="reduce") as made:
        over = made.picture()
        mouse, keyboard = made.page.mouse, made.page.keyboard
        mouse.move(200, 150)
        mouse.down()
        mouse.move(200, 20, steps=4)
        mouse.up()
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
        assert made.complaints == []


# What asks for a plan, and what does not


def test_a_live_field_asks_for_nothing_and_a_look_for_a_plan(small: Visit) -> None:
    before, asked = small.picture(), small.plans()
    small.type("exposure", "1", folder="light")
    brighter = small.picture()
    assert brighter.mean() > before.mean() + 10
    assert small.plans() == asked
    small.settings().get_by_label("look", exact=True).select_option(label="halftone")
    assert differs(small.picture(), brighter) > 0.05
    assert small.plans() == asked + 1
    small.page.get_by_role("button", name="Reset scene").click()
    assert (small.picture() == before).all()


def test_the_camera_asks_for_nothing(llvmpipe: Lane, server: str) -> None:
    # Without inertia the camera stands still between two moves.
    with visit(llvmpipe, server, size=(400, 300), reduced_motion="reduce") as made:
        before, asked = made.picture(), len(made.asked)
        camera = made.state()["camera"]
        mouse, keyboard = made.page.mouse, made.page.keyboard

        def moved(what: str) -> None:
            """The move has reached the camera, and is over."""
            nonlocal camera
            made.page.wait_for_function(
                "([what, held]) => JSON.stringify(window.seafoam.state().camera[what]) !== JSON.stringify(held)",
                arg=[what, camera[what]],
            )
            if what == "position":
                assert made.state()["camera"]["fov"] == camera["fov"]
            camera = made.state()["camera"]

        mouse.move(200, 150)
        mouse.down()
        mouse.move(260, 150)
        mouse.up()
        moved("yaw")
        mouse.wheel(0, -100)
        moved("position")
        keyboard.down("Shift")
        mouse.wheel(0, 100)
        keyboard.up("Shift")
        moved("fov")
        made.page.locator("#canvas").focus()
        for key, what in (("w", "position"), ("d", "position"), ("e", "position"), ("ArrowLeft", "yaw")):
            keyboard.down(key)
            moved(what)
            keyboard.up(key)
            made.frames(3)
            camera = made.state()["camera"]
            made.frames(3)
            assert made.state()["camera"] == camera, "the camera stops with the key"
        assert differs(made.picture(), before) > 0.2
        assert [url for _, url in made.asked[asked:] if "/api/" in url and "width=192" not in url] == []
        assert made.complaints == []


def test_a_bad_value_is_told_and_the_picture_stays(small: Visit) -> None:
    before = small.picture()
    small.page.evaluate("(fragment) => { location.hash = fragment; }", link(scene={"/foam/mask": "no-such-mask"}))
    toast = small.page.locator(".toast.error")
    toast.wait_for()
    assert "mask" in (toast.text_content() or "")
    assert (small.picture() == before).all()
    # The browser itself notes a refused request.
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    small.follow(link(scene={"/foam/mask": "vac-6"}))
    assert differs(small.picture(), before) > 0.05


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


# Phones


@pytest.fixture
def phone(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    """The page on a phone, at rest."""
    with visit(llvmpipe, server, size=PHONE, has_touch=True, is_mobile=True) as made:
        yield made
        assert made.complaints == []


def swipe(page: Page, *fingers: tuple[tuple[float, float], tuple[float, float]], steps: int = 4) -> None:
    """Drag each finger from one place to another."""
    session = page.context.new_cdp_session(page)

    def send(kind: str, share: float) -> None:
        points = [
            {"x": a[0] + (b[0] - a[0]) * share, "y": a[1] + (b[1] - a[1]) * share, "id": i}
            for i, (a, b) in enumerate(fingers)
        ]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [] if kind == "touchEnd" else points})

    send("touchStart", 0)
    for step in range(1, steps + 1):
        send("touchMove", step / steps)
    send("touchEnd", 1)
    session.detach()


def test_fingers_move_the_camera(phone: Visit) -> None:
    before, start = phone.picture(), phone.state()["camera"]
    asked = phone.plans()
    swipe(phone.page, ((100, 400), (220, 400)))
    phone.settle()
    turned = phone.state()["camera"]
    # The sea stays under the finger, so the view turns the other way.
    assert turned["yaw"] < start["yaw"] - 0.05
    assert turned["fov"] == start["fov"]
    assert differs(phone.picture(), before) > 0.2
    swipe(phone.page, ((180, 400), (80, 400)), ((210, 400), (310, 400)))
    phone.settle()
    closer = phone.state()["camera"]
    assert closer["position"] != turned["position"]
    assert closer["yaw"] == pytest.approx(turned["yaw"])
    assert phone.plans() == asked


def test_the_settings_are_a_sheet_from_below(phone: Visit) -> None:
    panel = phone.settings()
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).transform === 'none'")
    box = panel.bounding_box()
    assert box is not None
    assert (box["x"], box["width"]) == (0, PHONE[0])
    assert box["y"] + box["height"] == pytest.approx(PHONE[1], abs=1)
    assert box["y"] > PHONE[1] / 3, "no picture is left to judge by"
    play = phone.page.get_by_role("button", name="Play")
    play.click()
    assert phone.state()["playing"] is True, "time stays in reach"
    phone.page.get_by_role("button", name="Pause").click()
    assert phone.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    phone.page.get_by_role("button", name="Close settings").click()
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).visibility === 'hidden'")
    assert panel.evaluate("(panel) => panel.inert") is True


TARGETS = """() => [...document.querySelectorAll('button, select, input, summary, [role=slider]')]
  .filter((target) => target.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true }))
  // A box to tick is as large as its label; a list drops down from what stands around it.
  .map((target) => target.matches('[type=checkbox]') ? target.closest('label') : target)
  .map((target) => [target.getAttribute('aria-label') ?? target.textContent ?? '', target.getBoundingClientRect()])
  .map(([label, { width, height }]) => [label.trim().slice(0, 40), Math.round(width), Math.round(height)])"""


def test_targets_fit_a_finger(phone: Visit) -> None:
    phone.page.get_by_role("button", name="Compare side by side").click()
    targets = phone.page.evaluate(TARGETS)
    phone.settings()
    for folder in ("light", "waves (5)"):
        phone.settings().get_by_role("button", name=folder).click()
    phone.page.wait_for_function(
        "() => document.querySelector('#settings').getAnimations({ subtree: true }).length === 0"
    )
    targets += phone.page.evaluate(TARGETS)
    assert len(targets) > 40
    assert [target for target in targets if min(target[1:]) < FINGER] == []


@pytest.mark.parametrize("opened", [False, True], ids=["compared", "settings"])
def test_nothing_covers_what_must_be_reached(phone: Visit, opened: bool) -> None:
    phone.page.get_by_role("button", name="Compare side by side").click()
    if opened:
        phone.settings()
        phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).transform === 'none'")
    within = "#settings .head, #transport" if opened else "#transport, #tools, #split-view"
    covered = phone.page.evaluate(
        """(within) => [...document.querySelectorAll(within)].flatMap((part) =>
          [...part.querySelectorAll('button, select, input, [role=slider]')]
            .filter((target) => target.checkVisibility({ checkVisibilityCSS: true }))
            .filter((target) => {
              const { x, y, width, height } = target.getBoundingClientRect();
              const top = document.elementFromPoint(x + width / 2, y + height / 2);
              return !target.contains(top);
            })
            .map((target) => target.getAttribute('aria-label')))""",
        within,
    )
    assert covered == []


def luminance(srgb: Any) -> Any:
    """Relative luminance (WCAG 2) of colours in [0, 255]."""
    share = np.asarray(srgb, float) / 255
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_words_stand_out(llvmpipe: Lane, server: str, size: tuple[int, int]) -> None:
    """Where foam is as white as letters, what lies behind them is dark and soft enough to read on."""
    with visit(llvmpipe, server, link(preset="paper-threshold"), size=size) as made:
        summary = made.page.locator("#summary")
        colour = summary.evaluate("(summary) => getComputedStyle(summary).color")
        *ink, alpha = (float(number) for number in re.findall(r"[\d.]+", colour))
        summary.evaluate("(summary) => { summary.style.opacity = 0; }")
        box = summary.bounding_box()
        assert box is not None
        shot = np.asarray(Image.open(io.BytesIO(made.page.screenshot(clip=box))).convert("RGB"))  # type: ignore[arg-type]
    behind = luminance(shot)
    letters = luminance(alpha * np.array(ink) + (1 - alpha) * shot)
    contrast = (letters + 0.05) / (behind + 0.05)
    REPORT.add(
        "Contrast of the summary over white dots",
        width=str(size[0]),
        median=f"{np.median(contrast):.1f}",
        worst=f"{np.percentile(contrast, 2):.1f}",
    )
    assert np.percentile(contrast, 2) > 4.5


def test_the_address_stays_readable(small: Visit) -> None:
    small.follow(link(time=2.5, scene={"/light/exposure": -1.0}))
    small.page.wait_for_function("() => location.hash.includes('time=2.5')")
    assert re.fullmatch(r"#[\w.,=&/:{}\[\]%~-]+", "#" + small.page.url.partition("#")[2])
