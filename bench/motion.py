"""Motion: flicker of a second at 60 Hz under a slow camera, one sample a pixel against 64.

``python -m bench.motion [--docs] [PRESET ...]``: these presets, or the five of the page; ``--docs`` writes the table
into ``docs/accuracy.md``.
"""

import argparse
import math
from collections.abc import Sequence

from rich.console import Console
from rich.progress import Progress

from bench.document import DOCS, fill
from bench.report import Column, Table
from seafoam.accuracy.motion import excess, flicker, shown
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.presets import load_preset

PRESETS = ("default", "open-ocean", "storm", "beach", "drift-vortices")
SIZE = (160, 90)
RATE = 60.0
FRAMES = 61
"""Frames of one second, both ends included."""
SPEED = 0.3
"""Speed of the camera along its heading, m/s."""
SAMPLES = (1, 64)
MOST = 2.0
"""Target: maximum flicker of one sample over that of 64."""


def moved(camera: Camera, way: float) -> Camera:
    """The camera moved along its heading by a distance, m, at constant height."""
    x, y, z = camera.position
    return camera.model_copy(update={"position": (x + way * math.sin(camera.yaw), y, z - way * math.cos(camera.yaw))})


def measure(executor: Executor, presets: Sequence[str], progress: Progress) -> Table:
    """Draw every preset's clip with one and with many samples, and tabulate their flicker."""
    rows: list[tuple[object, ...]] = []
    for name in presets:
        preset = load_preset(name)
        task = progress.add_task(name, total=FRAMES * len(SAMPLES))
        pictures, foams = [], []
        for samples in SAMPLES:
            plan = make_plan(preset.scene, TIERS["standard"].model_copy(update={"samples": samples}))
            pictures.append([])
            foams.append([])
            for i in range(FRAMES):
                camera = moved(preset.scene.camera, SPEED * i / RATE)
                time = preset.time + i / RATE
                frame = executor.render(
                    plan, time=time, camera=camera, width=SIZE[0], height=SIZE[1], output="linear"
                ).pixels
                pictures[-1].append(shown(frame))
                foams[-1].append(frame[..., 3].copy())
                progress.advance(task)
        ratios = [excess(*clips) for clips in (foams, pictures)]
        levels = [flicker(clip) for clips in (foams, pictures) for clip in clips]
        held = "yes" if max(ratios) <= MOST else "no"
        rows.append((name, *levels[:2], ratios[0], *levels[2:], ratios[1], held))
    two = "{:.2f}".format
    return Table(
        "Motion",
        f"{SIZE[0]} x {SIZE[1]}, {FRAMES} frames at {RATE:g} Hz, the camera {SPEED:g} m/s forward, quality standard. "
        f"Flicker: root mean square second difference in time, levels. The aim: at most {MOST:g} times that of "
        f"{SAMPLES[1]} samples.",
        (
            Column("preset", "preset"),
            Column("foam_one", "foam: 1 sample", two),
            Column("foam_many", f"{SAMPLES[1]}", two),
            Column("foam_ratio", "ratio", two),
            Column("picture_one", "picture: 1 sample", two),
            Column("picture_many", f"{SAMPLES[1]}", two),
            Column("picture_ratio", "ratio", two),
            Column("held", "within"),
        ),
        rows,
    )


def main() -> None:
    """Measure, print, and write the page with ``--docs``."""
    parser = argparse.ArgumentParser(prog="python -m bench.motion", description=__doc__)
    parser.add_argument("--docs", action="store_true")
    parser.add_argument("presets", nargs="*", default=PRESETS)
    options = parser.parse_args()
    executor = Executor()
    try:
        with Progress(console=Console(stderr=True)) as progress:
            table = measure(executor, options.presets, progress)
    finally:
        executor.close()
    print(table.text())
    if options.docs:
        page = DOCS / "accuracy.md"
        block = f"```\n{table.text()}\n```"
        page.write_text(fill(page.read_text(encoding="utf-8"), "motion", block), encoding="utf-8")


if __name__ == "__main__":
    main()
