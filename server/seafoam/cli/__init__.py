"""The command ``seafoam``: serve, render, accuracy, masks, doctor.

Invalid input prints one line that names the field and its allowed values, with exit code 2; a missing driver or tool
prints one line with the remedy, with exit code 1. Commands import heavy modules themselves, because spawned render
workers import this module too.
"""

import json
import logging
import re
import socket
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from typer.exceptions import TyperException

if TYPE_CHECKING:
    from seafoam.accuracy.model import Sweep
    from seafoam.accuracy.sweep import Settings, Subject
    from seafoam.render.gl.executor import Executor

from seafoam.cli.masks import masks
from seafoam.cli.support import UNABLE, CommandError, Output, extension_of, need_reports, refuse, write

app = typer.Typer(
    help="Real-time water with halftoned foam.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(masks, name="masks")

OPEN_CONNECTIONS = 256
"""Connections beyond which the server answers 503 at once: a page uses a dozen; the render queue has its own limit."""
LARGEST_SIDE = 8192
LARGEST_SAMPLED_SIDE = 16384
LARGEST_SAMPLES = 16384 * 8192
"""Maximum frame size of ``render``, which is limited only by memory."""
TABLE_WIDTH = 140
"""Width of the table of ``accuracy``, columns; a narrower terminal wraps its lines."""
_QUIET = ("/healthz", "/readyz", "/metrics")


@app.command()
def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on [default: 127.0.0.1].")] = None,
    port: Annotated[int | None, typer.Option(help="Port to listen on; 0 selects a free one [default: 8000].")] = None,
    open_browser: Annotated[bool, typer.Option("--open", help="Open the web client in a browser.")] = False,
) -> None:
    """Serve the web client and the API. Environment variables that begin with SEAFOAM_ set its options."""
    import uvicorn
    from pydantic import ValidationError

    from seafoam.api.app import create_app
    from seafoam.api.settings import Settings

    given: dict[str, Any] = {name: value for name, value in (("host", host), ("port", port)) if value is not None}
    try:
        settings = Settings(**given)
    except ValidationError as error:
        refuse(error, Settings, lambda field: f"--{field}" if field in given else f"SEAFOAM_{field.upper()}")
    try:
        listening = socket.create_server((settings.host, settings.port), backlog=2048)
    except OSError as error:
        detail = f"cannot listen on {settings.host}:{settings.port}: {error.strerror}; choose another port with --port"
        raise CommandError(detail, UNABLE) from error
    # asyncio sets this only on sockets that name their protocol; without it every answer waits 40 ms for an ACK.
    listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    shown = "127.0.0.1" if settings.host in ("", "0.0.0.0", "::") else settings.host
    address = f"http://{shown}:{listening.getsockname()[1]}"
    logging.basicConfig(level=logging.INFO, format="%(levelname)s: %(message)s")
    config = uvicorn.Config(create_app(settings), limit_concurrency=OPEN_CONNECTIONS, timeout_graceful_shutdown=5)
    logging.getLogger("uvicorn.access").addFilter(_not_a_probe)

    class Server(uvicorn.Server):
        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            await super().startup(sockets)
            typer.echo(f"Seafoam is at {address}  (API: {address}/docs)")
            if open_browser:
                webbrowser.open(address)

    Server(config).run(sockets=[listening])


