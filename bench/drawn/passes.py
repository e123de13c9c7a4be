"""Composition of a frame: milliseconds of every pass of every preset, with GL finished around each."""

import re
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any
from unittest.mock import patch

from bench.drawn.frames import STEP, cost
from bench.report import Column, Table, ms
from bench.watch import Watch
from seafoam.framegraph.evaluation import FrameState
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset

SIZE = (1280, 720)
ROUNDS = 7
ROUNDS_SECONDS = 6.0

_KIND = re.compile(r"^(?P<kind>[^:,]*?)(?: \d+)?(?:[:,].*)?$")


def kind(name: str) -> str:
    """A pass's name without numbers, so that all passes of one transform have the same."""
    found = _KIND.match(name)
    assert found
    return found["kind"]


@dataclass(frozen=True)
class Taken:
    """A pass and its seconds, the median over frames that drew it; ``kept``: drawn only once."""

    name: str
    program: str
    width: int
    height: int
    seconds: float
    kept: bool

    @property
    def kind(self) -> str:
        """The name without numbers."""
        return kind(self.name)


@dataclass(frozen=True)
class Frame:
    """A preset's frame: seconds of the whole, drawn without timers, and of its passes."""

    preset: str
    whole: float
    passes: tuple[Taken, ...]

    @property
    def drawn(self) -> float:
        """Seconds of the passes that every frame draws."""
        return sum(timed.seconds for timed in self.passes if not timed.kept)

    def kinds(self) -> list[tuple[str, int, float, bool]]:
        """Passes by kind, in drawing order: name, number, seconds, and whether they are drawn only once."""
        by_kind: dict[tuple[str, bool], list[float]] = {}
        for timed in self.passes:
            by_kind.setdefault((timed.kind, timed.kept), []).append(timed.seconds)
        return [(kind, len(seconds), sum(seconds), kept) for (kind, kept), seconds in by_kind.items()]


def measure(executor: Executor, presets: Sequence[str], watch: Watch) -> tuple[list[Frame], Table]:
    """Draw each preset, whole and pass by pass, in turn; returns the frames, and a table of them."""
    frames = [_frame(executor, name, watch) for name in presets]
    rows = [
        (
            frame.preset,
            one.name,
            one.program,
            f"{one.width} x {one.height}",
            "once" if one.kept else "",
            one.seconds,
            None if one.kept else one.seconds / frame.drawn,
        )
        for frame in frames
        for one in frame.passes
    ]
    table = Table(
        "Passes",
        f"Frames of {SIZE[0]} x {SIZE[1]}, quality standard, each preset from its own camera; GL is finished before "
        "and after each pass. Medians. Once: drawn with a plan's first frame and kept, so that no later frame pays for "
        "it (what an earlier preset drew is listed there). Shares: of all that every frame draws.",
        (
            Column("preset", "preset"),
            Column("pass", "pass"),
            Column("program", "program"),
            Column("size", "pixels"),
            Column("when", "when"),
            Column("wall", "ms", ms),
            Column("share", "share", lambda share: f"{100.0 * share:.1f} %"),
        ),
        rows,
    )
    return frames, table


def _frame(executor: Executor, name: str, watch: Watch) -> Frame:
    preset = load_preset(name)
    plan = make_plan(preset.scene, TIERS["standard"])
    camera = preset.scene.camera
    once = _Clock(executor)
    with once.running():
        cost(executor, plan, camera, SIZE, preset.time)
    each = _Clock(executor)
    whole = []
    for index in watch.rounds(f"passes of {name}", ROUNDS, ROUNDS_SECONDS, least=1):
        at = preset.time + STEP * (index + 1)
        whole.append(cost(executor, plan, camera, SIZE, at).wall)
        with each.running():
            cost(executor, plan, camera, SIZE, at)
    if not each.taken:
        raise RuntimeError(
            f"no pass of {name} was seen: the executor draws passes in another way, see bench/drawn/passes.py"
        )
    passes = []
    for index, one in enumerate(plan.passes):
        seen_by = each if index in each.taken else once
        if index in seen_by.taken:
            width, height = seen_by.sizes[index]
            seconds = median(seen_by.taken[index])
            passes.append(Taken(one.name, one.program, width, height, seconds, kept=seen_by is once))
    return Frame(name, median(whole), tuple(passes))


class _Clock:
    """Seconds of each pass drawn in the context, and the size of its target, by its index in the plan."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.taken: dict[int, list[float]] = {}
        self.sizes: dict[int, tuple[int, int]] = {}

    def running(self) -> Any:
        """A context in which the executor's passes are timed."""
        draw, finish = self._executor._draw, self._executor._context.finish

        def timed(plan: FramePlan, index: int, targets: Mapping[str, Any], frame: FrameState) -> None:
            one = plan.passes[index]
            if one.when == "setup" and (one.state.clear or one.state.blend == "none"):
                # A pass that is drawn only once: first to compile it, then again to time it.
                draw(plan, index, targets, frame)
            finish()
            began = clock.perf_counter()
            draw(plan, index, targets, frame)
            finish()
            self.taken.setdefault(index, []).append(clock.perf_counter() - began)
            self.sizes[index] = targets[one.target][0].size

        return patch.object(self._executor, "_draw", timed)
