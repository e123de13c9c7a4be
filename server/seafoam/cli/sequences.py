"""The command ``seafoam sequence``."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seafoam.cli import options
from seafoam.cli.support import UNABLE, CommandError, say, size_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

    from seafoam.sequences.making import Output as SequenceOutput
    from seafoam.sequences.spec import SequenceSpec, Workers


def sequence(
    preset: options.Preset,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Directory for frames, or a .mp4, .webp (lossless) or .zip file.")
    ],
    stop: Annotated[float, typer.Option(help="Time before which the last frame is, s.")],
    start: Annotated[float | None, typer.Option(help="Time of the first frame, s (default: the preset's).")] = None,
    fps: Annotated[
        str, typer.Option(help="Frames per second, such as 29.97 or 30000/1001, which are the same.")
    ] = "24",
    size: options.Size = None,
    quality: options.TierName = "standard",
    look: options.LookName = None,
    mask: options.MaskName = None,
    codec: Annotated[str, typer.Option(help="Of a .mp4 file: h264 or av1.")] = "h264",
    workers: Annotated[
        int, typer.Option(min=1, max=256, help="Processes on this machine; several need the extra cluster.")
    ] = 1,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler, such as tcp://host:8786, whose workers draw.")
    ] = None,
    mixed: Annotated[
        bool, typer.Option("--mixed", help="Allow workers with different renderers: their frames differ in levels.")
    ] = False,
    again: Annotated[
        bool, typer.Option("--again", help="Draw every frame again, ignoring those that are there.")
    ] = False,
) -> None:
    """Render a sequence of frames. The same command goes on where an earlier run stopped."""
    from seafoam.planner import PlanError

    wanted = _output(output, codec)
    pixels = None if size is None else size_of(size)
    spec = _spec(preset, start, stop, fps, {"size": pixels, "quality": quality, "look": look, "mask": mask})
    try:
        say(_make(spec, wanted, _working(workers, scheduler, mixed), again=again))
    except PlanError as error:
        raise CommandError(f"scene{error.pointer}: {error.message}") from error
    except KeyboardInterrupt:
        say("seafoam: interrupted; the same command goes on from here", err=True)
        raise typer.Abort from None


def _output(path: Path, codec: str) -> "SequenceOutput":
    from seafoam.sequences.formats import CODECS
    from seafoam.sequences.making import Kind, Output

    kinds: dict[str, Kind] = {"": "frames", ".mp4": "mp4", ".webp": "webp", ".zip": "zip"}
    kind = kinds.get(path.suffix.lower())
    if kind is None:
        raise CommandError(f"--output: {path.name!r} must be a directory or end in .mp4, .webp, .zip")
    if codec not in CODECS:
        raise CommandError(f"--codec: must be one of {', '.join(CODECS)}, not {codec!r}")
    return Output(path, kind, codec)


def _spec(preset: str, start: float | None, stop: float, fps: str, others: dict[str, object]) -> "SequenceSpec":
    from seafoam.library.errors import InvalidRequestError
    from seafoam.library.request import PictureRequest
    from seafoam.sequences.spec import OutputError, sequence_of

    given = {name: value for name, value in others.items() if value is not None}
    try:
        return sequence_of(PictureRequest(preset, time=start, **given).job(), stop, fps)  # type: ignore[arg-type]
    except InvalidRequestError as error:
        text = str(error)
        option = text.replace("preset", "PRESET", 1) if text.startswith("preset") else f"--{text}"
        raise CommandError(option.replace("--time:", "--start:", 1)) from error
    except OutputError as error:
        raise CommandError(f"{_option(error.field)}: {error}") from error


def _option(field: str) -> str:
    return "--size" if field in ("width", "height") else f"--{field}"


@contextmanager
def _working(workers: int, scheduler: str | None, mixed: bool) -> "Iterator[Workers]":
    """Who draws: this process, or processes here, if there is no scheduler, or on other machines."""
    from seafoam.render.gl import executor as gl
    from seafoam.sequences.fleet import DaskWorkers
    from seafoam.sequences.spec import InProcess

    if scheduler is None and workers == 1:
        yield InProcess(gl.Executor())
        return
    with DaskWorkers(scheduler, workers=workers, mixed=mixed) as cluster:
        yield cluster


def _make(
    spec: "SequenceSpec", output: "SequenceOutput", working: "AbstractContextManager[Workers]", *, again: bool
) -> str:
    """Make the sequence, with a progress bar; return the line to print."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from seafoam.sequences import making
    from seafoam.sequences.spec import MixedFleetError, OtherSequenceError, OutputError, SequenceError

    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    try:
        making.check_output(spec, output)
        bar = Progress(*columns, console=console, transient=True, disable=not console.is_terminal)
        with working as workers, bar:
            task = bar.add_task("frames", total=spec.count)

            def tell(progress: making.Progress) -> None:
                bar.update(task, completed=progress.done, total=progress.total, description=progress.stage)

            made = making.make_sequence(spec, output, workers, tell=tell, again=again)
            renderer = workers.info["renderer"]
    except OutputError as error:
        raise CommandError(f"{_option(error.field)}: {error}") from error
    except OtherSequenceError as error:
        raise CommandError(f"--output: {error}; --again replaces it") from error
    except MixedFleetError as error:
        raise CommandError(f"--scheduler: {error}; --mixed allows it") from error
    except SequenceError as error:
        raise CommandError(str(error), UNABLE) from error
    except OSError as error:
        raise CommandError(f"--output: cannot write {output.path}: {error.strerror}", UNABLE) from error
    job = spec.job
    found = f", {made.found} of them were there" if made.found else ""
    return f"{output.path}: {spec.count} frames of {job.width} × {job.height} at {spec.fps} a second{found}; {renderer}"
