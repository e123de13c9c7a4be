"""The page as a visitor meets it, with all that it complained of and asked for."""

import base64
import io
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import CDPSession, Locator, Page, Route, TimeoutError

from support.browser.lanes import Lane, complaints_of

DESKTOP = (1280, 800)
PHONE = (390, 844)
SMALL = (760, 500)
"""The desktop's layout on as few pixels as hold it: llvmpipe is slow."""
_OVERLAYS = Path(__file__).parents[3] / "webclient/src/ui/overlays.ts"
(_GOES,) = re.findall(r"\berror: (\d+)", _OVERLAYS.read_text(encoding="utf-8"))
ERRORS_STAY = f"""(() => {{
  const later = window.setTimeout.bind(window);
  window.setTimeout = (run, delay, ...rest) => later(run, delay === {_GOES} ? 3600000 : delay, ...rest);
}})()"""
"""Keeps messages of errors, which go by the clock: on a busy machine before a test has looked."""
OVER = "({ effect, playState }) => playState !== 'running' || effect.getTiming().iterations === Infinity"
"""Whether an animation is over, or goes on for ever, as that of the name on the hidden loading screen."""
BLANK = "about:blank"
"""Where who has to do something with a page before it loads begins."""
FINGER = 44
"""Least side of what a finger must hit, px."""
TARGETS = """() => [...document.querySelectorAll('button, select, input, summary, [role=slider]')]
  .filter((target) => target.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true }))
  // A box to tick is as large as its label; a list drops down from what stands around it.
  .map((target) => target.matches('[type=checkbox]') ? target.closest('label') : target)
  .map((target) => [target.getAttribute('aria-label') ?? target.textContent ?? '', target.getBoundingClientRect()])
  .map(([label, { width, height }]) => [label.trim().slice(0, 40), Math.round(width), Math.round(height)])"""
"""Gives the label, width and height, px, of each thing in sight that a finger can hit."""

OVERLAPS = """(() => {
  const parts = '#tools > *, #gallery button, .strip em, .strip a, #transport, h1, #summary';
  // Of the strip, what it does not cut off.
  const box = (node) => {
    const { left, right, top, bottom } = node.getBoundingClientRect();
    const strip = node.closest('.strip')?.getBoundingClientRect() ?? { left: 0, right: innerWidth };
    return { left: Math.max(left, strip.left), right: Math.min(right, strip.right), top, bottom };
  };
  const seen = [...document.querySelectorAll(parts)]
    .filter((node) => node.checkVisibility({ checkVisibilityCSS: true }))
    .map((node) => [node.getAttribute('aria-label') ?? node.textContent.trim(), box(node)])
    .filter(([, { left, right }]) => left < right);
  const meet = (a, b) =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  return seen.flatMap(([name, a], i) =>
    seen.slice(i + 1).filter(([, b]) => meet(a, b)).map(([other]) => `${name} over ${other}`));
})()"""
"""Gives the pairs of the page's parts in sight that lie over one another."""

Pixels = NDArray[np.uint8]


def link(**parts: Any) -> str:
    """An address's fragment; else of a picture of few programs, at rest, where any does."""
    usual = {"paused": 1, "quality": "fast", "preset": "paper-halftone"}
    words = {key: json.dumps(value) if isinstance(value, dict) else value for key, value in parts.items()}
    return "#" + "&".join(f"{key}={value}" for key, value in (usual | words).items())


START = link()
UNMOVED = "#quality=fast&scale=0.25&preset=paper-halftone"
"""Who wants no motion finds it at rest; small pictures, for what lies over them."""


