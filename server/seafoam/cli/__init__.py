"""The command ``seafoam``: serve, render, sequence, accuracy, plan, masks, sign, doctor.

Invalid input prints one line that names the field and its allowed values, with exit code 2; a missing driver or tool
prints one line with the remedy, with exit code 1. Commands import heavy modules themselves, because spawned render
workers import this module too.
"""

import io
import json
import sys
import webbrowser
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from typer.exceptions import TyperException

from seafoam.cli.masks import masks
from seafoam.cli.support import OUTPUT, UNABLE, CommandError, Serve, member_of, print_table, refuse, say, size_of
from seafoam.extras import UnableError, require
from seafoam.processes import SCHEDULER

if TYPE_CHECKING:
    from seafoam.api.settings import Settings

app = typer.Typer(
    help="Real-time water with halftoned foam.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(masks, name="masks")

OPEN_CONNECTIONS = 256
"""Connections beyond which the server answers 503 at once: a page uses a dozen; the render queue has its own limit."""


def _known(preset: str | None) -> str | None:
    from seafoam.scene import preset_names

    if preset is not None and preset not in preset_names():
        raise CommandError(f"PRESET: {preset!r} was not found; available: {', '.join(preset_names())}")
    return preset


# Options of commands that draw frames; absent ones are the preset's.
_PRESET = typer.Argument(help="Name of a preset; `seafoam presets` lists them.", callback=_known)
Preset = Annotated[str, _PRESET]
PresetName = Annotated[str | None, _PRESET]
Size = Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels (default: the preset's).")]
TierName = Annotated[str, typer.Option(help="fast, standard, high or reference.")]
LookName = Annotated[str | None, typer.Option(help="Foam look (default: the preset's).")]
MaskName = Annotated[
    str | None,
    typer.Option(help="Foam mask: a shipped one, or family:sigma:size:seed[:aspect:age] (default: the preset's)."),
]


@app.command()
def sequence(
    preset: Preset,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Directory for frames, or a .mp4, .webp (lossless) or .zip file.")
    ],
    stop: Annotated[float, typer.Option(help="Time before which the last frame is, s.")],
    start: Annotated[float | None, typer.Option(help="Time of the first frame, s (default: the preset's).")] = None,
    fps: Annotated[
        str, typer.Option(help="Frames per second, such as 29.97 or 30000/1001, which are the same.")
    ] = "24",
    size: Size = None,
    quality: TierName = "standard",
    look: LookName = None,
    mask: MaskName = None,
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
    from seafoam.cli import sequences

    wanted = sequences.output_of(output, codec)
    pixels = None if size is None else size_of(size)
    spec = sequences.spec_of(preset, start, stop, fps, {"size": pixels, "quality": quality, "look": look, "mask": mask})
    try:
        say(sequences.make(spec, wanted, sequences.working(workers, scheduler, mixed), again=again))
    except KeyboardInterrupt:
        say("seafoam: interrupted; the same command goes on from here", err=True)
        raise typer.Abort from None


@app.command(cls=Serve)
def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on (SEAFOAM_HOST).")] = None,
    port: Annotated[int | None, typer.Option(help="Port to listen on; 0 selects a free one (SEAFOAM_PORT).")] = None,
    open_browser: Annotated[bool, typer.Option("--open", help="Open the web client in a browser.")] = False,
) -> None:
    """Serve the web client and the API. Environment variables set what the options do not."""
    import uvicorn

    from seafoam.accuracy.cache import cache_dir
    from seafoam.allocator import share_one_arena
    from seafoam.api.app import create_app
    from seafoam.api.watch import logs
    from seafoam.cli.listening import keep_programs, listen

    share_one_arena()
    settings = _settings({name: value for name, value in (("host", host), ("port", port)) if value is not None})
    keep_programs((settings.cache or cache_dir()) / "mesa")
    application = create_app(settings)
    listening, address = listen(settings.host, settings.port)
    # The application itself heeds what trusted proxies say.
    config = uvicorn.Config(
        application,
        limit_concurrency=OPEN_CONNECTIONS,
        timeout_graceful_shutdown=5,
        proxy_headers=False,
        **logs.configure(settings.log_format),
    )

    # Who connects at once is answered when the application has started.
    say(f"Seafoam is at {address}  (API: {address}/docs)")
    if open_browser:
        webbrowser.open(address)
    uvicorn.Server(config).run(sockets=[listening])


@app.command()
def render(
    preset: PresetName = None,
    output: Annotated[Path | None, OUTPUT] = None,
    again: Annotated[
        Path | None,
        typer.Option(help="Draw this picture from its recipe, and say what differs. Exit code 0: the same bytes."),
    ] = None,
    time: Annotated[float | None, typer.Option(help="Time, s (default: the preset's).")] = None,
    size: Size = None,
    quality: Annotated[
        str | None,
        typer.Option(
            help="fast, standard, high, reference, or auto: the most exact that fits --budget-ms (default: standard)."
        ),
    ] = None,
    budget_ms: Annotated[
        float | None,
        typer.Option(help="With auto: maximum frame time, ms. The first use measures, which takes minutes."),
    ] = None,
    look: LookName = None,
    mask: MaskName = None,
    x: Annotated[
        float | None,
        typer.Option(help="Camera position along +x, m (default: the preset's, as for all camera options)."),
    ] = None,
    y: Annotated[float | None, typer.Option(help="Camera height above still water, m.")] = None,
    z: Annotated[float | None, typer.Option(help="Camera position along +z, m.")] = None,
    yaw: Annotated[float | None, typer.Option(help="Camera yaw, rad from -z toward +x.")] = None,
    pitch: Annotated[float | None, typer.Option(help="Camera pitch, rad; positive looks up.")] = None,
    roll: Annotated[float | None, typer.Option(help="Camera roll about the view axis, rad.")] = None,
    fov: Annotated[float | None, typer.Option(help="Vertical field of view, rad.")] = None,
    dither: Annotated[
        bool | None,
        typer.Option(
            "--dither/--no-dither",
            help="Of .png and .webp: dither 8 bits from 16, or round as the page does (default: dither).",
        ),
    ] = None,
    precision: Annotated[str | None, typer.Option(help="Of .exr: half or float (default: half).")] = None,
) -> None:
    """Render a frame to a .png, .webp (lossless), .exr (linear) or .npy (linear float32) file, without a server."""
    given: dict[str, Any] = {
        "time": time, "quality": quality, "budget_ms": budget_ms, "look": look, "mask": mask,
        "x": x, "y": y, "z": z, "yaw": yaw, "pitch": pitch, "roll": roll, "fov": fov,
        "dither": dither, "precision": precision,
    }  # fmt: skip
    if again is not None:
        _draw_again(again, output, {"PRESET": preset, "size": size, **given})
        return
    if preset is None or output is None:
        raise CommandError(f"{'PRESET' if preset is None else '--output'}: required, unless --again names a picture")
    from seafoam.cli.frames import render_to_file

    for line in render_to_file(preset, output, size, given):
        say(line)


@app.command()
def accuracy(
    preset: PresetName = None,
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
    timer: Annotated[
        str, typer.Option(help="wall, or processor: processor time, for llvmpipe on a machine with other work.")
    ] = "wall",
    scheduler: Annotated[str | None, typer.Option(help=SCHEDULER)] = None,
) -> None:
    """Measure time against error: each tier and setting, compared with float64. Takes minutes; results are stored."""
    require("reports")
    if (preset is None) != every:
        raise CommandError("PRESET or --all: exactly one is required")
    width, height = size_of(size)
    if not (16 <= width <= 1280 and 16 <= height <= 720):
        raise CommandError(f"--size: must be 16x16 to 1280x720, not {size!r}")
    from seafoam.accuracy.sweep import SweepSettings
    from seafoam.cli.sweeps import measure_presets
    from seafoam.render.service.jobs import TIMERS

    clock = member_of(timer, TIMERS, "--timer")
    files = {("--output", ".png"): output, ("--json", ".json"): as_json, ("--csv", ".csv"): as_csv}
    files["--html", ".html"] = as_html
    measure_presets(
        preset, size, SweepSettings(width, height, samples, rounds, clock), files, again=again, scheduler=scheduler
    )


@app.command()
def presets() -> None:
    """List the presets."""
    from seafoam.scene import load_preset, preset_names

    rows = [
        (each.name, each.title, "{}x{}".format(*each.size), f"{each.time:g} s", each.summary)
        for each in map(load_preset, preset_names())
    ]
    print_table(rows, "name", "title", "size", "time", "summary", unwrapped="name")


@app.command()
def plan(
    preset: Preset,
    quality: TierName = "standard",
    program: Annotated[
        str | None, typer.Option(help="Print this program's shader, with the names of its files, such as surface.")
    ] = None,
    stage: Annotated[str, typer.Option(help="Of the program: fragment or vertex.")] = "fragment",
) -> None:
    """List the passes of a preset's frame plan, or print the GLSL of one of its programs."""
    from seafoam.planner import make_plan
    from seafoam.quality import TIERS
    from seafoam.scene import load_preset

    tier = member_of(quality, tuple(TIERS), "--quality")
    part = member_of(stage, ("fragment", "vertex"), "--stage")
    made = make_plan(load_preset(preset).scene, TIERS[tier])
    if program is not None:
        shown = made.programs[member_of(program, tuple(made.programs), "--program")]
        shader = shown.fragment if part == "fragment" else shown.vertex
        names = {file.line: file.path for file in shader.files}
        for number, line in enumerate(shader.text.splitlines(), start=1):
            if number in names:
                say(f"// ---- {names[number]}")
            say(line)
        return
    rows = []
    for one in made.passes:
        shader = made.programs[one.program].fragment
        files, lines = sum(1 for file in shader.files if file.path), shader.text.count("\n")
        rows.append((one.name, one.program, one.target, one.when, str(files), str(lines)))
    columns = ("pass", "program", "target", "drawn", "files", "lines")
    print_table(rows, *columns, unwrapped="program", soft_wrap=True)


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

    typer.echo(json.dumps(create_app().openapi(), indent=1, ensure_ascii=False).encode())


@app.command()
def sign(address: Annotated[str, typer.Argument(help="Path of the API with its query, as it will be sent.")]) -> None:
    """Print the signed link of an address, with SEAFOAM_SIGNING_KEY and SEAFOAM_SIGNING_SALT from the environment.

    It is below SEAFOAM_ROOT_PATH, if that is set; the signature is that of the address, which the proxy passes on.
    """
    settings = _settings({})
    signing = settings.access.signing
    if signing is None:
        raise CommandError("SEAFOAM_SIGNING_KEY and SEAFOAM_SIGNING_SALT: required, in hexadecimal digits")
    try:
        say(settings.root_path.rstrip("/") + signing.link(address))
    except ValueError as error:
        raise CommandError(f"ADDRESS: {error}") from error


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command and exit with 0, 1 if the machine lacks something, 2 for invalid input, 130 if interrupted."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # What a console cannot show must not end the command.
            stream.reconfigure(errors="backslashreplace")
    try:
        code = app(arguments, standalone_mode=False)
    except TyperException as error:
        message = error.format_message()
        if message:  # empty where no arguments at all were given and the help has been shown
            say(f"seafoam: {message}", err=True)
        sys.exit(error.exit_code)
    except UnableError as error:
        say(f"seafoam: {error}", err=True)
        sys.exit(UNABLE)
    except typer.Abort:
        sys.exit(130)
    sys.exit(code or 0)


def _draw_again(picture: Path, output: Path | None, others: Mapping[str, Any]) -> None:
    if extra := [name for name, value in others.items() if value is not None]:
        names = ", ".join(name if name.isupper() else f"--{name.replace('_', '-')}" for name in extra)
        raise CommandError(f"{names}: not allowed with --again, which draws what the picture's recipe says")
    from seafoam.cli.frames import draw_again

    same, lines = draw_again(picture, output)
    for line in lines:
        say(line)
    if not same:
        raise typer.Exit(UNABLE)


def _settings(options: Mapping[str, Any]) -> "Settings":
    from pydantic import ValidationError

    from seafoam.api.settings import Settings

    try:
        return Settings(**options)
    except ValidationError as error:
        refuse(error, Settings, lambda field: f"--{field}" if field in options else f"SEAFOAM_{field.upper()}")
