"""The page: time and bytes until its first picture, and how it moves, in Chromium on the system's EGL."""

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from playwright.sync_api import Browser, Page, Playwright, sync_playwright

from bench.report import Column, Table, count, ms
from bench.server import HOST
from bench.watch import Watch

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests"))

from browsers import COMMON, LANES, chromium, launched

__all__ = ["launched", "measure"]

SIZE = (1280, 720)
READY_SECONDS = 60.0
QUIET_SECONDS = 30.0
REST_SECONDS = 1.5
SETTLE_SECONDS = 6.0
SAMPLE_SECONDS = 4.0
SAMPLES = 16

_NOTE_READY = """
    let hook;
    Object.defineProperty(window, "seafoam", {
        configurable: true,
        get: () => hook,
        set: (given) => {
            hook = given;
            given.ready.then(
                () => (window.benchReady = performance.now()),
                (error) => (window.benchReady = String(error)),
            );
        },
    });
"""
"""Notes the moment at which the page's first picture is on the canvas, counted from the start of the navigation."""

_ENTRIES = """() => [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")]
    .map(({ name, responseEnd, transferSize }) => ({ name, responseEnd, transferSize }))"""

KINDS = (
    ("/assets/", ".js", "JavaScript"),
    ("/assets/", ".css", "CSS"),
    ("/api/plans", "", "plan"),
    ("/api/textures/", "", "textures"),
    ("/api/frames/", "", "thumbnails"),
    ("/openapi.json", "", "OpenAPI document"),
    ("/api/", "", "presets, names"),
    ("/", "/", "HTML"),
    ("/", "", "other"),
)
"""How an address begins and ends, and what it is; the first that fits."""


@dataclass(frozen=True)
class Load:
    """One load of the page: seconds until the first picture; by kind: requests, bytes and seconds until the last."""

    ready: float
    kinds: dict[str, tuple[int, int, float]]

    @property
    def requests(self) -> int:
        """All requests."""
        return sum(requests for requests, _, _ in self.kinds.values())

    @property
    def bytes(self) -> int:
        """All bytes, headers counted as the browser counts them."""
        return sum(size for _, size, _ in self.kinds.values())


def measure(port: int, watch: Watch) -> tuple[dict[str, str], list[Table]]:
    """Open the page in new browsers; gives what they are, and the tables."""
    address = f"http://{HOST}:{port}/"
    first: list[Load] = []
    again: list[Load] = []
    motion: list[dict[str, Any]] = []
    browser_info: dict[str, str] = {}
    with sync_playwright() as playwright:
        for _ in watch.rounds("first picture of the page", 3, 45.0, least=1):
            browser = _launched(playwright)
            try:
                page = _page(browser)
                first.append(_load(page, address))
                if not motion:
                    browser_info = {
                        "Chromium": browser.version,
                        "Chromium's renderer": page.evaluate("window.seafoam.renderer"),
                    }
                    motion = _motion(page)
                again.append(_load(page, address))
            finally:
                browser.close()
    return browser_info, [_visits(first, again), _kinds(first), _moving(motion)]


def _launched(playwright: Playwright) -> Browser:
    """A browser that has seen nothing; its driver's cache of compiled shaders is off."""
    environment: dict[str, str | float | bool] = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "true"}
    return playwright.chromium.launch(executable_path=chromium(), args=[*COMMON, *LANES["llvmpipe"]], env=environment)


def _page(browser: Browser) -> Page:
    context = browser.new_context(viewport={"width": SIZE[0], "height": SIZE[1]}, device_scale_factor=1)
    context.add_init_script(_NOTE_READY)
    return context.new_page()


def _load(page: Page, address: str) -> Load:
    page.goto(address, wait_until="load", timeout=1000 * READY_SECONDS)
    page.wait_for_function("() => window.benchReady !== undefined", timeout=1000 * READY_SECONDS)
    ready = page.evaluate("window.benchReady")
    if not isinstance(ready, int | float):
        raise RuntimeError(f"the page shows no picture: {ready}")
    kinds: dict[str, tuple[int, int, float]] = {}
    for entry in _settled(page):
        path = "/" + entry["name"].removeprefix(address).split("?")[0].split("#")[0]
        kind = next(name for begin, end, name in KINDS if path.startswith(begin) and path.endswith(end))
        requests, size, last = kinds.get(kind, (0, 0, 0.0))
        kinds[kind] = (requests + 1, size + entry["transferSize"], max(last, entry["responseEnd"] / 1000.0))
    return Load(ready / 1000.0, kinds)


def _settled(page: Page) -> list[dict[str, Any]]:
    """What the page has loaded, once no more has come for a while or the time is up."""
    until = time.monotonic() + QUIET_SECONDS
    entries: list[dict[str, Any]] = []
    while time.monotonic() < until:
        page.wait_for_timeout(1000 * REST_SECONDS)
        before, entries = entries, [e for e in page.evaluate(_ENTRIES) if e["name"].startswith("http")]
        if len(entries) == len(before):
            break
    return entries


def _motion(page: Page) -> list[dict[str, Any]]:
    """The page's own readings while the sea moves, after its resolution has settled."""
    page.wait_for_timeout(1000 * SETTLE_SECONDS)
    readings = []
    for _ in range(SAMPLES):
        page.wait_for_timeout(1000 * SAMPLE_SECONDS / SAMPLES)
        readings.append(page.evaluate("window.seafoam.state().timing"))
    return readings


def _visits(first: list[Load], again: list[Load]) -> Table:
    return Table(
        "The page's first picture",
        f"From the start of the navigation until the first picture is on the canvas, {SIZE[0]} x {SIZE[1]}; medians of "
        f"{len(first)}. First visit: a new browser. Bytes: as transferred, all requests until the page rests.",
        (
            Column("visit", "visit"),
            Column("ready", "first picture, ms", ms),
            Column("requests", "requests", count),
            Column("bytes", "bytes", count),
        ),
        [
            (
                name,
                median(load.ready for load in loads),
                round(median(load.requests for load in loads)),
                round(median(load.bytes for load in loads)),
            )
            for name, loads in (("first", first), ("again, same browser", again))
        ],
    )


def _kinds(loads: list[Load]) -> Table:
    names = [name for _, _, name in KINDS if any(name in load.kinds for load in loads)]
    rows = []
    for name in names:
        some = [load.kinds[name] for load in loads if name in load.kinds]
        requests, size, last = (median(values) for values in zip(*some, strict=True))
        rows.append((name, round(requests), round(size), last))
    return Table(
        "What a first visit loads",
        "Medians; the last of each kind arrived so long after the start of the navigation.",
        (
            Column("kind", "kind"),
            Column("requests", "requests", count),
            Column("bytes", "bytes", count),
            Column("last", "last arrived, ms", ms),
        ),
        sorted(rows, key=lambda row: row[3]),
    )


def _moving(readings: list[dict[str, Any]]) -> Table:
    frames = [reading["frame"] for reading in readings if reading["frame"] is not None]
    last = readings[-1]
    return Table(
        "The page in motion",
        f"The page's own readings over {SAMPLE_SECONDS:g} s; it draws fewer pixels where frames take too long.",
        (
            Column("frame", "a frame, ms", ms),
            Column("fps", "frames/s", lambda value: f"{value:.0f}"),
            Column("width", "width", count),
            Column("height", "height", count),
            Column("scale", "scale", lambda value: f"{value:.2f}"),
        ),
        [
            (
                median(frames) / 1000.0 if frames else None,
                median(reading["fps"] for reading in readings),
                last["width"],
                last["height"],
                last["scale"],
            )
        ],
    )