def pixels_of(png: bytes) -> Pixels:
    """A picture's colours, (height, width, 3)."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


@dataclass
class Visit:
    """A page, with all that it complained of and asked for."""

    page: Page
    complaints: list[str]
    asked: list[tuple[str, str]] = field(default_factory=list)
    """Method and address of every request."""
    followed: int = 0
    expected: str | None = None
    """Part of the words of what the page will complain of; None: it may complain of nothing."""
    tab: CDPSession | None = None

    def settle(self) -> None:
        """Wait until the picture shows what was asked for, at rest and sharp."""
        try:
            self.page.wait_for_function("() => window.seafoam?.state().settled === true", timeout=180_000)
        except TimeoutError as error:
            state = self.page.evaluate("() => window.seafoam?.state()")
            raise AssertionError(
                f"never at rest: {state}, {self.complaints}, {self.page.inner_text('body')}"
            ) from error

    def begin(self) -> None:
        """Wait until the page draws."""
        self.page.wait_for_function("() => window.seafoam !== undefined")
        self.page.evaluate("() => window.seafoam.ready")

    def press(self, name: str, *, exact: bool = False) -> None:
        """Press the button of that name."""
        self.page.get_by_role("button", name=name, exact=exact).click()

    def enter(self, label: str, text: str) -> None:
        """Type into the field of that name, and press Enter."""
        self.page.get_by_label(label).fill(text)
        self.page.get_by_label(label).press("Enter")

    def state(self) -> dict[str, Any]:
        return self.page.evaluate("() => window.seafoam.state()")

    def plans(self) -> int:
        """How often a plan was asked for."""
        return sum(method == "POST" and url.endswith("/api/plans") for method, url in self.asked)

    def frames_asked(self) -> int:
        """How often a frame of the server's was asked for."""
        return sum(method == "POST" and url.endswith("/api/frames") for method, url in self.asked)

    def saved(self, button: str = "Save image as PNG") -> tuple[Pixels, str]:
        """The PNG behind a button, (height, width, 3), and its name."""
        with self.page.expect_download(timeout=180_000) as download:
            self.press(button)
        png = Path(download.value.path()).read_bytes()
        assert Image.open(io.BytesIO(png)).format == "PNG"
        return pixels_of(png), download.value.suggested_filename

    def picture(self) -> Pixels:
        """What the canvas shows, at full size, once the plans that were asked for are here."""
        self.page.wait_for_function("() => !window.seafoam.state().busy", timeout=180_000)
        return self.saved()[0]

    def canvas(self) -> Pixels:
        """The middle of the page as it is on the screen: water alone, nothing of the page over it."""
        size = self.page.viewport_size
        width, height = size["width"], size["height"]
        clip = {"x": 0, "y": 0.4 * height, "width": width, "height": 0.25 * height}
        return pixels_of(self.page.screenshot(clip=clip))

    def follow(self, fragment: str) -> None:
        """Go where a link points, without loading the page again."""
        # The address lags behind the visitor's choices: a mark of its own makes it another one for certain.
        self.followed += 1
        self.page.evaluate("(hash) => { location.hash = hash; }", f"{fragment}&mark={self.followed}")
        # The event comes in a task of its own.
        self.frames(2)
        self.page.wait_for_function("() => !window.seafoam.state().busy", timeout=180_000)

    def start_again(self, fragment: str = START) -> None:
        """Put the page back to how it was when it opened, for the next test."""
        self.page.unroute_all()
        self.page.locator(".toast").evaluate_all("(toasts) => toasts.forEach((toast) => toast.remove())")
        self.page.evaluate("() => document.activeElement?.blur()")
        if self.page.locator("#settings.open").count():
            self.press("Close settings")
            self.still()
        self.follow(fragment)
        self.settle()
        self.complaints.clear()
        self.asked.clear()

    def still(self) -> None:
        """Wait until the panel neither opens nor closes any more."""
        panel = "document.querySelector('#settings')"
        self.page.wait_for_function(f"() => {panel}.getAnimations({{ subtree: true }}).every({OVER})")

    @contextmanager
    def awake(self) -> Iterator[None]:
        """Frozen afterwards: a page that is shared asks for animation frames all the time, a tenth of a processor."""
        if self.tab is None:
            self.tab = self.page.context.new_cdp_session(self.page)
        self.tab.send("Page.setWebLifecycleState", {"state": "active"})
        yield
        self.tab.send("Page.setWebLifecycleState", {"state": "frozen"})

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
            self.press("Settings", exact=True)
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


@dataclass
class Held:
    """Requests that wait on a slow network."""

    page: Page
    pattern: str | re.Pattern[str]
    routes: list[Route] = field(default_factory=list)
    holding: bool = True

    def __post_init__(self) -> None:
        self.page.route(self.pattern, self.take)

    def take(self, route: Route) -> None:
        if self.holding:
            self.routes.append(route)
        else:
            route.continue_()

    def bodies(self) -> list[dict[str, Any]]:
        return [json.loads(route.request.post_data or "{}") for route in self.routes]

    def arrived(self) -> None:
        """Wait until one is held."""
        for _ in range(400):
            if self.routes:
                return
            self.page.wait_for_timeout(50)
        raise AssertionError(f"no request for {self.pattern}")

    def let_go(self, *, holding: bool = False) -> None:
        """Send on what is held; `holding`: hold the ones that follow."""
        self.holding = holding
        routes, self.routes = self.routes, []
        for route in routes:
            route.continue_()


@contextmanager
def visit(
    lane: Lane, server: str, address: str = START, *, size: tuple[int, int] = SMALL, settle: bool = True, **context: Any
) -> Iterator[Visit]:
    """The page at an address below the server's, in a browser that remembers nothing; it may complain of nothing."""
    width, height = size
    opened = lane.browser.new_context(viewport={"width": width, "height": height}, **context)
    opened.set_default_timeout(180_000)
    page = opened.new_page()
    page.add_init_script(ERRORS_STAY)
    made = Visit(page, complaints_of(page))
    page.on("request", lambda request: made.asked.append((request.method, request.url)))
    try:
        page.goto(address if address == BLANK else f"{server}/{address}", wait_until="load")
        if settle:
            made.settle()
            page.locator("#loading").wait_for(state="hidden")
        yield made
        complaints = [one for one in made.complaints if made.expected is None or made.expected not in one]
        assert complaints == [], complaints
    finally:
        opened.close()


def until(page: Page, condition: str, seconds: float = 60) -> None:
    """Wait for a condition without evaluating text in the page, which its policy forbids."""
    for _ in range(round(10 * seconds)):
        if page.evaluate(condition):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"never true: {condition}")


def canvas_pixels(canvas: Locator) -> Pixels:
    """What a canvas holds, (height, width, 3)."""
    # As text: a list of so many numbers takes seconds on its way here.
    data = canvas.evaluate("(canvas) => canvas.toDataURL('image/png').split(',')[1]")
    return pixels_of(base64.b64decode(data))


def drag(page: Page, *places: tuple[float, float], button: Literal["left", "right"] = "left", steps: int = 4) -> None:
    """Drag the mouse from place to place."""
    page.mouse.move(*places[0])
    page.mouse.down(button=button)
    for place in places[1:]:
        page.mouse.move(*place, steps=steps)
    page.mouse.up(button=button)


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


def differs(a: Pixels, b: Pixels) -> float:
    """Share of pixels that are not the same."""
    return float((a != b).any(axis=-1).mean())
