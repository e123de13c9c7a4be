"""The page used as the reference for speed: three.js's ``Water`` and ``Sky`` in Chromium on the system's EGL."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, CDPSession, Page, TimeoutError, sync_playwright

from bench.served.page import launched
from bench.served.server import HOST

ROOT = Path(__file__).resolve().parents[2]
PAGE = Path(__file__).parents[1] / "three"
PACKAGE = ROOT / "webclient" / "node_modules" / "three"
SIZE = (1280, 720)
READY_SECONDS = 60.0
LEAST_VARIETY = 20.0
"""Minimum standard deviation of a picture that shows water and sky, levels."""


@dataclass(frozen=True)
class Frames:
    """Consecutive frames: seconds of each until a pixel was read, and mean processor time of a frame."""

    wall: tuple[float, ...]
    cpu: float


class WaterPage:
    """The page, open and warm."""

    def __init__(self, page: Page, processes: CDPSession) -> None:
        self._page = page
        self._processes = processes
        info = page.evaluate("() => ({ ...window.yardstick, variety: window.yardstick.variety() })")
        self.renderer: str = info["renderer"]
        self.revision: str = info["revision"]
        if (info["width"], info["height"]) != SIZE:
            raise RuntimeError(f"three.js draws {info['width']} x {info['height']} and not {SIZE[0]} x {SIZE[1]}")
        if info["variety"] < LEAST_VARIETY:
            raise RuntimeError(f"three.js's page shows no water: its values spread by {info['variety']:.1f} levels")
        self.frames(4)

    def require(self, renderer: str) -> None:
        """Raise ``RuntimeError`` unless the browser draws with the renderer of this name, as reported by GL."""
        # ANGLE removes commas from the names.
        if renderer.replace(",", "") not in self.renderer:
            raise RuntimeError(f"three.js draws on {self.renderer}, and not on {renderer}")

    def close(self) -> None:
        """Close the page."""
        self._page.close()

    def frames(self, count: int) -> Frames:
        """Draw a number of frames, after one that is not counted; returns their times."""
        self._page.evaluate("() => window.yardstick.frames(1)")
        before = self._cpu()
        taken = self._page.evaluate("count => window.yardstick.frames(count)", count)
        cpu = (self._cpu() - before) / count
        # The browser presents the frames now, not during the next measurement.
        self._page.evaluate("() => window.yardstick.rest()")
        return Frames(tuple(milliseconds / 1000.0 for milliseconds in taken), cpu)

    def screenshot(self) -> tuple[float, int]:
        """Seconds from a change of the water's time until the browser has returned a PNG of it; and its bytes."""
        began = time.perf_counter()
        self._page.evaluate("() => window.yardstick.draw()")
        size = len(self._page.screenshot(type="png"))
        return time.perf_counter() - began, size

    def _cpu(self) -> float:
        """Processor time of the browser's processes, s."""
        processes = self._processes.send("SystemInfo.getProcessInfo")["processInfo"]
        return float(sum(process["cpuTime"] for process in processes))


class _Files(SimpleHTTPRequestHandler):
    """The page's own files, and the package's below ``/three/``."""

    def translate_path(self, path: str) -> str:
        name = path.partition("?")[0].lstrip("/") or "index.html"
        top, _, rest = name.partition("/")
        root, inner = (PACKAGE, rest) if top == "three" else (PAGE, name)
        file = (root / inner).resolve()
        return str(file if file.is_relative_to(root.resolve()) else root / "absent")

    def log_message(self, *_: Any) -> None:
        """Log nothing."""


@contextmanager
def served() -> Iterator[str]:
    """Serve the page while the context lasts; yields its address. Raises ``RuntimeError`` without three.js."""
    if not (PACKAGE / "build" / "three.module.js").exists():
        raise RuntimeError(f"{PACKAGE} is not there: run make setup-test")
    server = ThreadingHTTPServer((HOST, 0), _Files)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://{HOST}:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def shown(browser: Browser, address: str) -> WaterPage:
    """The page in a browser, warm. Raises ``RuntimeError`` if it does not start or shows nothing."""
    page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, device_scale_factor=1)
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(address, wait_until="load", timeout=1000 * READY_SECONDS)
    try:
        page.wait_for_function("() => window.yardstick !== undefined", timeout=1000 * READY_SECONDS)
    except TimeoutError as error:
        raise RuntimeError(f"three.js's page did not come up: {errors or 'it said nothing'}") from error
    return WaterPage(page, browser.new_browser_cdp_session())


@contextmanager
def opened() -> Iterator[WaterPage]:
    """The page in a Chromium of its own while the context lasts."""
    with served() as address, sync_playwright() as playwright:
        browser = launched(playwright, "llvmpipe", optimised=True)
        try:
            yield shown(browser, address)
        finally:
            browser.close()
