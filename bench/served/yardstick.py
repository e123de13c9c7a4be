"""Frames and pictures compared with three.js's ``Water`` and ``Sky``, in turn, in one run."""

import itertools
import time as clock
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from http.client import HTTPConnection
from statistics import fmean, median

from bench.drawn.frames import STEP, Cost, cost
from bench.drawn.steps import Steps, steps
from bench.report import Column, Spread, Table, count, ms, times
from bench.served.server import connected, sure
from bench.served.water_page import SIZE, Frames, WaterPage
from bench.watch import Watch
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset

ROUNDS = 3
ROUNDS_SECONDS = 900.0
MEASURED: tuple[Tier, ...] = ("standard", "fast")
THREE_FRAMES = 5
"""Number of three.js's frames before and after those of a preset."""
MOST_FRAMES = 5
LEAST_FRAMES = 2
FRAMES_SECONDS = 0.6
"""Frames of a preset in a round: maximum, minimum, and time after which no more are drawn, s."""
PICTURES = ("default", "open-ocean")
PICTURE_ROUNDS = 9


@dataclass(frozen=True)
class Group:
    """Presets of a kind, and the maximum time of their frames over that of three.js: required and targeted."""

    name: str
    presets: tuple[str, ...]
    must: Mapping[Tier, float]
    aim: Mapping[Tier, float]


def _group(name: str, must: tuple[float, float], aim: tuple[float, float], *presets: str) -> Group:
    """A group by its limits of tier ``standard`` and of ``fast``."""
    return Group(name, presets, *(dict(zip(MEASURED, limits, strict=True)) for limits in (must, aim)))


GROUPS = (
    _group(
        "the paper's", (1.8, 1.2), (1.4, 0.9), "paper-textured", "paper-halftone", "paper-halftone-textured",
        "paper-benchmark", "paper-height", "paper-wake",
    ),
    _group("calm sea", (3.5, 2.0), (2.0, 1.0), "default"),
    _group("calm sea with a boat", (7.0, 4.0), (4.0, 2.0), "shallows", "moonlight"),
    _group(
        "open sea, river", (8.0, 4.5), (4.0, 2.0), "open-ocean", "storm", "swell", "lake-choppy",
        "sunset-sparkles", "river",
    ),
    _group("drift, pool, calm lake", (5.0, 3.0), (3.0, 1.5), "drift-vortices", "pool-caustics", "lake-calm"),
    _group("mirrors", (6.0, 4.0), (4.0, 2.0), "lake-sunset", "cubemap-lake"),
    _group(
        "shores, spray, blast", (9.0, 5.0), (5.0, 2.5), "island-surf", "coastline", "beach", "lagoon",
        "murky-estuary", "spray-on-rocks", "explosion", "breaker",
    ),
    _group("boats in waves", (14.0, 8.0), (8.0, 4.0), "boat-in-storm", "boat-race"),
)  # fmt: skip
PICTURE_MUST = {"default": 0.6, "open-ocean": 1.5}
"""Maximum time of a PNG over HTTP, over that of a warm screenshot of three.js's page."""


@dataclass
class Measured:
    """Rounds of a preset: its frames, and those of three.js immediately before and after."""

    ours: list[list[Cost]] = field(default_factory=list)
    theirs: list[list[Frames]] = field(default_factory=list)

    def add(self, ours: list[Cost], theirs: list[Frames]) -> None:
        """Add a round."""
        self.ours.append(ours)
        self.theirs.append(theirs)

    @property
    def wall(self) -> list[float]:
        """For each round: the median frame time over three.js's."""
        return [median(frame.wall for frame in ours) / self._three(i) for i, ours in enumerate(self.ours)]

    @property
    def cpu(self) -> list[float]:
        """For each round: the mean processor time of a frame over three.js's."""
        pairs = zip(self.ours, self.theirs, strict=True)
        return [fmean(frame.cpu for frame in ours) / fmean(frame.cpu for frame in theirs) for ours, theirs in pairs]

    @property
    def frames(self) -> list[float]:
        """Time of every frame over three.js's median frame time of its round."""
        return [frame.wall / self._three(i) for i, ours in enumerate(self.ours) for frame in ours]

    @property
    def seconds(self) -> float:
        """The median frame."""
        return median(frame.wall for ours in self.ours for frame in ours)

    @property
    def three_seconds(self) -> float:
        """Three.js's median frame."""
        return median(self._three(i) for i in range(len(self.theirs)))

    def _three(self, index: int) -> float:
        return median(itertools.chain.from_iterable(block.wall for block in self.theirs[index]))


