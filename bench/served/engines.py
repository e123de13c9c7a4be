"""Moving water in Chromium without a GPU, by the way of starting it: what is seen from outside."""

import time
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Any

from playwright.sync_api import Playwright, sync_playwright

from bench.report import Column, Table, count, ms
from bench.served.server import HOST
from bench.watch import Watch
from support.browser.starts import STARTS, WINDOWS, Started, browser_started, opened

FIRST_SECONDS, SETTLED_SECONDS, END_SECONDS = 5.0, 10.0, 13.0
"""After the start of navigation: gaps count from the first, rates from the second, until the third."""
PLAY_SECONDS = 120.0
ROUNDS = {"default": 3, "open-ocean": 1, "storm": 1, "coastline": 1, "boat-race": 1}
"""Presets, and how often each is opened."""
SOFTWARE_GL = (6.0, 0.4)
MUSTS = {
    "default flags": SOFTWARE_GL,
    "ANGLE on GL": SOFTWARE_GL,
    "SwiftShader": SOFTWARE_GL,
    "llvmpipe": (15.0, 0.45),
    "WebGL off": (8.0, 0.5),
}
"""Frames a second and scale to reach on ``default``; half of the rate on the others."""


@dataclass(frozen=True)
class Motion:
    """What was seen of a while of motion. Times in s."""

    fps: float
    """Pictures that were drawn, a second."""
    scale: float
    """Width of the middle picture, of the window's."""
    drawer: str
    gap: float
    """Longest time between two animation frames."""
    still: float
    """Longest time between two pictures."""


@dataclass(frozen=True)
class Seen:
    """One opening of the page. Times in s."""

    steady: Motion
    later: Motion
    """Of all from the first seconds on."""
    moving: float
    """Until the first picture that moves."""
    task: float
    """Longest task of the main thread until then."""
    screenshot: float
    drag: float


@dataclass(frozen=True)
class Played:
    """A while of play. Times in s."""

    gap: float
    still: float
    growth: float
    """Of the memory that the page's scripts hold, MB."""
    messages: int


def measure(port: int, watch: Watch) -> list[Table]:
    """Open the page in new browsers; returns the tables."""
    seen: dict[tuple[str, str], list[Seen]] = {(start, preset): [] for start in STARTS for preset in ROUNDS}
    with sync_playwright() as playwright:
        for index in watch.rounds("ways of starting a browser", max(ROUNDS.values()), 900.0, least=1):
            for (start, preset), openings in seen.items():
                if index < ROUNDS[preset]:
                    openings.append(_see(playwright, start, f"http://{HOST}:{port}/water/{preset}"))
        played = {start: _play(playwright, start, f"http://{HOST}:{port}/", watch) for start in STARTS}
    return [_rates(seen), _plays(played)]


def _rates(seen: dict[tuple[str, str], list[Seen]]) -> Table:
    width, height = WINDOWS["desktop"]
    note = (
        f"{width} x {height}, a new profile of Chromium on the server's own machine, no GPU; the middle of the "
        f"openings of each. Rates from {SETTLED_SECONDS:.0f} to {END_SECONDS:.0f} s after the start of navigation, "
        f"gaps of requestAnimationFrame from {FIRST_SECONDS:.0f} s on. Frames are pictures that were drawn to what is "
        "shown, counted by a script beside the page; scale is their width in the window's. moves: until the first of "
        "them; task: longest task of the main thread until then; drag: from a move of the pointer to the next picture, "
        "middle of six."
    )
    columns = (
        Column("start", "Chromium started with"),
        Column("preset", "preset"),
        Column("drawer", "drawn by"),
        Column("fps", "frames/s", lambda fps: f"{fps:.1f}"),
        Column("must_fps", "must", lambda fps: f"{fps:.1f}"),
        Column("scale", "scale", lambda scale: f"{scale:.2f}"),
        Column("must_scale", "must", lambda scale: f"{scale:.2f}"),
        Column("gap", "gap, ms", ms),
        Column("moving", "moves, ms", ms),
        Column("task", "task, ms", ms),
        Column("screenshot", "screenshot, ms", ms),
        Column("drag", "drag, ms", ms),
    )
    return Table("Ways of starting a browser", note, columns, [_row(*key, found) for key, found in seen.items()])


