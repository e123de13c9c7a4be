"""Pieces of work, each a preset's: frames of one tier, or one frame against its stored truth. Run in worker processes.

Plans, programs and textures are made by several workers at once; only one at a time draws.
"""

import fcntl
import time as clock
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from statistics import median

from bench.drawn.frames import STEP
from bench.gpu.timers import PassTimer, distrust, loads, plausible
from references.bake import TIMES, truth_is_current
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset
from seafoam.textures.store import spec_of, texture
from support.exact import UNFILTERED
from support.parity import Parity, faults, parity

Size = tuple[int, int]
PARITY = "parity"
ROUNDS = 60
LEAST_ROUNDS = 3
ROUNDS_SECONDS = 0.3
"""Long enough for a GPU that saved power to be at its usual clock."""
FIRST: Tier = "standard"


@dataclass(frozen=True)
class Draw:
    """Frames of a preset at a tier."""

    preset: str
    tier: Tier
    size: Size

    @property
    def kind(self) -> str:
        """What takes about as long."""
        return f"{self.tier}, {self.size[0]} × {self.size[1]}"

    def __str__(self) -> str:
        return f"{self.preset}, {self.kind}"


@dataclass(frozen=True)
class Judge:
    """A frame of a preset against its stored truth."""

    preset: str
    time: float

    @property
    def kind(self) -> str:
        """What takes about as long."""
        return PARITY

    def __str__(self) -> str:
        return f"{self.preset}, parity at {self.time:g} s"


Task = Draw | Judge


@dataclass(frozen=True)
class Drawn:
    """Times of a preset's frames, s. ``ready``: plan, programs and textures made; ``first``: the first frame.

    ``passes``: medians of timer queries by kind of pass, empty where they are not believed; ``faults``: of the picture.
    """

    task: Draw
    ready: float
    first: float
    passes: dict[str, float]
    wall: float
    rounds: int
    faults: tuple[str, ...]

    @property
    def query(self) -> float | None:
        """Of a frame on the GPU, None where that is not known."""
        return sum(self.passes.values()) or None

    @property
    def seconds(self) -> float:
        """Of a frame on the GPU, or where that is not known, of the clock."""
        return self.wall if self.query is None else self.query


@dataclass(frozen=True)
class Judged:
    """A frame's distance from its truth."""

    task: Judge
    parity: Parity

    @property
    def faults(self) -> tuple[str, ...]:
        """The bounds that do not hold."""
        return tuple(self.parity.exceeded())


class StaleTruthError(RuntimeError):
    """The stored frame shows an earlier form of the preset."""


def order(presets: Iterable[str], size: Size, large: Size | None) -> list[Task]:
    """All pieces of work, the more important first: what is left out for lack of time is at the end.

    ``large``: another size for the first tier.
    """
    names = list(presets)
    *others, last = TIMES
    tasks: list[Task] = []
    for name in names:
        tasks += [Draw(name, FIRST, size), Judge(name, others[-1])]
    tasks += [Draw(name, tier, size) for tier, name in product(TIERS, names) if tier != FIRST]
    tasks += [Draw(name, FIRST, large) for name in names if large is not None]
    tasks += [Judge(name, time) for time, name in product((last, *others[:-1]), names)]
    return tasks


_device: int | None
_turn: Path
_queries: bool


def start(device: int | None, turn: Path, queries: bool) -> None:
    """Prepare this process. ``turn``: a file whose lock is held by who draws; ``queries``: whether to time by them."""
    global _device, _turn, _queries
    _device, _turn, _queries = device, turn, queries


@cache
def _executor() -> Executor:
    # With the first piece of work, which fails alone where this does.
    return Executor(_device)


@contextmanager
def _alone() -> Iterator[None]:
    # A lock of the system's: it falls with the process that holds it.
    with _turn.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def timers() -> str:
    """Why this device's timer queries cannot be believed; empty if they can."""
    with _alone():
        return distrust(loads(_executor()))


def perform(task: Task) -> Drawn | Judged:
    """Do a piece of work."""
    return _draw(task) if isinstance(task, Draw) else _judge(task)


def _draw(task: Draw) -> Drawn:
    began = clock.perf_counter()
    found = load_preset(task.preset)
    plan = make_plan(found.scene, TIERS[task.tier])
    _prepare(plan)
    ready = clock.perf_counter() - began
    width, height = task.size
    camera = found.scene.camera
    executor = _executor()
    timer = PassTimer(executor)
    walls: list[float] = []
    queries: list[dict[str, float]] = []
    with _alone():
        began = clock.perf_counter()
        executor.render(plan, time=found.time, camera=camera, width=width, height=height, output="rgba8")
        first = clock.perf_counter() - began
        light = executor.render(plan, time=found.time, camera=camera, width=width, height=height, output="linear")
        until = clock.perf_counter() + ROUNDS_SECONDS
        while len(walls) < LEAST_ROUNDS or (len(walls) < ROUNDS and clock.perf_counter() < until):
            at = found.time + STEP * (len(walls) + 1)
            with timer.running():
                frame = executor.render(plan, time=at, camera=camera, width=width, height=height, output="rgba8")
            walls.append(frame.timings["render"])
            queries.append(timer.seconds())
    if TIERS[task.tier].samples > 1:
        # Its targets are large, and no later piece of this process may want them.
        executor.forget()
    frames = zip(queries, walls, strict=True)
    believed = _queries and all(plausible(sum(passes.values()), wall) for passes, wall in frames)
    # Not every frame draws every pass.
    kinds = sorted(set().union(*queries))
    return Drawn(
        task,
        ready,
        first,
        {name: median(passes.get(name, 0.0) for passes in queries) for name in kinds} if believed else {},
        median(walls),
        len(walls),
        tuple(faults(light.pixels)),
    )


def _prepare(plan: FramePlan) -> None:
    """Make what the first frame would wait for, with no need to draw."""
    for program in plan.programs.values():
        _executor()._program(program)
    for model in plan.textures.values():
        texture(spec_of(model.url))


def _judge(task: Judge) -> Judged:
    scene = load_preset(task.preset).scene
    if not truth_is_current(f"{task.preset}.same.{task.time:.1f}", scene):
        raise StaleTruthError("the stored frame shows an earlier form of the preset")
    _prepare(make_plan(scene, UNFILTERED))
    with _alone():
        return Judged(task, parity(_executor(), task.preset, task.time))