def measure(executor: Executor, three: WaterPage, presets: Sequence[str], watch: Watch) -> list[Table]:
    """Draw the presets and three.js in turn, round by round; then count the work per pixel."""
    measured: dict[Tier, dict[str, Measured]] = {tier: {name: Measured() for name in presets} for tier in MEASURED}
    for index in watch.rounds("against three.js", ROUNDS, ROUNDS_SECONDS, least=1):
        before = three.frames(THREE_FRAMES)
        for name, tier in itertools.product(presets, MEASURED):
            ours = list(_frames(executor, name, tier, index))
            after = three.frames(THREE_FRAMES)
            measured[tier][name].add(ours, [before, after])
            before = after
    counted: dict[str, Steps] = {}
    with watch.step("counting"):
        for name in presets:
            preset = load_preset(name)
            plan = make_plan(preset.scene, TIERS["standard"])
            counted[name] = steps(executor, plan, time=preset.time, camera=preset.scene.camera, size=SIZE)
    return [_against_three(measured["standard"], measured["fast"], counted), _groups(measured)]


def _frames(executor: Executor, name: str, tier: Tier, index: int) -> Iterator[Cost]:
    """Frames of a preset in one round, each at a different time, after one that compiles and uploads."""
    preset = load_preset(name)
    plan = make_plan(preset.scene, TIERS[tier])
    moments = (preset.time + STEP * (index * (MOST_FRAMES + 1) + i) for i in itertools.count())
    cost(executor, plan, preset.scene.camera, SIZE, next(moments))
    began = clock.perf_counter()
    for drawn in range(MOST_FRAMES):
        if drawn >= LEAST_FRAMES and clock.perf_counter() - began > FRAMES_SECONDS:
            break
        yield cost(executor, plan, preset.scene.camera, SIZE, next(moments))


def _factor(value: float) -> str:
    return f"{value:.2f}"


def _against_three(
    standard: Mapping[str, Measured], fast: Mapping[str, Measured], counted: Mapping[str, Steps]
) -> Table:
    rows = []
    for name, one in standard.items():
        spread = Spread.of(one.frames)
        found = counted[name]
        rows.append(
            (
                name,
                one.seconds,
                one.three_seconds,
                median(one.wall),
                spread.low,
                spread.high,
                median(one.cpu),
                len(one.frames),
                fast[name].seconds,
                median(fast[name].wall),
                found.water,
                found.mean,
                found.most,
                found.everywhere,
            )
        )
    rounds = max((len(one.ours) for one in standard.values()), default=0)
    return Table(
        "Against three.js",
        f"Frames of {SIZE[0]} x {SIZE[1]}, quality standard and fast, in turn with three.js's Water and Sky (512 x 512 "
        f"mirror) in Chromium on the same GL. Times and multiples: the middle of {rounds} rounds; quartiles of all "
        "frames. Processor: of all threads, Chromium's processes together. Water: share of the pixels. Evaluations: of "
        "the waves in the surface's pass of standard, mean and 99 % of the pixels of water, and mean of all.",
        (
            Column("preset", "preset"),
            Column("wall", "ms", ms),
            Column("three_wall", "three.js, ms", ms),
            Column("ratio", "x three.js", _factor),
            Column("ratio_low", "quartiles", _factor),
            Column("ratio_high", "", _factor),
            Column("cpu_ratio", "x, processor", _factor),
            Column("frames", "frames", count),
            Column("fast_wall", "fast, ms", ms),
            Column("fast_ratio", "x three.js", _factor),
            Column("water", "water", lambda share: f"{100.0 * share:.0f} %"),
            Column("evaluations", "evaluations", lambda value: f"{value:.1f}"),
            Column("evaluations_99", "99 %", lambda value: f"{value:.0f}"),
            Column("evaluations_everywhere", "all", lambda value: f"{value:.1f}"),
        ),
        rows,
    )


