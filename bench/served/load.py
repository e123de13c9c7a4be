"""A server under load: time outside GL, throughput, twice its capacity for a minute, repeats, and a long run."""

import itertools
import re
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from http.client import HTTPException
from statistics import median, quantiles

import numpy as np

from bench.report import Column, Spread, Table, count, ms, times
from bench.served.server import PROBE_SECONDS, Answer, ask, closed_loop, connected, probe, resident, running, sure
from bench.watch import Watch
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset, preset_names

PRESET = "default"
OVERLOAD = 2.0
"""Requests that arrive, over those that the server can draw."""
OVERLOAD_SECONDS = 60.0
REPEAT_SECONDS = 10.0
THROUGHPUT_SECONDS = 8.0
DEADLINE_SECONDS = 10.0
"""Of the server, as it comes."""
OUTSIDE = ("queue", "plan", "read", "encode")
"""Stages in which GL does not draw."""
SOAK_FRAMES = 5000
SOAK_LAPS = 10
"""Parts of the long run, of the same frames; the memory is read after each."""
SOAK_OF_ONE = 16
"""Frames of one preset in a row."""
MEBIBYTE = 2**20


@dataclass(frozen=True)
class _Reply:
    """How a request ended: its status, 0 for none, and when."""

    status: int
    seconds: float
    ended: float


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Measure servers of their own, as ``seafoam serve`` starts them but for what the tables say."""
    with running() as port:
        tables = [_outside_gl(port, watch), _throughput(executor, port, watch)]
    executor.forget()
    with running(SEAFOAM_QUEUE="") as port:
        tables.append(_overload(port, watch))
    with running(SEAFOAM_CACHE_SIZE="", SEAFOAM_CACHE_MEMORY="") as port:
        tables.append(_repeats(port, watch))
    return tables


def soak(watch: Watch) -> list[Table]:
    """Draw frames of all presets in many sizes, qualities and formats, and read the memory of every process."""
    # With the driver's cache of programs, as users have it: else most of the time would go by while they are compiled.
    with running(MESA_SHADER_CACHE_DISABLE="") as port:
        return [_soak(port, watch)]


def _moments() -> Iterator[str]:
    return (f"{9.0 + 0.37 * index:.2f}" for index in itertools.count())


def _outside_gl(port: int, watch: Watch) -> Table:
    """Wall time of a request less the time for which GL drew, one client."""
    forms = {"exact": "&dither=false", "dithered": ""}
    outside: dict[str, list[float]] = {name: [] for name in forms}
    stages: dict[str, list[Answer]] = {name: [] for name in forms}
    moments = _moments()
    with connected(port) as connection:
        for index in watch.rounds("time outside GL", 40, 40.0):
            for name, query in forms.items():
                answer = sure(connection, f"/api/frames/{PRESET}.png?time={next(moments)}{query}")
                if index > 0:
                    outside[name].append(answer.wall - answer.stages["render"])
                    stages[name].append(answer)
    width, height = load_preset(PRESET).size
    return Table(
        "Time outside GL",
        f"A PNG of {PRESET}, {width} x {height}, quality standard, each of another time, one client: wall "
        "time less the "
        "stage render. The way to the worker and back is in queue.",
        (
            Column("form", "PNG"),
            Column("outside", "outside GL, ms", _spread),
            Column("least", "least", ms),
            Column("queue", "queue", ms),
            Column("plan", "plan", ms),
            Column("read", "read", ms),
            Column("encode", "encode", ms),
            Column("requests", "requests", count),
        ),
        [
            (
                name,
                Spread.of(outside[name]),
                min(outside[name]),
                *(median(answer.stages[stage] for answer in stages[name]) for stage in OUTSIDE),
                len(outside[name]),
            )
            for name in forms
        ],
    )


def _spread(seconds: Spread) -> str:
    return f"{ms(seconds.median)}  ({ms(seconds.low)} to {ms(seconds.high)})"


def _throughput(executor: Executor, port: int, watch: Watch) -> Table:
    """Frames a second of the server with one worker, and of a loop that only draws, in turn."""
    preset = load_preset(PRESET)
    width, height = preset.size
    plan = make_plan(preset.scene, TIERS["standard"])
    moments = _moments()

    def draw() -> None:
        executor.render(
            plan, time=float(next(moments)), camera=preset.scene.camera, width=width, height=height, output="rgba16"
        )

    draw()
    served: list[float] = []
    bare: list[float] = []
    for _ in watch.rounds("throughput, in turn with a bare loop", 5, 90.0):
        bare.append(_rate(draw, watch.seconds(THROUGHPUT_SECONDS)))
        served.append(_capacity(port, moments, watch.seconds(THROUGHPUT_SECONDS)))
    return Table(
        "Throughput",
        f"PNG of {PRESET}, {width} x {height}, quality standard, dithered, for two clients, against a loop that draws "
        "the same plan with 16 bits a channel and reads it, without encoding; "
        f"{watch.seconds(THROUGHPUT_SECONDS):g} s each in turn.",
        (
            Column("bare", "loop, frames/s", lambda value: f"{value:.2f}"),
            Column("served", "server, frames/s", lambda value: f"{value:.2f}"),
            Column("ratio", "server / loop", times),
            Column("rounds", "rounds", count),
        ),
        [(median(bare), median(served), Spread.of([a / b for a, b in zip(served, bare, strict=True)]), len(bare))],
    )


def _rate(draw: Callable[[], None], seconds: float) -> float:
    began = time.perf_counter()
    done = 0
    while time.perf_counter() - began < seconds:
        draw()
        done += 1
    return done / (time.perf_counter() - began)


def _capacity(port: int, moments: Iterator[str], seconds: float) -> float:
    """Frames a second for two clients that ask as soon as they are answered."""
    paths = (f"/api/frames/{PRESET}.png?time={moment}" for moment in moments)
    return answered(*closed_loop(port, paths, 2, seconds))


def answered(answers: Sequence[Answer], seconds: float) -> float:
    """Answers a second, all of which must be 200."""
    refused = Counter(answer.status for answer in answers if answer.status != 200)
    if refused:
        raise RuntimeError(f"requests were answered with {dict(refused)}")
    return len(answers) / seconds


def _overload(port: int, watch: Watch) -> Table:
    """Requests at twice the rate of what can be drawn, whether or not earlier ones are answered."""
    moments = _moments()
    _capacity(port, moments, 2.0)
    seconds = watch.seconds(OVERLOAD_SECONDS)
    with watch.step("capacity"):
        capacity = _capacity(port, moments, seconds / 3)
    replies: list[_Reply] = []
    probes: dict[str, list[float]] = {"/healthz": [], "/": []}
    over = threading.Event()
    watchers = [threading.Thread(target=probe, args=(port, path, found, over)) for path, found in probes.items()]
    with watch.step(f"{OVERLOAD:g} times the capacity"), ThreadPoolExecutor(256) as threads:
        for watcher in watchers:
            watcher.start()
        began = time.perf_counter()
        sent: list[Future[_Reply]] = []
        for index in range(round(seconds * OVERLOAD * capacity)):
            time.sleep(max(0.0, began + index / (OVERLOAD * capacity) - time.perf_counter()))
            sent.append(threads.submit(_once, port, f"/api/frames/{PRESET}.png?time={next(moments)}"))
        replies = [each.result() for each in sent]
        over.set()
        for watcher in watchers:
            watcher.join()
    ended = Counter(reply.status for reply in replies)
    good = [reply.seconds for reply in replies if reply.status == 200]
    within = sum(reply.status == 200 and reply.ended - began <= seconds for reply in replies)
    statuses = ", ".join(f"{number:,} × {status or 'no answer'}" for status, number in sorted(ended.items()))
    late = sum(reply.seconds > DEADLINE_SECONDS for reply in replies)
    health, page = (quantiles(probes[path], n=100, method="inclusive") for path in probes)
    return Table(
        "Twice the capacity",
        f"PNG of {PRESET}, each of another time, one worker, a queue of two, the deadline {DEADLINE_SECONDS:g} s. "
        f"Capacity: two clients, each asking when it is answered. Then requests arrive at {OVERLOAD:g} times that rate "
        f"for {seconds:g} s, each over a connection of its own, and health and page are asked for every "
        f"{PROBE_SECONDS:g} s.",
        (Column("what", "what"), Column("value", "measured")),
        [
            ("capacity, frames a second", f"{capacity:.2f}"),
            ("requests and how they ended", statuses),
            ("past the deadline", count(late)),
            ("goodput, frames a second", f"{within / seconds:.2f}"),
            ("goodput / capacity", f"{within / seconds / capacity:.2f}"),
            ("frames, ms: median and slowest", f"{ms(median(good))}  {ms(max(good))}"),
            ("/healthz, ms: median and 99 %", f"{ms(health[49])}  {ms(health[98])}"),
            ("the page's HTML, ms: median and 99 %", f"{ms(page[49])}  {ms(page[98])}"),
        ],
    )


def _once(port: int, path: str) -> _Reply:
    began = time.perf_counter()
    try:
        with connected(port) as connection:
            status = ask(connection, path).status
    except (OSError, HTTPException):
        status = 0
    ended = time.perf_counter()
    return _Reply(status, ended - began, ended)


def _repeats(port: int, watch: Watch) -> Table:
    """Requests for what was drawn before, from memory and from disk, two clients."""
    # Memory holds 64 MiB: sixteen pictures of a megabyte stay there, a hundred of them do not.
    pictures = {
        "memory, 16 PNG of 1280 × 720": [f"/api/frames/{PRESET}.png?time={index}" for index in range(16)],
        "memory, 16 WebP of 320 × 180": [
            f"/api/frames/{PRESET}.webp?width=320&height=180&time={index}" for index in range(16)
        ],
        "disk, 100 PNG of 1280 × 720": [f"/api/frames/{PRESET}.png?time={index}" for index in range(100)],
    }
    with watch.step("frames to repeat"), connected(port) as connection:
        for path in dict.fromkeys(itertools.chain.from_iterable(pictures.values())):
            sure(connection, path)
    rows = []
    for name, paths in pictures.items():
        with watch.step(name):
            with connected(port) as connection:
                size = [sure(connection, path).size for path in paths][-1]
            before = _origins(port)
            rate = answered(*closed_loop(port, itertools.cycle(paths), 2, watch.seconds(REPEAT_SECONDS)))
            after = _origins(port)
        origin = max(after, key=lambda each: after[each] - before.get(each, 0.0))
        rows.append((name, origin, rate, size))
    return Table(
        "Repeats",
        f"Frames that were drawn before, by two clients for {watch.seconds(REPEAT_SECONDS):g} s each, with the caches "
        "of seafoam serve. Origin: which cache answered most of them, by the server's counters.",
        (
            Column("what", "what"),
            Column("origin", "origin"),
            Column("rate", "a second", lambda value: f"{value:.0f}"),
            Column("bytes", "bytes each", count),
        ),
        rows,
    )


def _origins(port: int) -> dict[str, float]:
    """Frames by where they came from, as the server counts them."""
    with connected(port) as connection:
        connection.request("GET", "/metrics")
        text = connection.getresponse().read().decode()
    found = re.findall(r'seafoam_frame_origins_total\{origin="(\w+)"\} ([\d.e+]+)', text)
    return {name: float(value) for name, value in found}


def _soak(port: int, watch: Watch) -> Table:
    """A long run of frames that differ in everything, by one client."""
    lap = round(watch.seconds(SOAK_FRAMES) / SOAK_LAPS)
    presets, moments = preset_names(), np.random.default_rng(5)
    memory: list[tuple[int, float]] = []
    refused: Counter[int] = Counter()
    with watch.step(f"{SOAK_LAPS} times {lap} mixed frames"), connected(port) as connection:
        for number in range(SOAK_LAPS):
            # The same in every lap, but for the time: at its end the caches hold the same.
            random = np.random.default_rng(17)
            for index in range(lap):
                width, height = (int(side) for side in random.integers(16, 320, 2))
                form = random.choice(["png", "webp", "exr", "npy"])
                if index % SOAK_OF_ONE == 0:
                    preset, tier = random.choice(presets), random.choice(["fast", "standard"], p=[0.9, 0.1])
                moment = moments.uniform(0.0, 1e4)
                path = f"/api/frames/{preset}.{form}?time={moment:.3f}&width={width}&height={height}&quality={tier}"
                status = ask(connection, path).status
                if status != 200:
                    refused[status] += 1
            memory.append(((number + 1) * lap, resident()))
    # The first third fills the caches.
    late = np.array(memory[len(memory) // 3 :])
    slope = float(np.polynomial.Polynomial.fit(late[:, 0], late[:, 1], 1).convert().coef[1]) * 1000.0
    return Table(
        "A long run",
        f"{SOAK_LAPS} laps of the same {lap:,} frames but for their times: random presets, {SOAK_OF_ONE} in a row, "
        "sizes from 16 to 320 pixels a side, formats and, one in ten, quality standard instead of fast. Memory: the "
        "proportional set size of the server and its workers together after each lap; slope: the straight line through "
        "the last two thirds.",
        (Column("what", "what"), Column("value", "measured")),
        [
            ("answers other than 200", ", ".join(f"{n} × {status}" for status, n in refused.items()) or "none"),
            ("memory after a third, MiB", f"{late[0, 1] / MEBIBYTE:.1f}"),
            ("memory at the end, MiB", f"{late[-1, 1] / MEBIBYTE:.1f}"),
            ("slope, MiB for 1,000 frames", f"{slope / MEBIBYTE:+.2f}"),
        ],
    )
