"""The page: time and bytes until its first picture and live water, its frame rate, and the cost of overlays."""

import os
import time
from dataclasses import dataclass
from statistics import median
from typing import Any

from playwright.sync_api import Browser, Page, Playwright, sync_playwright

from bench.report import Column, Table, count, ms
from bench.served.server import HOST
from bench.watch import Watch
from support.browser.lanes import COMMON, LANES, chromium, launched

__all__ = ["launched", "measure"]

SIZE = (1280, 720)
READY_SECONDS = 60.0
QUIET_SECONDS = 30.0
REST_SECONDS = 1.5
SETTLED_SECONDS = 15.0
"""Time after the start of navigation from which the frame rate is steady, s."""
SAMPLE_SECONDS = 4.0
SAMPLES = 16
OVERLAY_SCALE = 0.25
"""Resolution of the water while the overlays' cost is measured, low enough for that cost to dominate a frame."""
OVERLAY_SECONDS = 3.0
OVERLAY_PAIRS = 4

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
    new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) window.benchStill ??= entry.renderTime;
    }).observe({ type: "element", buffered: true });
"""
"""Records when the still and the first live frame are shown, ms from the start of navigation."""

_ENTRIES = """() => [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")]
    .map(({ name, responseEnd, transferSize }) => ({ name, responseEnd, transferSize }))"""

KINDS = (
    ("/assets/", ".js", "JavaScript"),
    ("/assets/", ".css", "CSS"),
    ("/api/plans", "", "plan"),
    ("/api/textures/", "", "textures"),
    ("/stills/", ".small.webp", "thumbnails"),
    ("/stills/", "", "still"),
    ("/api/schema", "", "Schema of scenes and qualities"),
    ("/api/", "", "presets, names"),
    ("/", "/", "HTML"),
    ("/", "", "other"),
)
"""Beginning and end of an address, and its kind; the first match counts."""
MOVING = "/api/streams"
"""The server's frames in motion, which have no end."""


@dataclass(frozen=True)
class Load:
    """One load of the page: seconds until the still and until live water, bytes until then; by kind: requests, bytes,
    seconds until the last."""

    still: float | None
    ready: float
    needed: int
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
    """Open the page in new browsers; returns their description, and the tables."""
    address = f"http://{HOST}:{port}/"
    loads: dict[str, tuple[list[Load], list[Load]]] = {lane: ([], []) for lane in LANES}
    motion: dict[str, list[dict[str, Any]]] = {lane: [] for lane in LANES}
    overlays: dict[str, tuple[list[float], list[float]]] = {}
    about: dict[str, str] = {}
    with sync_playwright() as playwright:
        for _ in watch.rounds("first picture of the page", 3, 120.0, least=1):
            for lane, (first, again) in loads.items():
                browser = _launched(playwright, lane)
                try:
                    _wake(browser, address)
                    page = _page(browser)
                    began = time.monotonic()
                    first.append(_load(page, address))
                    about["Chromium"] = browser.version
                    about[f"Chromium's renderer, {lane}"] = page.evaluate("window.seafoam.renderer")
                    motion[lane] += _motion(page, began + SETTLED_SECONDS)
                    again.append(_load(page, address))
                    if lane not in overlays:
                        overlays[lane] = _overlays(page, address)
                finally:
                    browser.close()
    first = loads["llvmpipe"][0]
    return about, [_visits(loads), _kinds(first), _moving(motion), _covered(overlays)]


def _launched(playwright: Playwright, lane: str) -> Browser:
    """A browser with an empty profile; its driver's shader cache is disabled."""
    environment: dict[str, str | float | bool] = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "true"}
    return playwright.chromium.launch(executable_path=chromium(), args=[*COMMON, *LANES[lane]], env=environment)


def _wake(browser: Browser, address: str) -> None:
    """Make the browser paint once, so that starting its processes is not counted as the page's time."""
    page = browser.new_page()
    page.goto(f"{address}icon.svg", wait_until="load")
    page.screenshot()
    page.close()


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
    needed = 0
    for entry in _settled(page):
        needed += entry["transferSize"] if entry["responseEnd"] <= ready else 0
        path = "/" + entry["name"].removeprefix(address).split("?")[0].split("#")[0]
        if path.startswith(MOVING):
            continue
        kind = next(name for begin, end, name in KINDS if path.startswith(begin) and path.endswith(end))
        requests, size, last = kinds.get(kind, (0, 0, 0.0))
        kinds[kind] = (requests + 1, size + entry["transferSize"], max(last, entry["responseEnd"] / 1000.0))
    still = page.evaluate("window.benchStill ?? null")
    return Load(None if still is None else still / 1000.0, ready / 1000.0, needed, kinds)


