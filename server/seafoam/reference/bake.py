"""Baking reference frames: ``python -m seafoam.reference.bake [--preset NAME ...] [--out tests/references]``.

With ``--scheduler tcp://host:8786`` on the workers of a Dask cluster.
"""

import argparse
import time as clock
from concurrent.futures import as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from seafoam.extras import MissingExtraError
from seafoam.files import write_whole
from seafoam.processes import SCHEDULER, NoClusterError, executor
from seafoam.reference.renderer.frame import render
from seafoam.reference.renderer.state import Mode
from seafoam.reference.truth import truth_bytes, truth_is_current
from seafoam.scene.foam import Look
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names

TIMES = (0.0, 2.7, 1000003.5)  # times of same-samples frames, s
SAME_SIZE = (320, 180)
COSTLY_SIZE = (160, 90)
"""The same for scenes with a shore, an open sea, drifting foam, caustics or boats, which take ten times as long."""
SAME_SAMPLES = 4
CONVERGED_TIME = 2.7
CONVERGED_SIZE = (160, 90)
CONVERGED_SAMPLES = 16
EVERY_LOOK = ("default", "paper-halftone")  # presets with converged frames, at least one for every look
PROCESSES = 2
DIRECTORY = Path("tests/references")


@dataclass(frozen=True)
class Job:
    """One frame to bake."""

    name: str
    """File name without its suffix."""
    preset: str
    scene: Scene
    time: float
    size: tuple[int, int]
    samples: int
    mode: Mode


def same_size(scene: Scene) -> tuple[int, int]:
    """Width and height of a scene's same-samples frames, pixels."""
    caustics = None if scene.light is None else scene.light.caustics
    costly = (scene.shore, scene.sea, scene.drift, caustics)
    return COSTLY_SIZE if scene.boats or any(part is not None for part in costly) else SAME_SIZE


def jobs_of(preset: str, scene: Scene) -> list[Job]:
    """Every frame of a preset, in baking order."""
    jobs = [
        Job(f"{preset}.same.{time:.1f}", preset, scene, time, same_size(scene), SAME_SAMPLES, "same-samples")
        for time in TIMES
    ]
    if preset not in EVERY_LOOK or scene.foam is None:
        return jobs
    for look in get_args(Look):
        variant = scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})})
        name = f"{preset}.converged.{look}"
        jobs.append(Job(name, preset, variant, CONVERGED_TIME, CONVERGED_SIZE, CONVERGED_SAMPLES, "converged"))
    return jobs


def truth_file(directory: Path, name: str) -> Path:
    """Where a directory holds the frame of a job."""
    return directory / f"{name}.npz"


def baked(job: Job) -> tuple[bytes, float]:
    """Render one frame; returns the content of its file, and the seconds that rendering took."""
    start = clock.perf_counter()
    width, height = job.size
    frame = render(job.scene, time=job.time, width=width, height=height, samples=job.samples, mode=job.mode)
    seconds = clock.perf_counter() - start
    content = truth_bytes(frame, preset=job.preset, scene=job.scene, time=job.time, mode=job.mode, seconds=seconds)
    return content, seconds


def main(arguments: list[str] | None = None) -> None:
    """Bake frames that are missing or show another scene; with ``--force`` all of them."""
    parser = argparse.ArgumentParser(prog="python -m seafoam.reference.bake", description=main.__doc__)
    parser.add_argument("--preset", action="append", choices=preset_names(), help="only this one; may be repeated")
    parser.add_argument("--out", type=Path, default=DIRECTORY)
    parser.add_argument("--force", action="store_true", help="bake current frames too")
    parser.add_argument("--scheduler", help=SCHEDULER)
    options = parser.parse_args(arguments)
    directory: Path = options.out
    directory.mkdir(parents=True, exist_ok=True)
    jobs = [job for name in options.preset or preset_names() for job in jobs_of(name, load_preset(name).scene)]
    if not options.force:
        jobs = [job for job in jobs if not truth_is_current(truth_file(directory, job.name), job.scene)]
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    try:
        with Progress(*columns) as progress, executor(options.scheduler, PROCESSES) as pool:
            task = progress.add_task("frames", total=len(jobs))
            running = {pool.submit(baked, job): job for job in jobs}
            for done in as_completed(running):
                name, (content, seconds) = running[done].name, done.result()
                write_whole(truth_file(directory, name), content)
                progress.console.print(f"{name}: {seconds:.1f} s")
                progress.advance(task)
    except (MissingExtraError, NoClusterError) as error:
        raise SystemExit(str(error)) from error


if __name__ == "__main__":
    main()
