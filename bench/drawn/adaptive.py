"""Adaptive samples: error and time of 1, 4, 16 and adaptive samples a pixel, in turn, against 64 samples."""

from collections.abc import Sequence
from statistics import median

from bench.drawn.frames import is_software, ratios, side_by_side
from bench.report import Column, Table, ms, times
from bench.watch import Watch
from seafoam.accuracy.metrics import Picture, rmse
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, load_preset

SIZE = (480, 270)
TIME = 2.7
TRUTH = 64
ROUNDS = 5
STANDARD = TIERS["standard"]
COMPARED: dict[str, Quality] = {
    "1": STANDARD,
    "4": STANDARD.model_copy(update={"samples": 4}),
    "16": STANDARD.model_copy(update={"samples": 16}),
    "adaptive": STANDARD.model_copy(update={"samples_max": 16}),
}
MOST_TIME, MOST_ERROR = 4.0, 2.0
"""Targets: maximum time over that of one sample, and maximum error over that of 16."""


def measure(executor: Executor, presets: Sequence[str], watch: Watch) -> list[Table]:
    """Draw every preset in all four ways, and tabulate it. ``presets``: their names."""
    rows = [_row(executor, name, watch) for name in presets]
    both = sum(row[-2] == "yes" and row[-1] == "yes" for row in rows)
    table = Table(
        "Adaptive samples",
        f"{SIZE[0]} x {SIZE[1]}, quality standard; error: root mean square, levels of linear light up to white, "
        f"against {TRUTH} samples at {TIME:g} s; time: medians of {ROUNDS} rounds' ratios to one sample (interquartile "
        f"range). Within: at most {MOST_TIME:g} times the time of one sample and {MOST_ERROR:g} times the error of 16. "
        f"Better than 4: nearer to the truth, and faster. Both in {both} of {len(rows)}.",
        (
            Column("preset", "preset"),
            Column("one_ms", "1, ms", ms),
            *(Column(f"error_{name}", f"error, {name}", lambda value: f"{value:.2f}") for name in COMPARED),
            *(Column(f"time_{name}", f"time, {name}", times) for name in COMPARED if name != "1"),
            Column("over_16", "error over 16's", lambda value: f"{value:.2f}"),
            Column("within", "within"),
            Column("better", "better than 4"),
        ),
        rows,
    )
    return [table]


def _row(executor: Executor, name: str, watch: Watch) -> tuple[object, ...]:
    scene = load_preset(name).scene
    plans = {key: make_plan(scene, quality) for key, quality in COMPARED.items()}
    costs = side_by_side(executor, plans, scene.camera, SIZE, watch.rounds(f"{name}, adaptive", ROUNDS, 60.0))
    truth = _picture(executor, make_plan(scene, STANDARD.model_copy(update={"samples": TRUTH})), scene.camera)
    errors = {key: rmse(_picture(executor, plan, scene.camera), truth) for key, plan in plans.items()}
    basis = 0 if is_software(executor) else 1
    spreads = {key: ratios(taken, costs["1"])[basis] for key, taken in costs.items() if key != "1"}
    mine, four = spreads["adaptive"], spreads["4"]
    assert mine is not None
    assert four is not None
    over = errors["adaptive"] / errors["16"] if errors["16"] > 0.0 else 1.0
    within = mine.median <= MOST_TIME and over <= MOST_ERROR
    better = errors["adaptive"] < errors["4"] and mine.median < four.median
    one = median(cost.cpu if basis == 0 else cost.wall for cost in costs["1"])
    verdicts = ("yes" if within else "no", "yes" if better else "no")
    return (name, one, *errors.values(), *spreads.values(), over, *verdicts)


def _picture(executor: Executor, plan: FramePlan, camera: Camera) -> Picture:
    width, height = SIZE
    return executor.render(plan, time=TIME, camera=camera, width=width, height=height, output="linear").pixels
