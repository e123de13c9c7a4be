"""The work of ``seafoam render``: a frame of a preset, drawn in this process and written to a file."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from pydantic import ValidationError

from seafoam.api.http.parameters import FrameParameters
from seafoam.api.http.problems import ApiError
from seafoam.cli.support import CommandError, extension_of, refuse, size_of, write
from seafoam.extras import require
from seafoam.planner import PlanError
from seafoam.quality import TIERS
from seafoam.render.encode import FRAME_FORMATS
from seafoam.render.gl import executor as gl
from seafoam.render.service.errors import FrameTooLargeError
from seafoam.render.service.jobs import FrameJob, render_frame
from seafoam.render.service.limits import IN_PROCESS
from seafoam.scene.presets import Preset, load_preset


def render_to_file(preset: str, output: Path, size: str | None, options: Mapping[str, object]) -> list[str]:
    """Draw a preset with those options that are not None, write it, and return the lines to print.

    ``options``: fields of :class:`FrameParameters` except width and height. Raises :class:`CommandError`.
    """
    loaded = load_preset(preset)
    extension = extension_of(output, FRAME_FORMATS)
    pixels = loaded.size if size is None else size_of(size)
    parameters = _validated(options, pixels)
    try:
        job = parameters.job(loaded, extension)
    except ApiError as error:
        raise CommandError(f"--{error}") from error
    try:
        executor = gl.Executor()
        job, reason = _with_quality(executor, parameters, loaded, job)
        frame = render_frame(executor, job)
        renderer = executor.info["renderer"]
    except PlanError as error:
        member = error.pointer.rpartition("/")[2]
        where = f"--{member}" if member in parameters.changed else error.pointer or "scene"
        raise CommandError(f"{where}: {error.message}") from error
    write(output, frame.content)
    times = ", ".join(f"{stage} {1000 * seconds:.0f} ms" for stage, seconds in frame.timings.items())
    summary = f"{output}: {job.width} × {job.height}, {len(frame.content):,} bytes; {times}; {renderer}"
    return [summary, reason] if reason else [summary]


def _validated(options: Mapping[str, object], pixels: tuple[int, int]) -> FrameParameters:
    fields = {**options, "width": pixels[0], "height": pixels[1]}
    try:
        given = FrameParameters.model_validate({name: value for name, value in fields.items() if value is not None})
    except ValidationError as error:
        refuse(error, FrameParameters, _option)
    if (given.quality == "auto") != (given.budget_ms is not None):
        raise CommandError("--budget-ms: required with --quality auto, and allowed only with it")
    try:
        IN_PROCESS.check(*pixels, 1 if given.quality == "auto" else TIERS[given.quality].samples_drawn)
    except FrameTooLargeError as error:
        raise CommandError(f"--size: {error}") from error
    return given


def _with_quality(executor: gl.Executor, given: FrameParameters, preset: Preset, job: FrameJob) -> tuple[FrameJob, str]:
    """The frame in the quality to draw it with, and the reason if this was chosen by measurement."""
    if given.quality != "auto":
        return job, ""
    assert given.budget_ms is not None
    require("reports")
    # Here, because no other frame needs what measurements do.
    from seafoam.accuracy.sweep import Subject, SweepSettings
    from seafoam.accuracy.timing import choose
    from seafoam.cli.sweeps import measured

    subject = Subject(None if given.changed else preset.name, job.scene, preset.time, preset.size)
    sweep = measured(executor, subject, SweepSettings())
    size = job.width, job.height
    choice = choose(sweep, *size, given.budget_ms, lambda quality: IN_PROCESS.allows(*size, quality.samples_drawn))
    return replace(job, quality=choice.point.quality), f"{choice.point.id}: {choice.why}"


def _option(field: str) -> str:
    return "--size" if field in ("width", "height") else f"--{field.replace('_', '-')}"
