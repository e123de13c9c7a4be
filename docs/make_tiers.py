"""What accuracy costs in time: docs/accuracy.csv, and the tables, plot and crops that docs/accuracy.md opens with.

``python docs/make_tiers.py`` measures the tiers of every preset, a minute each, and writes the page. Times are of the
processor, of one thread for each process: other programs of the machine do not count.
"""

import os

os.environ.setdefault("LP_NUM_THREADS", "1")

import argparse
import csv
import re
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from seafoam.accuracy.cache import stored
from seafoam.accuracy.metrics import Picture, rmse
from seafoam.accuracy.model import TimeModel
from seafoam.accuracy.timing import compare, time_model
from seafoam.accuracy.truth import TruthSpec, make_truth
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.reference import scene_sha256
from seafoam.render.gl.executor import Executor, Output
from seafoam.render.service import jobs
from seafoam.scene import load_preset, preset_names

DOCS = Path(__file__).parent
FIGURES = DOCS / "accuracy.csv"
PICTURES = DOCS / "pictures/accuracy"
SIZE, TIMED, SMALL = (160, 90), (320, 180), (32, 18)
"""Pixels of the pictures that are compared, and of those that are timed: a line through both gives other sizes."""
SAMPLES_ALONG = 8
ROUNDS = 5
MARK = re.compile(r"(<!-- tiers: ([a-z]+) -->\n).*?(<!-- end -->)", re.DOTALL)
YARDSTICK = re.compile(r"^([a-z-]+) +[\d.]+ +[\d.]+ +([\d.]+) .* % ", re.MULTILINE)
"""A line of docs/performance.md: preset, ms, three.js's ms, the multiple, and further on the share of water."""
CROP = ("default", (1280, 720), (420, 330, 740, 530))
"""Preset, size of its picture, and the part that is shown."""


class Measured(NamedTuple):
    """What a tier of a preset costs and how far it is from float64."""

    ms: float
    rounds: list[float]
    error: float
    multiple: float
    """Of three.js's water."""


def measure(name: str) -> list[str]:
    """The rows of a preset's tiers in docs/accuracy.csv."""
    preset = load_preset(name)
    width, height = SIZE
    executor = Executor()
    spec = TruthSpec(preset.scene, preset.time, width, height, SAMPLES_ALONG)
    truth = make_truth(stored(), spec, partial(jobs.measure, executor)).astype(np.float64)
    models: dict[str, list[TimeModel]] = {tier: [] for tier in TIERS}
    errors: dict[str, float] = {}

    def drawn(tier: Tier, size: tuple[int, int], output: Output) -> tuple[Picture, float]:
        began = time.process_time()
        rendered = executor.render(
            make_plan(preset.scene, TIERS[tier]),
            time=preset.time,
            camera=preset.scene.camera,
            width=size[0],
            height=size[1],
            output=output,
        )
        return rendered.pixels, 1000.0 * (time.process_time() - began)

    try:
        for tier in TIERS:
            errors[tier] = rmse(drawn(tier, SIZE, "linear")[0], truth)
            drawn(tier, SMALL, "rgba8")
        for _ in range(ROUNDS):
            for tier, of in models.items():
                (_, large), (_, small) = (drawn(tier, size, "rgba8") for size in (TIMED, SMALL))
                of.append(time_model(large, TIMED, small, SMALL))
    finally:
        executor.close()
    rows = []
    for tier, of in models.items():
        times = [model.at(*preset.size) for model in of]
        figures = (f"{median(times):.1f}", " ".join(f"{each:.1f}" for each in times), f"{errors[tier]:.3f}")
        rows.append(",".join((name, tier, *figures, scene_sha256(preset.scene))))
    return rows


def measured() -> dict[str, dict[str, Measured]]:
    """What docs/accuracy.csv says; times over three.js's are the yardstick's for standard, others in proportion."""
    multiples = dict(YARDSTICK.findall((DOCS / "performance.md").read_text(encoding="utf-8")))
    found: dict[str, dict[str, Measured]] = {}
    with FIGURES.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            ms, rounds = float(row["ms"]), [float(each) for each in row["rounds_ms"].split()]
            found.setdefault(row["preset"], {})[row["tier"]] = Measured(ms, rounds, float(row["rmse"]), 0.0)
    return {
        name: {
            tier: one._replace(multiple=float(multiples[name]) * one.ms / tiers["standard"].ms)
            for tier, one in tiers.items()
        }
        for name, tiers in found.items()
    }


