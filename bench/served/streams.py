"""Twenty pages that want the server to draw for them at once: what each gets, and what is left for others."""

import itertools
import json
import os
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from statistics import median, quantiles

from bench.report import Column, Table, count, ms
from bench.served.server import Answer, ask, connected, probing, resident, running, sure
from bench.watch import Watch
from seafoam.scene import load_preset

PRESET = "default"
SIZE = (640, 360)
PAGES = 20
SECONDS = 20.0
AT_ONCE = 2
"""Frames that a page asks for before the first of them has come."""
STEP = 0.04
"""From frame to frame, s."""
WARM_FRAMES = 30
WARM_TRIES = 5
DEADLINE_SECONDS = 10.0
"""Of the server, as it comes."""
SAMPLE_SECONDS = 0.5
"""Between two readings of the memory."""
MEBIBYTE = 2**20


@dataclass(frozen=True)
class _Page:
    """What one page got: its frames and until when, s; or the seconds after which it may ask again."""

    answers: list[Answer]
    seconds: float
    refused: int | None = None


@dataclass(frozen=True)
class _Run:
    """Twenty pages on one server, and what was asked of it beside them. Memory in bytes: before, at most, after."""

    pages: list[_Page]
    singles: list[Answer]
    health: list[float]
    memory: tuple[float, float, float]


def measure(watch: Watch) -> list[Table]:
    """Measure a server as ``seafoam serve`` starts it, and one that gives every page a stream."""
    runs = {}
    for streams in sorted({os.cpu_count() or 1, PAGES}):
        # With the driver's cache of programs: compiling them may take longer than a frame's deadline.
        settings = {"SEAFOAM_QUEUE": "", "SEAFOAM_STREAMS": str(streams), "MESA_SHADER_CACHE_DISABLE": ""}
        # What compiles ahead has memory of its own, and ends when it is done.
        settings["SEAFOAM_COMPILE_AHEAD"] = "false"
        with running(**settings) as port, watch.step(f"{streams} streams"):
            runs[f"{streams} streams"] = _crowd(port, watch.seconds(SECONDS))
    width, height = SIZE
    return [
        Table(
            "Twenty pages at once",
            f"{PAGES} pages ask for a stream of {PRESET}, {width} x {height}, quality standard, and those that get one "
            f"for frames in motion, {AT_ONCE} at once, for {watch.seconds(SECONDS):g} s. Meanwhile another client asks "
            "for one PNG of that size after the other, each of another time, and /healthz is asked for every 0.1 s. "
            f"One server gives as many streams as it has cores, as it comes, the other {PAGES}. The deadline is "
            f"{DEADLINE_SECONDS:g} s. Memory: the proportional set size of the server and its workers together, before "
            "the pages come, at most, and after they have gone.",
            (Column("what", "what"), *(Column(name.replace(" ", "_"), name) for name in runs)),
            list(zip(_rows(), *(_figures(run) for run in runs.values()), strict=True)),
        )
    ]


def _rows() -> list[str]:
    return [
        "pages with a stream",
        "pages that were refused, and told to wait, s",
        "frames a second, all streams",
        "frames a second of a stream, fewest and most",
        "from request to frame, ms: median and 99 %",
        "frames that did not come",
        "single frames: number, and other than 200",
        "single frames, ms: median and slowest",
        "single frames past the deadline",
        "/healthz, ms: median and 99 %",
        "memory, MiB: before, at most, after",
    ]


def _figures(run: _Run) -> list[str]:
    served = [page for page in run.pages if page.refused is None]
    waits = [page.refused for page in run.pages if page.refused is not None]
    rates = [sum(answer.status == 200 for answer in page.answers) / page.seconds for page in served]
    walls = [answer.wall for page in served for answer in page.answers if answer.status == 200]
    failed = Counter(answer.status for page in served for answer in page.answers if answer.status != 200)
    single = [answer.wall for answer in run.singles]
    return [
        str(len(served)),
        f"{len(waits)}: {min(waits)} to {max(waits)}" if waits else "none",
        f"{sum(rates):.1f}",
        f"{min(rates):.2f}  {max(rates):.2f}",
        _two(median(walls), _slowest(walls)),
        ", ".join(f"{number} × {status}" for status, number in failed.items()) or "none",
        f"{count(len(single))}  {sum(answer.status != 200 for answer in run.singles)}",
        _two(median(single), max(single)),
        str(sum(wall > DEADLINE_SECONDS for wall in single)),
        _two(median(run.health), _slowest(run.health)),
        "  ".join(f"{size / MEBIBYTE:.0f}" for size in run.memory),
    ]