@app.command()
def render(
    preset: Annotated[str, typer.Argument(help="Name of a preset; `seafoam presets` lists them.")],
    output: Output,
    time: Annotated[float | None, typer.Option(help="Time, s [default: the preset's].")] = None,
    size: Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels [default: the preset's].")] = None,
    quality: Annotated[
        str, typer.Option(help="draft, standard, high, reference, or auto: the most exact that fits --budget-ms.")
    ] = "standard",
    budget_ms: Annotated[
        float | None,
        typer.Option(help="With auto: maximum frame time, ms. The first use measures, which takes minutes."),
    ] = None,
    look: Annotated[str | None, typer.Option(help="Foam look [default: the preset's].")] = None,
    mask: Annotated[
        str | None,
        typer.Option(help="Foam mask: a shipped one, or family:sigma:size:seed[:aspect:age] [default: the preset's]."),
    ] = None,
    x: Annotated[
        float | None,
        typer.Option(help="Camera position along +x, m [default: the preset's, as for all camera options]."),
    ] = None,
    y: Annotated[float | None, typer.Option(help="Camera height above still water, m.")] = None,
    z: Annotated[float | None, typer.Option(help="Camera position along +z, m.")] = None,
    yaw: Annotated[float | None, typer.Option(help="Camera yaw, rad from -z toward +x.")] = None,
    pitch: Annotated[float | None, typer.Option(help="Camera pitch, rad; positive looks up.")] = None,
    roll: Annotated[float | None, typer.Option(help="Camera roll about the view axis, rad.")] = None,
    fov: Annotated[float | None, typer.Option(help="Vertical field of view, rad.")] = None,
) -> None:
    """Render a frame to a .png, .webp (lossless) or .npy (linear float32) file, without a server."""
    from pydantic import ValidationError

    from seafoam.accuracy.budget import choose
    from seafoam.accuracy.sweep import Settings, Subject
    from seafoam.api.errors import ApiError
    from seafoam.api.parameters import FrameParameters
    from seafoam.api.routers.presets import find_preset
    from seafoam.planner import PlanError
    from seafoam.quality import TIERS
    from seafoam.render.encode import FRAME_FORMATS
    from seafoam.render.gl.executor import Executor, NoRendererError
    from seafoam.render.service.errors import FrameTooLargeError
    from seafoam.render.service.jobs import FrameJob, render_frame
    from seafoam.render.service.limits import FrameLimits
    from seafoam.scene.presets import preset_names

    if preset not in preset_names():
        raise CommandError(f"PRESET: {preset!r} was not found; available: {', '.join(preset_names())}")
    found = find_preset(preset)
    extension = extension_of(output, FRAME_FORMATS)
    width, height = found.size if size is None else _size(size)
    given = {
        "time": time, "quality": quality, "budget_ms": budget_ms, "look": look, "mask": mask,
        "width": width, "height": height,
        "x": x, "y": y, "z": z, "yaw": yaw, "pitch": pitch, "roll": roll, "fov": fov,
    }  # fmt: skip
    try:
        asked = FrameParameters.model_validate({name: value for name, value in given.items() if value is not None})
        if (asked.quality == "auto") != (asked.budget_ms is not None):
            raise CommandError("--budget-ms: required with --quality auto, and allowed only with it")
        limits = FrameLimits(LARGEST_SIDE, LARGEST_SAMPLED_SIDE, LARGEST_SAMPLES)
        limits.check(width, height, 1 if asked.quality == "auto" else TIERS[asked.quality].samples_drawn)
        scene = asked.apply(found.scene)
    except ValidationError as error:
        refuse(error, FrameParameters, _frame_option)
    except FrameTooLargeError as error:
        raise CommandError(f"--size: {error}") from error
    except ApiError as error:
        raise CommandError(f"--{error}") from error
    at = found.time if asked.time is None else asked.time
    why = ""
    try:
        executor = Executor()
        if asked.quality == "auto":
            assert asked.budget_ms is not None
            subject = Subject(None if asked.changed else preset, scene, found.time, found.size)
            sweep = _measured(executor, subject, Settings())
            choice = choose(
                sweep, width, height, asked.budget_ms, lambda q: limits.allows(width, height, q.samples_drawn)
            )
            knobs, why = choice.point.quality, f"{choice.point.id}: {choice.why}"
        else:
            knobs = TIERS[asked.quality]
        job = FrameJob(scene, knobs, at, asked.camera(scene.camera), width, height, extension)
        frame = render_frame(executor, job)
        renderer = executor.info["renderer"]
    except PlanError as error:
        member = error.pointer.rpartition("/")[2]
        where = f"--{member}" if member in asked.changed else error.pointer or "scene"
        raise CommandError(f"{where}: {error.message}") from error
    except NoRendererError as error:
        raise CommandError(str(error), UNABLE) from error
    write(output, frame.content)
    times = ", ".join(f"{stage} {1000 * seconds:.0f} ms" for stage, seconds in frame.timings.items())
    typer.echo(f"{output}: {width} × {height}, {len(frame.content):,} bytes; {times}; {renderer}")
    if why:
        typer.echo(why)


@app.command()
def accuracy(
    preset: Annotated[str | None, typer.Argument(help="Name of a preset; `seafoam presets` lists them.")] = None,
    every: Annotated[
        bool, typer.Option("--all", help="Measure every preset; -o, --json, --csv and --html name directories.")
    ] = False,
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of the compared pictures, pixels.")] = "160x90",
    rounds: Annotated[int, typer.Option(min=2, max=100, help="Number of timed rounds per quality.")] = 7,
    samples: Annotated[
        int, typer.Option(min=2, max=32, help="Samples along each side of a pixel in the float64 reference.")
    ] = 16,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="Plot to write, a .png file.")] = None,
    as_json: Annotated[
        Path | None, typer.Option("--json", help="JSON file to write, in the format of the API.")
    ] = None,
    as_csv: Annotated[Path | None, typer.Option("--csv", help="CSV file to write.")] = None,
    as_html: Annotated[
        Path | None, typer.Option("--html", help="HTML report to write, a single page with plot and tables.")
    ] = None,
    again: Annotated[bool, typer.Option("--again", help="Measure again, ignoring stored results.")] = False,
) -> None:
    """Measure what accuracy costs in time: each tier and setting, against float64. Takes minutes; results are kept."""
    need_reports()
    from rich.console import Console
    from rich.table import Column, Table

    from seafoam.accuracy import report
    from seafoam.accuracy.sweep import Settings, Subject
    from seafoam.render.gl.executor import Executor, NoRendererError
    from seafoam.scene.presets import preset_names

    if (preset is None) != every:
        raise CommandError("PRESET or --all: exactly one is required")
    if preset is not None and preset not in preset_names():
        raise CommandError(f"PRESET: {preset!r} was not found; available: {', '.join(preset_names())}")
    width, height = _size(size)
    if not (16 <= width <= 1280 and 16 <= height <= 720):
        raise CommandError(f"--size: must be 16x16 to 1280x720, not {size!r}")
    places = {"--output": (output, ".png"), "--json": (as_json, ".json"), "--csv": (as_csv, ".csv")}
    places["--html"] = (as_html, ".html")
    for option, (path, extension) in places.items():
        if path is not None and not every and path.suffix.lower() != extension:
            raise CommandError(f"{option}: {path.name!r} must end in {extension}")
    try:
        executor = Executor()
    except NoRendererError as error:
        raise CommandError(str(error), UNABLE) from error
    console = Console()
    console.width = max(console.width, TABLE_WIDTH)
    for name in preset_names() if every else (str(preset),):
        sweep = _measured(executor, Subject.of_preset(name), Settings(width, height, samples, rounds), again=again)
        title = f"{name}: errors at {width} × {height}, times for {sweep.timing.own_width} × {sweep.timing.own_height}"
        first, *others = (Column(heading, no_wrap=True, justify="right") for heading in report.HEADINGS)
        first.justify = "left"
        table = Table(first, *others, title=title, title_justify="left", box=None, pad_edge=False)
        for point in sweep.points:
            table.add_row(*report.row_of(point), style="bold" if point.on_front else None)
        console.print(table)
        for sentence in (*sweep.sentences, *(step.sentence for step in sweep.steps)):
            console.print(f"  {sentence}", highlight=False, markup=False, soft_wrap=True)
        command = f"seafoam accuracy {'--all' if every else name} --size {size} --rounds {rounds} --samples {samples}"
        for path, extension in places.values():
            if path is not None:
                if every:
                    path.mkdir(parents=True, exist_ok=True)
                    path /= f"{name}{extension}"
                write(path, _report(sweep, extension, command))
                console.print(f"{path}", highlight=False, markup=False, soft_wrap=True)