def _settled(page: Page) -> list[dict[str, Any]]:
    """Resources that the page has loaded, once none but moving frames have arrived for a while or the time is up."""
    until = time.monotonic() + QUIET_SECONDS
    entries: list[dict[str, Any]] = []
    while time.monotonic() < until:
        page.wait_for_timeout(1000 * REST_SECONDS)
        before, entries = entries, [e for e in page.evaluate(_ENTRIES) if e["name"].startswith("http")]
        if all(MOVING in entry["name"] for entry in entries[len(before) :]):
            break
    return entries


def _motion(page: Page, begin: float) -> list[dict[str, Any]]:
    """The page's own measurements while the sea moves."""
    page.wait_for_timeout(1000.0 * max(0.0, begin - time.monotonic()))
    readings = []
    for _ in range(SAMPLES):
        page.wait_for_timeout(1000.0 * SAMPLE_SECONDS / SAMPLES)
        readings.append(page.evaluate("window.seafoam.state().timing"))
    return readings


def _overlays(page: Page, address: str) -> tuple[list[float], list[float]]:
    """Seconds from frame to frame with and without the overlays, in turn."""
    page.goto("about:blank")
    page.goto(f"{address}#scale={OVERLAY_SCALE}", wait_until="load", timeout=1000 * READY_SECONDS)
    page.wait_for_function("() => window.benchReady !== undefined", timeout=1000 * READY_SECONDS)
    page.wait_for_timeout(1000.0 * REST_SECONDS)
    seconds: tuple[list[float], list[float]] = ([], [])
    hide = (
        "(hidden) => document.body.querySelectorAll(':scope > :not(#stage)')"
        ".forEach((part) => { part.style.display = hidden ? 'none' : ''; })"
    )
    count_frames = "() => [window.seafoam.state().timing.frames, performance.now()]"
    for index in range(2 * OVERLAY_PAIRS):
        page.evaluate(hide, index % 2 == 1)
        page.wait_for_timeout(500.0)
        frames, at = page.evaluate(count_frames)
        page.wait_for_timeout(1000.0 * OVERLAY_SECONDS)
        later, until = page.evaluate(count_frames)
        seconds[index % 2].append((until - at) / 1000.0 / max(1, later - frames))
    return seconds


def _visits(loads: dict[str, tuple[list[Load], list[Load]]]) -> Table:
    visits = [
        (f"{name}, {lane}", some)
        for lane, (first, again) in loads.items()
        for name, some in (("first", first), ("again, same browser", again))
    ]
    return Table(
        "The page's first picture",
        "From the start of the navigation until the preset's still is painted and until the first live frame is done, "
        f"{SIZE[0]} x {SIZE[1]}; medians. First visit: a browser that runs and has seen nothing. Bytes: as "
        "transferred, until live water, and in all but the server's frames in motion.",
        (
            Column("visit", "visit"),
            Column("still", "first picture, ms", ms),
            Column("ready", "live water, ms", ms),
            Column("requests", "requests", count),
            Column("needed", "bytes until live water", count),
            Column("bytes", "bytes", count),
        ),
        [
            (
                name,
                median(stills) if (stills := [load.still for load in some if load.still is not None]) else None,
                median(load.ready for load in some),
                round(median(load.requests for load in some)),
                round(median(load.needed for load in some)),
                round(median(load.bytes for load in some)),
            )
            for name, some in visits
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


def _moving(motion: dict[str, list[dict[str, Any]]]) -> Table:
    return Table(
        "The page in motion",
        f"The page's own readings over {SAMPLE_SECONDS:g} s from {SETTLED_SECONDS:g} s after the navigation; it draws "
        "fewer pixels where frames take too long. A frame: the water alone.",
        (
            Column("renderer", "renderer"),
            Column("frame", "a frame, ms", ms),
            Column("fps", "frames/s", lambda value: f"{value:.0f}"),
            Column("width", "width", count),
            Column("height", "height", count),
            Column("scale", "scale", lambda value: f"{value:.2f}"),
        ),
        [
            (
                lane,
                median(frames) / 1000.0 if frames else None,
                median(reading["fps"] for reading in readings),
                readings[-1]["width"],
                readings[-1]["height"],
                median(reading["scale"] for reading in readings),
            )
            for lane, readings in motion.items()
            if (frames := [reading["frame"] for reading in readings if reading["frame"] is not None]) or readings
        ],
    )


def _covered(overlays: dict[str, tuple[list[float], list[float]]]) -> Table:
    return Table(
        "What lies over the water",
        f"From frame to frame with all of the page over the water and without, in turn {OVERLAY_PAIRS} times, the "
        f"water at {OVERLAY_SCALE:g} of the resolution; medians.",
        (
            Column("renderer", "renderer"),
            Column("with", "with, ms", ms),
            Column("without", "without, ms", ms),
            Column("cost", "difference, ms", ms),
        ),
        [
            (lane, median(covered), median(bare), median(a - b for a, b in zip(covered, bare, strict=True)))
            for lane, (covered, bare) in overlays.items()
        ],
    )
