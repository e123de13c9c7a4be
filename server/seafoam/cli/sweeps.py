"""The work of ``seafoam accuracy``: sweeps of presets, printed as tables and written as plots and reports."""

import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import as_completed
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Column, Table

from seafoam import processes
from seafoam.accuracy import plots, report
from seafoam.accuracy.cache import stored
from seafoam.accuracy.model import Sweep
from seafoam.accuracy.sweep import Rig, Subject, SweepSettings, make_sweep
from seafoam.accuracy.truth import Watcher
from seafoam.cli.support import CommandError, progress_bar, write
from seafoam.render.gl import executor as gl
from seafoam.render.service import jobs
from seafoam.scene import presets

TABLE_WIDTH = 140
"""Width of the table, columns; a narrower terminal wraps its lines."""

Files = Mapping[tuple[str, str], Path | None]
"""Option and extension -> file, directory, or None if nothing is to be written."""

PLAIN: dict[str, Any] = {"highlight": False, "markup": False, "soft_wrap": True}
"""How lines of plain text are printed."""


def measure_presets(
    preset: str | None, size: str, settings: SweepSettings, files: Files, *, again: bool, scheduler: str | None = None
) -> None:
    """Measure a preset, or all if it is None; print their tables, and write reports.

    ``size``: as written in the command. ``files``: option and extension -> file, or directory for all presets.
    ``scheduler``: each preset is measured by a worker of this Dask cluster, whose machine the times are of. Raises
    :class:`CommandError` for a file of another extension.
    """
    for (option, extension), path in files.items():
        if path is not None and preset is not None and path.suffix.lower() != extension:
            raise CommandError(f"{option}: {path.name!r} must end in {extension}")
    console = Console()
    console.width = max(console.width, TABLE_WIDTH)
    options = f"--size {size} --rounds {settings.rounds} --samples {settings.samples_along}"
    options += f" --timer {settings.timer}" if settings.timer != "wall" else ""
    names = presets.preset_names() if preset is None else (preset,)
    for name, sweep in _sweeps(names, settings, again, scheduler):
        _print(console, name, sweep)
        command = f"seafoam accuracy {preset or '--all'} {options}"
        for (_, extension), path in files.items():
            if path is not None:
                if preset is None:
                    path.mkdir(parents=True, exist_ok=True)
                    path /= f"{name}{extension}"
                write(path, _report(sweep, extension, command))
                console.print(f"{path}", **PLAIN)


def _sweeps(
    names: Sequence[str], settings: SweepSettings, again: bool, scheduler: str | None
) -> Iterator[tuple[str, Sweep]]:
    """Yield each preset and its sweep: in their order here, on a cluster as they are finished."""
    if scheduler is None:
        executor = gl.Executor()
        for name in names:
            yield name, measured(executor, Subject.of_preset(name), settings, again=again)
        return
    with processes.executor(scheduler, 0) as pool:
        running = {pool.submit(_measured_there, name, settings, again): name for name in names}
        for done in as_completed(running):
            yield running[done], done.result()


def _measured_there(name: str, settings: SweepSettings, again: bool) -> Sweep:
    """Measure a preset in a worker, in a context of its own: the next task may run in another thread."""
    executor = gl.Executor()
    try:
        return measured(executor, Subject.of_preset(name), settings, again=again)
    finally:
        executor.close()


def measured(executor: gl.Executor, subject: Subject, settings: SweepSettings, *, again: bool = False) -> Sweep:
    """The sweep of a subject, from the cache or measured now, with a progress bar."""
    threads = int(os.environ.get("LP_NUM_THREADS") or os.cpu_count() or 1)
    rig = Rig(partial(jobs.measure, executor), executor.info, threads)
    with progress_bar() as bar:
        task = bar.add_task(f"{subject.preset or 'scene'}: float64 truth", total=1.0)

        def tell(stage: str, share: float, remaining: float | None) -> None:
            bar.update(task, completed=share, description=f"{subject.preset or 'scene'}: {stage}")

        return make_sweep(stored(), subject, settings, rig, Watcher(tell), again=again)


def _print(console: Console, name: str, sweep: Sweep) -> None:
    size, own = (sweep.width, sweep.height), (sweep.timing.own_width, sweep.timing.own_height)
    title = f"{name}: errors at {size[0]} × {size[1]}, times for {own[0]} × {own[1]}"
    first, *others = (Column(heading, no_wrap=True, justify="right") for heading in report.HEADINGS)
    first.justify = "left"
    table = Table(first, *others, title=title, title_justify="left", box=None, pad_edge=False)
    for point in sweep.points:
        table.add_row(*report.row_of(point), style="bold" if point.on_front else None)
    console.print(table)
    for sentence in (*sweep.sentences, *(step.sentence for step in sweep.steps)):
        console.print(f"  {sentence}", **PLAIN)


def _report(sweep: Sweep, extension: str, command: str) -> bytes:
    match extension:
        case ".png":
            return plots.plot_sweep(sweep)
        case ".json":
            return (sweep.model_dump_json(indent=1) + "\n").encode()
        case ".csv":
            return report.csv_of(sweep).encode()
        case _:
            return report.page(sweep, command).encode()
