"""Jobs of render workers, the recipes of their frames, their results, and the functions that run them.

``seafoam render --again`` draws a frame from its recipe once more. The web client reads that of PNG files back
(``webclient/src/take/recipe.ts``), and writes the same members into its own PNG files.
"""

import json
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, Literal, Protocol, get_args

import numpy as np
from numpy.typing import NDArray

from seafoam.effects.registry import CHANGED
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_geometry_plan, make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.encode import BYTES_PER_PIXEL, FrameFormat, Output, Precision, encode, encode_jpeg, output_of
from seafoam.scene import Camera, Scene

if TYPE_CHECKING:
    from seafoam.render.gl.executor import RenderedPixels

RECIPE_VERSION = 1


def described(quality: Quality) -> str | dict[str, Any]:
    """Return the name of the tier with these settings, or the settings that differ from tier standard."""
    tier = next((name for name, settings in TIERS.items() if settings == quality), None)
    return tier or quality.model_dump(mode="json", exclude_defaults=True)


def renderer_of(info: Mapping[str, str]) -> str:
    """Return a renderer as recipes name it. info: its ``renderer`` and ``version``."""
    return f"{info['renderer']}, {info['version']}"


@dataclass(frozen=True, slots=True)
class FrameJob:
    """One frame to render: everything that its bytes depend on."""

    scene: Scene
    quality: Quality
    time: float
    """Seconds, |time| ≤ 1e9."""
    camera: Camera
    width: int
    """Pixels."""
    height: int
    """Pixels."""
    format: FrameFormat
    preset: str | None = None
    """Name of the preset that the scene began from; only the recipe has it."""
    dither: bool = True
    """Whether 8 bits are dithered from 16, for ``png`` and ``webp``; else they are rounded as the page rounds them."""
    precision: Precision = "half"
    """Numbers of ``exr``."""
    lossy: bool = False
    """Whether it is a frame in motion: JPEG without recipe, of undithered ``png``."""

    @property
    def output(self) -> Output:
        """What a renderer must give for it."""
        return output_of(self.format, self.dither)

    @property
    def bytes(self) -> int:
        """Of its pixels before they are encoded; those of ``exr`` have normal and distance too."""
        return self.width * self.height * BYTES_PER_PIXEL[self.output] * (2 if self.format == "exr" else 1)

    @property
    def plans(self) -> tuple[FramePlan, ...]:
        """Its frame plan, and that of normal and distance, if it has them. Raises ``PlanError``."""
        makers = (make_plan, make_geometry_plan) if self.format == "exr" else (make_plan,)
        return tuple(make(self.scene, self.quality) for make in makers)

    @property
    def request(self) -> dict[str, Any]:
        """What ``/api/frames`` takes for it, ``dither`` and ``precision`` only with formats that they concern."""
        return {
            "format": self.format,
            "preset": self.preset,
            # With the frame's camera, whether it was sent in the scene or beside it: the same frame has the same bytes.
            "scene": self.scene.model_copy(update={"camera": self.camera}).model_dump(mode="json"),
            "quality": described(self.quality),
            "camera": self.camera.model_dump(mode="json"),
            "time": self.time,
            "width": self.width,
            "height": self.height,
            **({"dither": self.dither} if self.format in ("png", "webp") else {}),
            **({"precision": self.precision} if self.format == "exr" else {}),
        }

    def recipe(self, info: Mapping[str, str], plan: str) -> str:
        """Return the recipe as JSON with sorted keys: the same job on the same renderer gives the same text.

        info: the renderer's ``renderer`` and ``version``. plan: SHA-256 of the frame plan.
        """
        made = {"recipe": RECIPE_VERSION, "seafoam": version("seafoam"), "renderer": renderer_of(info), "plan": plan}
        return json.dumps(made | self.request, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class Picture:
    """What a renderer drew for a job, before it is encoded. ``timings``: seconds by ``plan``, ``render``, ``read``."""

    pixels: NDArray[Any]
    """(height, width, 4), top row first, as :func:`seafoam.render.encode.output_of` says; or (height, width, 8) with
    normal and distance (:func:`seafoam.planner.make_geometry_plan`). Between processes a
    :class:`seafoam.render.service.shared_buffer.SharedPixels` can stand for them."""
    info: Mapping[str, str]
    """The renderer's ``vendor``, ``renderer`` and ``version``."""
    timings: Mapping[str, float]


Origin = Literal["memory", "disk", "shared", "drawn"]
"""Where a frame came from; ``shared``: drawn once for several requests."""


@dataclass(frozen=True, slots=True)
class EncodedFrame:
    """An encoded frame and its times, if it was drawn: seconds by ``queue``, ``plan``, ``render``, ``read``,
    ``encode``."""

    content: bytes
    timings: Mapping[str, float]
    origin: Origin = "drawn"


@dataclass(frozen=True, slots=True)
class Draw:
    """One drawing of a measurement. ``keep``: return its pixels; ``target``: those of a target of the plan in place of
    the picture's, none where the plan lacks it."""

    width: int
    height: int
    output: Literal["rgba8", "linear"]
    keep: bool = False
    target: str | None = None


Timer = Literal["wall", "processor"]
"""``processor``: of all threads, for software renderers on machines with other work."""
TIMERS: tuple[Timer, ...] = get_args(Timer)


@dataclass(frozen=True, slots=True)
class MeasureJob:
    """A frame to draw several times, to measure its time."""

    scene: Scene
    quality: Quality
    time: float
    """Seconds of the scene."""
    camera: Camera
    draws: tuple[Draw, ...]
    timer: Timer = "wall"


@dataclass(frozen=True, slots=True)
class Drawn:
    """Time of one drawing, from the first call until it was finished, and its pixels if requested.

    By timer ``processor`` it is the processor time of this process, with the reading of the pixels.
    """

    seconds: float
    pixels: NDArray[Any] | None


class Renderer(Protocol):
    """What a worker renders with: :class:`seafoam.render.gl.executor.Executor`, or a test's stand-in."""

    @property
    def info(self) -> Mapping[str, str]:
        """``vendor``, ``renderer`` and ``version``."""

    def render(
        self, plan: FramePlan, *, time: float, camera: Camera, width: int, height: int, output: Output
    ) -> "RenderedPixels":
        """Draw one frame."""


@lru_cache(maxsize=8192)
def plan_hash(scene: Scene, quality: Quality) -> str:
    """Return the SHA-256 of a scene's frame plan. Raises :class:`seafoam.planner.PlanError`."""
    return make_plan(scene, quality).sha256


CHANGED.append(plan_hash.cache_clear)


def draw_frame(renderer: Renderer, job: FrameJob) -> Picture:
    """Plan and render one frame in this process.

    Raises :class:`seafoam.planner.PlanError` for a scene that cannot be planned, and what the renderer raises.
    """
    began = time.perf_counter()
    plan, *geometry = job.plans
    planned = time.perf_counter()
    render = partial(renderer.render, time=job.time, camera=job.camera, width=job.width, height=job.height)
    drawn = [render(plan, output=job.output), *(render(each, output="linear") for each in geometry)]
    pixels = np.concatenate([one.pixels for one in drawn], axis=-1) if geometry else drawn[0].pixels
    timings = {name: sum(one.timings[name] for one in drawn) for name in ("render", "read")}
    timings["plan"] = planned - began
    return Picture(pixels, dict(renderer.info), timings)


def encode_frame(picture: Picture, job: FrameJob) -> EncodedFrame:
    """Encode what was drawn for a job; needs no renderer, so that it can run beside the next frame."""
    began = time.perf_counter()
    if job.lossy:
        content = encode_jpeg(picture.pixels)
    else:
        recipe = job.recipe(picture.info, plan_hash(job.scene, job.quality))
        content = encode(picture.pixels, job.format, recipe, precision=job.precision)
    return EncodedFrame(content, {**picture.timings, "encode": time.perf_counter() - began})


def render_frame(renderer: Renderer, job: FrameJob) -> EncodedFrame:
    """Plan, render and encode one frame in this process. Raises what :func:`draw_frame` raises."""
    return encode_frame(draw_frame(renderer, job), job)


def measure(renderer: Renderer, job: MeasureJob) -> tuple[Drawn, ...]:
    """Plan a frame and draw it as often as the job requires, in this process. Raises as :func:`draw_frame` does."""
    plan = make_plan(job.scene, job.quality)
    drawn = []
    for draw in job.draws:
        shown = plan if draw.target is None else plan.model_copy(update={"linear": draw.target})
        if shown.linear not in ("screen", *plan.targets):
            drawn.append(Drawn(0.0, np.zeros((0, 0, 4), np.float32)))
            continue
        began = time.process_time()
        rendered = renderer.render(
            shown, time=job.time, camera=job.camera, width=draw.width, height=draw.height, output=draw.output
        )
        spent = time.process_time() - began if job.timer == "processor" else rendered.timings["render"]
        drawn.append(Drawn(spent, rendered.pixels if draw.keep else None))
    return tuple(drawn)
