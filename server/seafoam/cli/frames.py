"""The work of ``seafoam render``: a frame of a preset or of a picture's recipe, drawn in this process, to a file."""

import io
from collections.abc import Iterator, Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, ValidationError

from seafoam.api.http.parameters import FrameParameters, FrameRequest, TierOrQuality, Time
from seafoam.api.http.problems import ApiError
from seafoam.cli.support import UNABLE, CommandError, extension_of, option_of, refuse, size_of, write
from seafoam.extras import require
from seafoam.planner import PlanError
from seafoam.quality import TIERS
from seafoam.render.encode import FRAME_FORMATS, NoRecipeError, read_recipe
from seafoam.render.gl import executor as gl
from seafoam.render.service import jobs
from seafoam.render.service.errors import IN_PROCESS, FrameTooLargeError
from seafoam.scene import Camera, Preset, load_preset

FEW_SAMPLES = 250_000
"""Up to so many, a picture is there sooner if the code that draws it is not optimized."""


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
        executor = _executor(job, measures=parameters.quality == "auto")
        job, reason = _with_quality(executor, parameters, loaded, job)
        frame = jobs.render_frame(executor, job)
        renderer = executor.info["renderer"]
    except PlanError as error:
        member = error.pointer.rpartition("/")[2]
        where = f"--{member}" if member in parameters.changed else error.pointer or "scene"
        raise CommandError(f"{where}: {error.message}") from error
    write(output, frame.content)
    times = ", ".join(f"{stage} {1000 * seconds:.0f} ms" for stage, seconds in frame.timings.items())
    summary = f"{output}: {job.width} × {job.height}, {len(frame.content):,} bytes; {times}; {renderer}"
    return [summary, reason] if reason else [summary]


def _executor(job: jobs.FrameJob, *, measures: bool = False) -> gl.Executor:
    """The renderer of one frame; ``measures``: and of measurements."""
    drawn = job.width * job.height * job.quality.samples_drawn
    return gl.Executor(assisted=True, optimized=measures or drawn > FEW_SAMPLES)


def _validated(options: Mapping[str, object], pixels: tuple[int, int]) -> FrameParameters:
    fields = {**options, "width": pixels[0], "height": pixels[1]}
    try:
        given = FrameParameters.model_validate({name: value for name, value in fields.items() if value is not None})
    except ValidationError as error:
        refuse(error, FrameParameters, option_of)
    if (given.quality == "auto") != (given.budget_ms is not None):
        raise CommandError("--budget-ms: required with --quality auto, and allowed only with it")
    try:
        IN_PROCESS.check(*pixels, 1 if given.quality == "auto" else TIERS[given.quality].samples_drawn)
    except FrameTooLargeError as error:
        raise CommandError(f"--size: {error}") from error
    return given


def _with_quality(
    executor: gl.Executor, given: FrameParameters, preset: Preset, job: jobs.FrameJob
) -> tuple[jobs.FrameJob, str]:
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


class _Recipe(FrameRequest):
    """A recipe as it is read: a request with what it was drawn by; what earlier versions and the page do not write has
    what they drew with.
    """

    model_config = ConfigDict(extra="ignore")

    recipe: Literal[1]
    seafoam: str
    renderer: str
    plan: str | None = None
    quality: TierOrQuality
    camera: Camera
    time: Time
    width: int = Field(ge=1)
    height: int = Field(ge=1)
    dither: bool = False
    split: Any = None


def draw_again(source: Path, output: Path | None) -> tuple[bool, list[str]]:
    """Draw a picture from its recipe, write it where ``output`` is given, and compare it with the picture.

    Returns whether the bytes are the same, and the lines to print. Raises :class:`CommandError` for a file without a
    recipe that can be drawn.
    """
    try:
        content = source.read_bytes()
    except OSError as error:
        raise CommandError(f"--again: cannot read {source}: {error.strerror}", UNABLE) from error
    recipe = _read(source, content)
    job = recipe.job
    try:
        IN_PROCESS.check(job.width, job.height, job.quality.samples_drawn)
        executor = _executor(job)
        picture = jobs.draw_frame(executor, job)
    except FrameTooLargeError as error:
        raise CommandError(f"--again: {error}") from error
    except PlanError as error:
        raise CommandError(f"--again: {source}: {error.pointer or 'scene'}: {error.message}") from error
    again = jobs.encode_frame(picture, job).content
    if output is not None:
        write(output, again)
    if again == content:
        return True, [f"{source}: drawn again, the same {len(content):,} bytes"]
    renderer = jobs.renderer_of(picture.info)
    lines = [*_circumstances(recipe, jobs.plan_hash(job.scene, job.quality), renderer), _pixels(content, again)]
    return False, [f"{source}: drawn again, with a difference", *(f"  {line}" for line in lines)]


def _read(source: Path, content: bytes) -> _Recipe:
    try:
        recipe = _Recipe.model_validate_json(read_recipe(content), strict=True)
    except NoRecipeError as error:
        raise CommandError(f"--again: {source}: {error}") from error
    except ValidationError as error:
        # One is enough: a recipe of another version differs in much.
        first = error.errors()[0]
        where = "/" + "/".join(str(step) for step in first["loc"])
        what = f"its recipe cannot be drawn by version {version('seafoam')} (recipes of format {jobs.RECIPE_VERSION})"
        raise CommandError(f"--again: {source}: {what}: {where}: {first['msg']}") from error
    if recipe.split is not None:
        raise CommandError(f"--again: {source}: it shows two looks side by side, which only the page draws")
    return recipe


def _circumstances(recipe: _Recipe, plan: str, renderer: str) -> Iterator[str]:
    """Yield what was otherwise when the picture was made."""
    now = version("seafoam")
    if recipe.seafoam != now:
        yield f"version: {recipe.seafoam} then, {now} now"
    if recipe.renderer != renderer:
        yield f"renderer: {recipe.renderer} then, {renderer} now"
    if recipe.plan is None:
        yield "plan: its recipe does not name it"
    elif recipe.plan != plan:
        yield f"plan: {recipe.plan} then, {plan} now: shaders, numbers or textures have changed"


def _pixels(then: bytes, now: bytes) -> str:
    try:
        old, new = _decoded(then), _decoded(now)
    except (OSError, RuntimeError, ValueError) as error:
        return f"pixels: cannot be compared: {error}"
    if old.shape != new.shape:
        return f"pixels: {old.shape[1]} × {old.shape[0]} then, {new.shape[1]} × {new.shape[0]} now"
    differs = old != new
    if not differs.any():
        return "pixels: the same; the rest of the file differs: recipe, compression or other chunks"
    count = int(differs.any(axis=-1).sum())
    unit = "levels of 255" if old.dtype == np.uint8 else "in linear light"
    greatest = np.abs(old[differs].astype(np.float64) - new[differs].astype(np.float64)).max()
    return f"pixels: {count:,} of {old.shape[0] * old.shape[1]:,} differ, by at most {greatest:g} {unit}"


def _decoded(content: bytes) -> NDArray[Any]:
    """Return (height, width, channels)."""
    if content[:4] != b"v/1\x01":
        from PIL import Image

        with Image.open(io.BytesIO(content)) as picture:
            return np.asarray(picture.convert("RGB"))
    import OpenEXR

    channels = OpenEXR.File(io.BytesIO(content), separate_channels=True, num_threads=0).channels()
    return np.stack([channels[name].pixels for name in sorted(channels)], axis=-1)