def _report(sweep: "Sweep", extension: str, command: str) -> bytes:
    from seafoam.accuracy import plots, report

    match extension:
        case ".png":
            return plots.plot_sweep(sweep)
        case ".json":
            return (sweep.model_dump_json(indent=1) + "\n").encode()
        case ".csv":
            return report.csv_of(sweep).encode()
        case _:
            return report.page(sweep, command).encode()


def _measured(executor: "Executor", subject: "Subject", settings: "Settings", *, again: bool = False) -> "Sweep":
    """Return the sweep of a subject, from the cache or measured now, with a progress bar."""
    import os
    from functools import partial

    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

    from seafoam.accuracy.cache import Store
    from seafoam.accuracy.sweep import Rig, Watcher, make_sweep
    from seafoam.render.service.jobs import measure

    threads = int(os.environ.get("LP_NUM_THREADS") or os.cpu_count() or 1)
    rig = Rig(partial(measure, executor), executor.info, threads)
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeElapsedColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(f"{subject.preset or 'scene'}: float64 truth", total=1.0)

        def tell(stage: str, share: float, remaining: float | None) -> None:
            bar.update(task, completed=share, description=f"{subject.preset or 'scene'}: {stage}")

        return make_sweep(Store(), subject, settings, rig, Watcher(tell), again=again)


