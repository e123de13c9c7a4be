"""The work of ``seafoam sequence``: frames of a preset, drawn here or by a cluster, in a directory or a file."""

from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

from seafoam.cli.support import UNABLE, CommandError, option_of, progress_bar
from seafoam.library.request import InvalidRequestError, PictureRequest
from seafoam.planner import PlanError
from seafoam.render.gl import executor as gl
from seafoam.sequences import making
from seafoam.sequences import spec as sequences
from seafoam.sequences.fleet import DaskWorkers
from seafoam.sequences.formats import CODECS

_KINDS: Mapping[str, making.Kind] = {"": "frames", ".mp4": "mp4", ".webp": "webp", ".zip": "zip"}


def output_of(path: Path, codec: str) -> making.Output:
    """Return where a sequence goes: the ending selects the format."""
    kind = _KINDS.get(path.suffix.lower())
    if kind is None:
        raise CommandError(f"--output: {path.name!r} must be a directory or end in .mp4, .webp, .zip")
    if codec not in CODECS:
        raise CommandError(f"--codec: must be one of {', '.join(CODECS)}, not {codec!r}")
    return making.Output(path, kind, codec)


def spec_of(
    preset: str, start: float | None, stop: float, fps: str, others: Mapping[str, Any]
) -> sequences.SequenceSpec:
    """Return a checked sequence of a preset. others: options of the picture; those that are None are the preset's."""
    given = {name: value for name, value in others.items() if value is not None}
    try:
        return sequences.sequence_of(PictureRequest(preset, time=start, **given).job(), stop, fps)
    except InvalidRequestError as error:
        raise CommandError(f"--{error}".replace("--time:", "--start:", 1)) from error
    except sequences.OutputError as error:
        raise CommandError(f"{option_of(error.field)}: {error}") from error


@contextmanager
def working(workers: int, scheduler: str | None, mixed: bool) -> Iterator[sequences.Workers]:
    """Who draws: this process, or processes here, if there is no scheduler, or on other machines."""
    if scheduler is None and workers == 1:
        yield sequences.InProcess(gl.Executor())
        return
    with DaskWorkers(scheduler, workers=workers, mixed=mixed) as cluster:
        yield cluster


def make(
    spec: sequences.SequenceSpec,
    output: making.Output,
    working: AbstractContextManager[sequences.Workers],
    *,
    again: bool,
) -> str:
    """Make the sequence, with a progress bar; return the line to print."""
    try:
        making.check_output(spec, output)
        with working as workers, progress_bar() as bar:
            task = bar.add_task("frames", total=spec.count)

            def tell(stage: making.Stage, done: int, total: int, _: float | None) -> None:
                bar.update(task, completed=done, total=total, description=f"{stage} {done}/{total}")

            there = making.make_sequence(spec, output, workers, tell=tell, again=again)
            renderer = workers.info["renderer"]
    except PlanError as error:
        raise CommandError(f"scene{error.pointer}: {error.message}") from error
    except sequences.OutputError as error:
        raise CommandError(f"{option_of(error.field)}: {error}") from error
    except sequences.OtherSequenceError as error:
        raise CommandError(f"--output: {error}; --again replaces it") from error
    except sequences.MixedFleetError as error:
        raise CommandError(f"--scheduler: {error}; --mixed allows it") from error
    except sequences.SequenceError as error:
        raise CommandError(str(error), UNABLE) from error
    except OSError as error:
        raise CommandError(f"--output: cannot write {output.path}: {error.strerror}", UNABLE) from error
    job = spec.job
    found = f", {there} of them were there" if there else ""
    return f"{output.path}: {spec.count} frames of {job.width} × {job.height} at {spec.fps} a second{found}; {renderer}"
