"""Chromium started as people start it, and what is seen of the page from outside: frames, gaps, answers, messages."""

import io
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Page, Playwright

from support.browser.lanes import chromium
from support.browser.visits import PHONE

STARTS: dict[str, list[str]] = {
    "default flags": [],
    "ANGLE on GL": ["--use-angle=gl"],
    "SwiftShader": ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    "llvmpipe": ["--use-angle=gl-egl", "--ignore-gpu-blocklist"],
    "WebGL off": ["--disable-webgl", "--disable-webgl2", "--disable-3d-apis"],
}
"""Ways of starting Chromium on a machine without a GPU, and their switches."""
WINDOWS = {"desktop": (1280, 720), "phone": PHONE}
"""Widths and heights of the windows, CSS pixels; the phone's has a touch screen."""
SKY, WATER = (0.5, 0.25), (0.5, 0.7)
"""Where they are in the window, as shares of its sides: a drag turns the camera on one, raises waves on the other."""
PLAYED = ("paper-halftone", "shallows", "default")
"""Presets that are gone through in play."""
SPLIT = "/foam/mask~vac-3~vac-24~0.400"
_ENGINES_OWN = re.compile(r"fallback to software WebGL|GPU stall due to ReadPixels")

_WATCH = """(() => {
    if (window.seen) return;
    const seen = (window.seen = { ticks: [], frames: [], long: [], moves: [] });
    const tick = (now) => {
        seen.ticks.push(performance.now());
        requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
    // A frame of WebGL: the first draw of a turn of the event loop into a canvas that is shown, not into a texture.
    let drawn = false;
    const note = (by, { width, height }) => seen.frames.push({ at: performance.now(), by, width, height });
    const shows = (canvas) => {
        if (drawn || !canvas.isConnected) return;
        drawn = true;
        note("browser", canvas);
        queueMicrotask(() => (drawn = false));
    };
    const gl = window.WebGL2RenderingContext?.prototype;
    if (gl) {
        const bound = new WeakMap();
        const bind = gl.bindFramebuffer;
        gl.bindFramebuffer = function (target, framebuffer) {
            bound.set(this, framebuffer);
            return bind.call(this, target, framebuffer);
        };
        for (const name of ["drawArrays", "drawElements"]) {
            const draw = gl[name];
            gl[name] = function (...given) {
                if (!bound.get(this)) shows(this.canvas);
                return draw.apply(this, given);
            };
        }
    }
    const bitmap = window.ImageBitmapRenderingContext.prototype;
    const transfer = bitmap.transferFromImageBitmap;
    bitmap.transferFromImageBitmap = function (picture) {
        note("server", picture);
        return transfer.call(this, picture);
    };
    new PerformanceObserver((list) => {
        for (const { startTime, duration } of list.getEntries()) seen.long.push([startTime, duration]);
    }).observe({ type: "longtask", buffered: true });
    addEventListener("pointermove", () => seen.moves.push(performance.now()), { capture: true, passive: true });
})()"""
"""Notes animation frames, pictures that are drawn, long tasks and input; all times are of performance.now(), ms."""


@dataclass
class Started:
    """A page in a browser that was started so, and what it said."""

    page: Page
    complaints: list[str] = field(default_factory=list)

    def said(self) -> list[str]:
        """Messages in the console, but what Chromium says of its software GL, whatever a page does."""
        return [message for message in self.complaints if not _ENGINES_OWN.search(message)]

    def frames(self) -> list[dict[str, Any]]:
        """Pictures that were drawn: ``at`` (ms), ``by``, ``width``, ``height``."""
        return self.page.evaluate("() => window.seen.frames")

    def more_frames(self, count: int) -> None:
        """Wait until so many more pictures are drawn."""
        self.page.wait_for_function(
            "(until) => window.seen.frames.length >= until", arg=len(self.frames()) + count, timeout=120_000
        )

    def picture(self) -> NDArray[np.float64]:
        """The page as it is seen, (height, width, 3), in 0 to 255."""
        png = Image.open(io.BytesIO(self.page.screenshot(timeout=120_000)))
        return np.asarray(png.convert("RGB"), np.float64)

    def drag_seconds(self) -> float:
        """Middle time from a move of a drag on the sky to a picture that was drawn after the page had taken it."""
        width, height = self.page.evaluate("() => [innerWidth, innerHeight]")
        x, y = SKY[0] * width, SKY[1] * height
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        answers = []
        for step in range(1, 7):
            sent = self.page.evaluate("() => performance.now()")
            mouse.move(x + 12 * step, y + 2 * step)
            answered = self.page.wait_for_function(
                """(sent) => {
                    const taken = window.seen.moves.findLast((at) => at >= sent);
                    const frame = taken && window.seen.frames.find(({ at }) => at > taken);
                    return frame && frame.at;
                }""",
                arg=sent,
                timeout=30_000,
            ).json_value()
            answers.append(1e-3 * (answered - sent))
        mouse.up()
        return median(answers)

    def play(self, seconds: float) -> None:
        """Touch the water, turn the camera, go to a preset and draw a divider: once, and again for so long."""
        page = self.page
        until = time.monotonic() + seconds
        width, height = page.evaluate("() => [innerWidth, innerHeight]")
        for turn in count():
            for x, y in (WATER, SKY):
                page.mouse.move(x * width, y * height)
                page.mouse.down()
                for step in range(1, 5):
                    page.mouse.move(x * width + 20 * step, y * height + 4 * step)
                    page.wait_for_timeout(50)
                page.mouse.up()
                page.wait_for_timeout(500)
            preset = PLAYED[turn % len(PLAYED)]
            page.evaluate("(hash) => { location.hash = hash; }", f"#preset={preset}")
            page.wait_for_timeout(3000)
            page.evaluate("(hash) => { location.hash = hash; }", f"#preset={preset}&split={SPLIT}")
            page.wait_for_timeout(2000)
            divider = page.get_by_role("slider", name="Split position")
            if divider.count():
                for key in ("ArrowRight", "ArrowRight", "ArrowLeft"):
                    divider.press(key)
                    page.wait_for_timeout(200)
            if time.monotonic() >= until:
                return


@contextmanager
def browser_started(playwright: Playwright, start: str) -> Iterator[Browser]:
    """Chromium with no switches of a driver: headless, an empty profile, and those of the start."""
    with TemporaryDirectory(prefix="seafoam-chromium-", ignore_cleanup_errors=True) as profile:
        told = ["--headless=new", "--no-sandbox", "--no-first-run", "--remote-debugging-pipe"]
        arguments = [*told, f"--user-data-dir={profile}", *STARTS[start], "about:blank"]
        with playwright.chromium.launch(
            executable_path=chromium(), ignore_default_args=True, args=arguments
        ) as browser:
            yield browser


@contextmanager
def opened(
    browser: Browser, address: str, window: str = "desktop", size: tuple[int, int] | None = None
) -> Iterator[Started]:
    """A new page at an address, watched from its first script on; ``size``: of the window, if it is not the usual."""
    width, height = size or WINDOWS[window]
    context = browser.new_context(
        viewport={"width": width, "height": height}, has_touch=window == "phone", is_mobile=window == "phone"
    )
    context.add_init_script(_WATCH)
    page = context.new_page()
    started = Started(page)
    page.on("console", lambda message: started.complaints.append(f"{message.type}: {message.text}"))
    page.on("pageerror", lambda error: started.complaints.append(f"error: {error}"))
    page.goto(address, wait_until="commit", timeout=60_000)
    try:
        yield started
    finally:
        context.close()