def table(measured: dict[str, dict[str, Measured]]) -> str:
    """A row for each preset, and the middle of all."""
    lines = ["| preset | " + " | ".join(TIERS) + " |", "|---" * (1 + len(TIERS)) + "|"]
    cells = {
        name: [(tier.error, tier.ms, tier.multiple) for tier in tiers.values()] for name, tiers in measured.items()
    }
    middle = [tuple(median(of[i][j] for of in cells.values()) for j in range(3)) for i in range(len(TIERS))]
    for name, of in {"**middle of all**": middle, **cells}.items():
        shown = (f"{error:.1f} · {_seconds(ms)} · {multiple:.{multiple < 10:d}f} ×" for error, ms, multiple in of)
        lines.append(f"| {name} | " + " | ".join(shown) + " |")
    return "\n".join(lines) + "\n"


def _seconds(ms: float) -> str:
    return f"{ms:.0f} ms" if ms < 1000 else f"{ms / 1000:.1f} s"


def sentences(measured: dict[str, dict[str, Measured]]) -> str:
    """What each step from tier to tier buys, by preset."""
    steps = list(zip(TIERS, list(TIERS)[1:], strict=False))
    lines = ["| preset | " + " | ".join(f"{a} → {b}" for a, b in steps) + " |", "|---" * (1 + len(steps)) + "|"]
    for name, tiers in measured.items():
        words = (compare(tiers[a].rounds, tiers[b].rounds, tiers[a].error, tiers[b].error).words for a, b in steps)
        lines.append(f"| {name} | " + " | ".join(words) + " |")
    return "\n".join(lines) + "\n"


def plot(measured: dict[str, dict[str, Measured]]) -> None:
    """Error against time of the tiers of every preset, the middle of all in bold."""
    figure = Figure(figsize=(8.0, 5.0), dpi=120, layout="constrained")
    axes = figure.subplots()
    for tiers in measured.values():
        axes.plot([t.multiple for t in tiers.values()], [t.error for t in tiers.values()], color="#9fb3bd", lw=0.8)
    middle = [
        (median(of[tier].multiple for of in measured.values()), median(of[tier].error for of in measured.values()))
        for tier in TIERS
    ]
    axes.plot(*zip(*middle, strict=True), "s-", color="#b5353c", lw=2.0)
    for tier, place in zip(TIERS, middle, strict=True):
        axes.annotate(tier, place, (8, 6), textcoords="offset points", color="#b5353c")
    axes.set(xscale="log", yscale="log", xlabel="time of a frame, over three.js's water", ylabel="RMSE, levels of 255")
    axes.set_title(f"Tiers of {len(measured)} presets, and the middle of all")
    axes.grid(visible=True, which="both", color="#e4eaed", lw=0.6)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    _save(np.asarray(canvas.buffer_rgba())[..., :3], "tiers")


def crops() -> None:
    """One part of a picture at each tier, side by side, the most exact last."""
    name, (width, height), box = CROP
    preset, executor = load_preset(name), Executor()
    try:
        parts = []
        for quality in TIERS.values():
            rendered = executor.render(
                make_plan(preset.scene, quality),
                time=preset.time,
                camera=preset.scene.camera,
                width=width,
                height=height,
                output="rgba8",
            )
            parts.append(rendered.pixels[box[1] : box[3], box[0] : box[2], :3])
    finally:
        executor.close()
    _save(np.concatenate(parts, axis=1), "crops")


def _save(pixels: np.ndarray, name: str) -> None:
    PICTURES.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(pixels)).save(PICTURES / f"{name}.webp", quality=88, method=6)


def write_page() -> None:
    """The table, plot and crops, from the figures that are there."""
    found = measured()
    plot(found)
    crops()
    written = {"table": table(found), "steps": sentences(found)}
    page = DOCS / "accuracy.md"
    text = page.read_text(encoding="utf-8")
    page.write_text(MARK.sub(lambda found: found[1] + written[found[2]] + found[3], text), encoding="utf-8")


def main() -> None:
    """Measure, then write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("presets", nargs="*", help="presets to measure again; none: all")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page anew")
    given = parser.parse_args()
    if not given.page:
        names = given.presets or preset_names()
        with ProcessPoolExecutor(os.cpu_count(), get_context("spawn"), max_tasks_per_child=1) as pool:
            made = dict(zip(names, pool.map(measure, names), strict=True))
        head, *lines = FIGURES.read_text(encoding="utf-8").splitlines()
        kept = {name: [line for line in lines if line.startswith(f"{name},")] for name in preset_names()}
        rows = [row for name in preset_names() for row in made.get(name, kept[name])]
        FIGURES.write_text("\n".join((head, *rows)) + "\n", encoding="utf-8")
    write_page()


if __name__ == "__main__":
    main()