def _plays(played: dict[str, Played]) -> Table:
    note = (
        "Drags on the water and on the sky, three presets and a divider, again and again: longest gap of "
        "requestAnimationFrame, longest time without a new picture, growth of the memory that the page's scripts hold "
        "after a collection, and messages in the console but Chromium's own about its software GL."
    )
    columns = (
        Column("start", "Chromium started with"),
        Column("gap", "gap, ms", ms),
        Column("still", "no picture, ms", ms),
        Column("growth", "growth, MB", lambda growth: f"{growth:.1f}"),
        Column("messages", "messages", count),
    )
    rows = [(start, one.gap, one.still, one.growth, one.messages) for start, one in played.items()]
    return Table("Play", note, columns, rows)


def _play(playwright: Playwright, start: str, address: str, watch: Watch) -> Played:
    with browser_started(playwright, start) as browser, opened(browser, address, "phone") as page:
        _wait_until(page, END_SECONDS)
        held, began = _heap(page), 1e-3 * _now(page)
        with watch.step(f"play, {start}"):
            page.play(watch.seconds(PLAY_SECONDS))
        seen = _motion(page, began, 1e-3 * _now(page))
        return Played(seen.gap, seen.still, _heap(page) - held, len(page.said()))


def _row(start: str, preset: str, openings: list[Seen]) -> tuple[object, ...]:
    middle = sorted(openings, key=lambda one: one.steady.fps)[len(openings) // 2]
    fps, scale = MUSTS[start]
    return (
        start,
        preset,
        middle.steady.drawer,
        middle.steady.fps,
        fps if preset == "default" else fps / 2,
        middle.steady.scale,
        scale,
        median(one.later.gap for one in openings),
        median(one.moving for one in openings),
        median(one.task for one in openings),
        median(one.screenshot for one in openings),
        median(one.drag for one in openings),
    )


def _see(playwright: Playwright, start: str, address: str) -> Seen:
    with browser_started(playwright, start) as browser, opened(browser, address) as page:
        _wait_until(page, END_SECONDS)
        frames = [1e-3 * frame["at"] for frame in page.frames()]
        if not frames:
            raise RuntimeError(f"{address} shows no moving picture in Chromium with {start}: {page.complaints}")
        task = max((duration for begin, duration in _long_tasks(page) if begin < frames[0]), default=0.0)
        asked = time.monotonic()
        page.page.screenshot()
        screenshot = time.monotonic() - asked
        return Seen(
            steady=_motion(page, SETTLED_SECONDS, END_SECONDS),
            later=_motion(page, FIRST_SECONDS, END_SECONDS),
            moving=frames[0],
            task=task,
            screenshot=screenshot,
            drag=page.drag_seconds(),
        )


def _now(started: Started) -> float:
    """The page's clock, ms since its navigation began."""
    return float(started.page.evaluate("() => performance.now()"))


def _wait_until(started: Started, seconds: float) -> None:
    """Wait for a time after the start of navigation, without asking the page anything in between."""
    while (left := seconds - 1e-3 * _now(started)) > 0:
        time.sleep(min(left, 5.0))


def _motion(started: Started, begin: float, end: float) -> Motion:
    """What was seen between two times after the start of navigation, s."""
    seen: dict[str, Any] = started.page.evaluate("() => window.seen")
    width: float = started.page.evaluate("() => innerWidth * Math.min(2, devicePixelRatio)")
    ticks = [1e-3 * at for at in seen["ticks"]]
    frames = [1e-3 * frame["at"] for frame in seen["frames"]]
    within = [frame for frame in seen["frames"] if begin <= 1e-3 * frame["at"] < end]
    return Motion(
        fps=len(within) / (end - begin),
        scale=median(frame["width"] for frame in within) / width if within else 0.0,
        drawer=within[-1]["by"] if within else "nobody",
        gap=_longest(ticks, begin, end),
        still=_longest(frames, begin, end),
    )


def _long_tasks(started: Started) -> list[tuple[float, float]]:
    """Begin and duration of tasks of the main thread over 50 ms, s."""
    tasks: list[list[float]] = started.page.evaluate("() => window.seen.long")
    return [(1e-3 * begin, 1e-3 * duration) for begin, duration in tasks]


def _heap(started: Started) -> float:
    """Memory that the page's scripts hold after a collection, MB."""
    session = started.page.context.new_cdp_session(started.page)
    session.send("Performance.enable")
    session.send("HeapProfiler.collectGarbage")
    metrics = {one["name"]: one["value"] for one in session.send("Performance.getMetrics")["metrics"]}
    session.detach()
    return 1e-6 * float(metrics["JSHeapUsedSize"])


def _longest(times: list[float], begin: float, end: float) -> float:
    """Longest stretch between two times of [begin, end] without one of these, s."""
    marks = [begin, *(at for at in times if begin < at < end), end]
    return max(later - earlier for earlier, later in pairwise(marks))
