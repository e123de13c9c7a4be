"""Quality auto: predicted frame time for a budget against the measured time of the chosen frame."""

import os
from functools import partial

from bench.drawn.frames import cost
from bench.report import Column, Spread, Table, ms, times
from bench.watch import Watch
from seafoam.accuracy.cache import stored
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, make_sweep
from seafoam.accuracy.timing import choose
from seafoam.planner import make_plan
from seafoam.quality import Quality
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure as draw

PRESET = "default"
SIZES = ((160, 90), (320, 180), (640, 360))
SHARES = (0.5, 1.0, 2.0, 4.0, 8.0)
"""Budgets, as multiples of the predicted time of tier standard at that size."""


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Choose a quality for every budget and size, then draw; makes the sweep first if none is stored."""
    subject = Subject.of_preset(PRESET)
    threads = int(os.environ.get("LP_NUM_THREADS") or os.cpu_count() or 1)
    with watch.step("cost of accuracy"):
        sweep = make_sweep(stored(), subject, SweepSettings(), Rig(partial(draw, executor), executor.info, threads))
    budgets = [(size, share * sweep.point("standard").model.at(*size)) for size in SIZES for share in SHARES]
    choices = [choose(sweep, *size, budget) for size, budget in budgets]
    taken: list[list[float]] = [[] for _ in budgets]
    drift: list[list[float]] = [[] for _ in budgets]
    standard = sweep.point("standard")
    timed = (sweep.timing.width, sweep.timing.height)
    for index in watch.rounds("budgets", 7, 90.0):
        at = subject.time + index / 60.0
        for (size, _), choice, found, drifted in zip(budgets, choices, taken, drift, strict=True):
            # Present speed of the machine over that during the sweep, measured just before and just after.
            now = [_seconds(executor, subject, standard.quality, at, timed)]
            found.append(_seconds(executor, subject, choice.point.quality, at, size))
            now.append(_seconds(executor, subject, standard.quality, at, timed))
            drifted.append(500.0 * sum(now) / standard.time.median_ms)
    rows = [
        (
            f"{size[0]} x {size[1]}",
            budget / 1000.0,
            choice.point.id,
            choice.predicted_ms / 1000.0,
            Spread.of(found).median,
            Spread.of([1000.0 * value / choice.predicted_ms for value in found]),
            Spread.of(
                [1000.0 * value / slower / choice.predicted_ms for value, slower in zip(found, drifted, strict=True)]
            ),
            choice.fits,
            choice.point.error.rmse,
        )
        for (size, budget), choice, found, drifted in zip(budgets, choices, taken, drift, strict=True)
    ]
    return [
        Table(
            "Quality for a budget",
            f"Preset {PRESET}, measured at {sweep.timing.width} x {sweep.timing.height} on {sweep.measured_at}; "
            "budgets are multiples of tier standard's predicted time. Measured over predicted, with quartiles: as it "
            "is, and with the machine as fast as it was for the sweep, by frames of tier standard around each one.",
            (
                Column("size", "size"),
                Column("budget", "budget, ms", ms),
                Column("chosen", "chosen"),
                Column("predicted", "predicted, ms", ms),
                Column("measured", "measured, ms", ms),
                Column("ratio", "measured over predicted", times),
                Column("steady", "at the sweep's speed", times),
                Column("fits", "predicted to fit", lambda fits: "yes" if fits else "no"),
                Column("rmse", "RMSE, levels", lambda value: f"{value:.2f}"),
            ),
            rows,
        )
    ]


def _seconds(executor: Executor, subject: Subject, quality: Quality, at: float, size: tuple[int, int]) -> float:
    """Time of a frame, after one that compiles and allocates."""
    plan = make_plan(subject.scene, quality)
    _, warm = (cost(executor, plan, subject.scene.camera, size, at) for _ in range(2))
    return warm.wall