@app.command()
def presets() -> None:
    """List the presets."""
    from rich.console import Console
    from rich.table import Column, Table

    from seafoam.scene.presets import load_preset, preset_names

    name_column = Column("name", no_wrap=True)
    table = Table(name_column, "title", "size", "time", "summary", box=None, pad_edge=False)
    for name in preset_names():
        preset = load_preset(name)
        width, height = preset.size
        table.add_row(name, preset.title, f"{width}x{height}", f"{preset.time:g} s", preset.summary)
    Console().print(table)


@app.command()
def doctor() -> None:
    """Check this machine for what Seafoam needs, with a remedy for what is missing. Exit code 0: it can render."""
    from rich.console import Console
    from rich.text import Text

    from seafoam.doctor import able_to_render, examine

    console = Console(soft_wrap=True)
    marks = {"good": ("ok", "green"), "optional": ("--", "yellow"), "missing": ("no", "red")}
    findings = examine()
    for finding in findings:
        mark, style = marks[finding.state]
        console.print(Text(f"{finding.what:<13}") + Text(mark, style) + Text(f"  {finding.detail}"))
        if finding.remedy:
            console.print(Text(f"{'':<13}    {finding.remedy}", "bold"))
    able = able_to_render(findings)
    console.print(Text("This machine can render." if able else "This machine cannot render."))
    raise typer.Exit(0 if able else UNABLE)


@app.command()
def openapi() -> None:
    """Print the API's OpenAPI document."""
    from seafoam.api.app import create_app

    typer.echo(json.dumps(create_app().openapi(), indent=1, ensure_ascii=False))


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command and exit with 0, 1 if the machine lacks something, 2 for invalid input, 130 if interrupted."""
    try:
        code = app(arguments, standalone_mode=False)
    except TyperException as error:
        message = error.format_message()
        if message:  # empty where no arguments at all were given and the help has been shown
            typer.echo(f"seafoam: {message}", err=True)
        sys.exit(error.exit_code)
    except typer.Abort:
        sys.exit(130)
    sys.exit(code or 0)


def _not_a_probe(record: logging.LogRecord) -> bool:
    """Keep health checks, which arrive every few seconds, out of the access log."""
    arguments = record.args
    return not (isinstance(arguments, tuple) and len(arguments) > 2 and str(arguments[2]).startswith(_QUIET))


def _frame_option(field: str) -> str:
    return "--size" if field in ("width", "height") else f"--{field.replace('_', '-')}"


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,6})[x×](\d{1,6})", text)
    if found is None:
        raise CommandError(f"--size: must be WIDTHxHEIGHT in pixels, such as 1280x720, not {text!r}")
    return int(found[1]), int(found[2])