def _groups(measured: Mapping[Tier, Mapping[str, Measured]]) -> Table:
    rows = []
    for tier, group in itertools.product(MEASURED, GROUPS):
        found = {name: median(measured[tier][name].wall) for name in group.presets if name in measured[tier]}
        if found:
            worst = max(found, key=lambda name: found[name])
            within = sum(value <= group.must[tier] for value in found.values())
            must, aim = group.must[tier], group.aim[tier]
            rows.append((tier, group.name, len(found), within, min(found.values()), found[worst], worst, must, aim))
    return Table(
        "Groups against three.js",
        "The least and the greatest multiple of three.js's frame in each group, and what is asked of all of them. The "
        "preset paper-threshold, a picture of the mask alone, belongs to none.",
        (
            Column("tier", "quality"),
            Column("group", "group"),
            Column("presets", "presets", count),
            Column("within", "within must", count),
            Column("least", "least", _factor),
            Column("greatest", "greatest", _factor),
            Column("worst", "which"),
            Column("must", "must", _factor),
            Column("aim", "aim", _factor),
        ),
        rows,
    )


def pictures(port: int, three: WaterPage, watch: Watch) -> Table:
    """PNG files over HTTP from a running server, alternating with screenshots of three.js's page."""
    moments = (f"time={9.0 + STEP * index:.2f}" for index in itertools.count())
    taken: dict[str, list[tuple[float, int]]] = {name: [] for name in PICTURES}
    shots: list[tuple[float, int]] = []
    with connected(port) as connection:
        for name in PICTURES:
            _picture(connection, name, next(moments))
        three.screenshot()
        for _ in watch.rounds("pictures against three.js", PICTURE_ROUNDS, 60.0):
            shots.append(three.screenshot())
            for name in PICTURES:
                taken[name].append(_picture(connection, name, next(moments)))
    rows: list[tuple[object, ...]] = [
        ("three.js, screenshot", median(wall for wall, _ in shots), None, None, *_bytes(shots), len(shots))
    ]
    for name, pairs in taken.items():
        ratio = Spread.of([ours / theirs for (ours, _), (theirs, _) in zip(pairs, shots, strict=True)])
        wall = median(wall for wall, _ in pairs)
        rows.append((f"{name}, PNG over HTTP", wall, ratio, PICTURE_MUST[name], *_bytes(pairs), len(pairs)))
    return Table(
        "A picture as a file, against three.js",
        f"{SIZE[0]} x {SIZE[1]}, quality standard, warm, each of another time, so that nothing is cached; in turn. "
        "Screenshot: the browser's own PNG of a frame drawn for it. Medians; ratios within rounds, with quartiles.",
        (
            Column("picture", "picture"),
            Column("wall", "ms", ms),
            Column("ratio", "x three.js", times),
            Column("must", "must", _factor),
            Column("bytes", "bytes", count),
            Column("rounds", "rounds", count),
        ),
        rows,
    )


def _bytes(pictures: Sequence[tuple[float, int]]) -> tuple[int]:
    return (round(median(size for _, size in pictures)),)


def _picture(connection: HTTPConnection, name: str, moment: str) -> tuple[float, int]:
    answer = sure(connection, f"/api/frames/{name}.png?{moment}&width={SIZE[0]}&height={SIZE[1]}")
    return answer.wall, answer.size
