"""The work of ``seafoam render``: a frame of a preset, drawn in this process and written to a file."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from pydantic import ValidationError

from seafoam.api.http.parameters import FrameParameters
from seafoam.api.http.problems import ApiError
from seafoam.cli.support import UNABLE, CommandError, extension_of, refuse, size_of, write
from seafoam.extras import require_reports
from seafoam.planner import PlanError
from seafoam.quality import TIERS, Quality
from seafoam.render.encode import FRAME_FORMATS
from seafoam.render.gl import executor as gl
from seafoam.render.service.errors import FrameTooLargeError
from seafoam.render.service.jobs import FrameJob, render_frame
from seafoam.render.service.limits import IN_PROCESS
from seafoam.scene.models import Scene
from seafoam.scene.presets import Preset, load_preset


@dataclass(frozen=True)
class _Request:
    """A frame to draw. ``parameters``: the validated options; ``time``: s; ``size``: pixels."""

    parameters: FrameParameters
    preset: Preset
    scene: Scene
    time: float
    size: tuple[int, int]


def render_to_file(preset: str, output: Path, size: str | None, options: Mapping[str, object]) -> list[str]:
    """Draw a preset with those options that are not None, write it, and return the lines to print.

    ``options``: fields of :class:`FrameParameters` except width and height. Raises :class:`CommandError`.
    """
    loaded = load_preset(preset)
    extension = extension_of(output, FRAME_FORMATS)
    width, height = loaded.size if size is None else size_of(size)
    request = _validated(loaded, (width, height), options)
    try:
        executor = gl.Executor()
        quality, reason = _quality(executor, request)
        camera = request.parameters.camera(request.scene.camera)
        ways = request.parameters.dither, request.parameters.precision
        job = FrameJob(request.scene, quality, request.time, camera, width, height, extension, loaded.name, *ways)
        frame = render_frame(executor, job)
        renderer = executor.info["renderer"]
    except PlanError as error:
        member = error.pointer.rpartition("/")[2]
        where = f"--{member}" if member in request.parameters.changed else error.pointer or "scene"
        raise CommandError(f"{where}: {error.message}") from error
    except gl.NoRendererError as error:
        raise CommandError(str(error), UNABLE) from error
    write(output, frame.content)
    times = ", ".join(f"{stage} {1000 * seconds:.0f} ms" for stage, seconds in frame.timings.items())
    summary = f"{output}: {width} × {height}, {len(frame.content):,} bytes; {times}; {renderer}"
    return [summary, reason] if reason else [summary]


def _validated(preset: Preset, size: tuple[int, int], options: Mapping[str, object]) -> _Request:
    fields: dict[str, object] = {"width": size[0], "height": size[1], **options}
    try:
        parameters = FrameParameters.model_validate(
            {name: value for name, value in fields.items() if value is not None}
        )
        automatic = parameters.quality == "auto"
        if automatic != (parameters.budget_ms is not None):
            raise CommandError("--budget-ms: required with --quality auto, and allowed only with it")
        IN_PROCESS.check(*size, 1 if parameters.quality == "auto" else TIERS[parameters.quality].samples_drawn)
        scene = parameters.apply(preset.scene)
    except ValidationError as error:
        refuse(error, FrameParameters, _option)
    except FrameTooLargeError as error:
        raise CommandError(f"--size: {error}") from error
    except ApiError as error:
        raise CommandError(f"--{error}") from error
    time = preset.time if parameters.time is None else parameters.time
    return _Request(parameters, preset, scene, time, size)


def _quality(executor: gl.Executor, request: _Request) -> tuple[Quality, str]:
    """The quality to draw with, and the reason if it was chosen by measurement."""
    parameters = request.parameters
    if parameters.quality != "auto":
        return TIERS[parameters.quality], ""
    assert parameters.budget_ms is not None
    require_reports()
    # Here, because no other frame needs what measurements do.
    from seafoam.accuracy.sweep import Subject, SweepSettings
    from seafoam.accuracy.timing import choose
    from seafoam.cli.sweeps import measured

    preset = request.preset
    subject = Subject(None if parameters.changed else preset.name, request.scene, preset.time, preset.size)
    sweep = measured(executor, subject, SweepSettings())
    choice = choose(
        sweep, *request.size, parameters.budget_ms, lambda q: IN_PROCESS.allows(*request.size, q.samples_drawn)
    )
    return choice.point.quality, f"{choice.point.id}: {choice.why}"


def _option(field: str) -> str:
    return "--size" if field in ("width", "height") else f"--{field.replace('_', '-')}"