def _two(first: float, second: float) -> str:
    return f"{ms(first)}  {ms(second)}"


def _slowest(seconds: list[float]) -> float:
    return quantiles(seconds, n=100, method="inclusive")[98]


def _crowd(port: int, seconds: float) -> _Run:
    _warm(port)
    before = resident()
    memory: list[float] = []
    singles: list[Answer] = []
    over = threading.Event()

    def single() -> None:
        with connected(port) as connection:
            while not over.is_set():
                singles.append(ask(connection, f"/api/frames/{PRESET}.png?{_view()}&time={1000.0 + len(singles)}"))

    def sample() -> None:
        while not over.wait(SAMPLE_SECONDS):
            memory.append(resident())

    beside = [threading.Thread(target=work) for work in (single, sample)]
    together = threading.Barrier(PAGES)
    with probing(port, "/healthz") as health:
        for thread in beside:
            thread.start()
        try:
            with ThreadPoolExecutor(PAGES) as threads:
                pages = list(threads.map(lambda _: _page(port, seconds, together), range(PAGES)))
        finally:
            over.set()
            for thread in beside:
                thread.join()
    return _Run(pages, singles, health, (before, max(memory), resident()))


def _warm(port: int) -> None:
    """Have what is compiled and allocated once done by a stream and by single frames."""
    with connected(port) as connection:
        # It plans them all as it starts.
        sure(connection, "/api/presets")
        # Compiling may take longer than one deadline; the driver keeps what it has.
        single = f"/api/frames/{PRESET}.png?{_view()}"
        any(ask(connection, single).status == 200 for _ in range(WARM_TRIES))
    stream, _ = _opened(port)
    with connected(port) as connection:
        for moment in range(WARM_FRAMES):
            sure(connection, f"/api/streams/{stream}/frame.jpg?{_view()}&time={moment}")
            sure(connection, f"{single}&time={moment}")
    _close(port, str(stream))


def _page(port: int, seconds: float, together: threading.Barrier) -> _Page:
    """Open a stream together with the other pages, and ask for its frames until the time is up."""
    together.wait()
    stream, refused = _opened(port)
    if stream is None:
        return _Page([], 0.0, refused)
    began = time.perf_counter()
    with ThreadPoolExecutor(AT_ONCE) as threads:
        asked = [threads.submit(_ask, port, stream, start, began + seconds) for start in range(AT_ONCE)]
        answers = [answer for each in asked for answer in each.result()]
    took = time.perf_counter() - began
    _close(port, stream)
    return _Page(answers, took)


def _ask(port: int, stream: str, start: int, until: float) -> list[Answer]:
    """Ask for every :data:`AT_ONCE`-th frame from the given one."""
    answers: list[Answer] = []
    moments = itertools.count(9.0 + start * STEP, AT_ONCE * STEP)
    with connected(port) as connection:
        while time.perf_counter() < until:
            answers.append(ask(connection, f"/api/streams/{stream}/frame.jpg?{_view()}&time={next(moments):.2f}"))
    return answers


def _opened(port: int) -> tuple[str | None, int | None]:
    """Return a new stream's id, or after how many seconds there may be one."""
    with connected(port) as connection:
        connection.request("POST", "/api/streams", _body(), {"Content-Type": "application/json"})
        response = connection.getresponse()
        answer = json.loads(response.read())
    if response.status == 201:
        return answer["id"], None
    if response.status != 503:
        raise RuntimeError(f"a stream was refused with {answer}")
    return None, int(response.headers["Retry-After"])


@cache
def _body() -> str:
    scene = load_preset(PRESET).scene.model_dump(mode="json")
    return json.dumps({"scene": scene, "quality": "standard"})


def _close(port: int, stream: str) -> None:
    with connected(port) as connection:
        connection.request("DELETE", f"/api/streams/{stream}")
        connection.getresponse().read()


@cache
def _view() -> str:
    camera = load_preset(PRESET).scene.camera
    x, y, z = camera.position
    width, height = SIZE
    angles = f"yaw={camera.yaw}&pitch={camera.pitch}&roll={camera.roll}&fov={camera.fov}"
    return f"width={width}&height={height}&x={x}&y={y}&z={z}&{angles}"
