"""What callers may give for a frame, checked and completed into a job; and the errors of the interface for Python."""

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass
from functools import cache, wraps
from typing import Any, Concatenate, Literal, ParamSpec, TypeVar, cast, get_args

from pydantic import BaseModel, ValidationError
from pydantic.json_schema import models_json_schema

from seafoam.effects.registry import CHANGED
from seafoam.quality import TIERS, Quality, Tier
from seafoam.render.encode import FRAME_FORMATS, FrameFormat
from seafoam.render.service.errors import IN_PROCESS, FrameTooLargeError
from seafoam.render.service.jobs import FrameJob
from seafoam.scene import Camera, Foam, Look, Preset, Scene, load_preset, preset_names

P = ParamSpec("P")
Q = TypeVar("Q")
R = TypeVar("R")
S = TypeVar("S")


class InvalidRequestError(ValueError):
    """A value is not allowed; the text names it and what is."""


class ServerError(RuntimeError):
    """A server did not answer, or answered with an error. ``status``: of HTTP; 0 without an answer."""

    def __init__(self, detail: str, status: int = 0) -> None:
        super().__init__(detail)
        self.status = status


def asking(request: Callable[P, Q]) -> Callable[[Callable[[S, Q], R]], Callable[Concatenate[S, P], R]]:
    """Make of a method that takes a request one with the parameters of the function that makes it.

    Editors and ``help()`` show these parameters, which are written once.
    """

    def decorate(method: Callable[[S, Q], R]) -> Callable[Concatenate[S, P], R]:
        own, known = inspect.signature(method), inspect.signature(request).parameters
        shown = own.replace(parameters=[own.parameters["self"], *known.values()])

        @wraps(method)
        def asked(self: S, /, *args: P.args, **options: P.kwargs) -> R:
            return method(self, request(*args, **options))

        cast(Any, asked).__signature__ = shown
        return asked

    return decorate


SceneLike = str | Scene | Mapping[str, Any]
"""Name of a preset, a scene, or a scene's fields as JSON has them."""
QualityLike = Tier | Quality | Mapping[str, Any]
"""A tier, settings, or the fields that differ from tier standard."""
CameraLike = Camera | Mapping[str, Any]
"""A camera, or the fields that differ from the scene's."""
Size = tuple[int, int]
"""Width and height, pixels."""

TIME_LIMIT = 1e9
"""Greatest |time|, s."""
DEFAULT_SIZE: Size = (1280, 720)
M = TypeVar("M", bound=BaseModel)


@dataclass(frozen=True)
class PictureRequest:
    """A frame; what is absent is the preset's, or of a scene 0 s and 1280 × 720.

    time: s, |time| ≤ 1e9. size: pixels, each side 1 to 8192 and fewer with many samples. look, mask: of the foam.
    """

    what: SceneLike = "default"
    _: KW_ONLY
    time: float | None = None
    size: Size | None = None
    quality: QualityLike = "standard"
    camera: CameraLike | None = None
    look: str | None = None
    mask: str | None = None

    def job(self, format: FrameFormat = "png") -> FrameJob:
        """Return the job that draws it. Raises :class:`InvalidRequestError`."""
        named = preset(self.what) if isinstance(self.what, str) else None
        changes = {name: value for name, value in (("look", self.look), ("mask", self.mask)) if value is not None}
        scene = _with_foam(scene_of(self.what), changes)
        at = (named.time if named else 0.0) if self.time is None else self.time
        if isinstance(at, bool) or not isinstance(at, int | float) or not (math.isfinite(at) and abs(at) <= TIME_LIMIT):
            raise InvalidRequestError(f"time: must be {-TIME_LIMIT:g} to {TIME_LIMIT:g} s, not {at!r}")
        quality = quality_of(self.quality)
        size = _checked((named.size if named else DEFAULT_SIZE) if self.size is None else self.size, quality)
        if format not in FRAME_FORMATS:
            raise InvalidRequestError(f"format: must be one of {', '.join(FRAME_FORMATS)}, not {format!r}")
        camera = camera_of(self.camera, scene.camera)
        return FrameJob(scene, quality, float(at), camera, *size, format, named.name if named else None)


@dataclass(frozen=True)
class FileRequest(PictureRequest):
    """A frame in the format of a file."""

    format: FrameFormat = "png"


def preset(name: str) -> Preset:
    """Return a preset: scene, title, summary, recommended time (s) and size (pixels).

    Raises :class:`InvalidRequestError` if there is none of this name.
    """
    try:
        return load_preset(name)
    except KeyError:
        raise InvalidRequestError(f"preset {name!r} was not found; available: {', '.join(preset_names())}") from None


def scene_of(what: SceneLike) -> Scene:
    """Return the scene of a preset, or a checked one. Raises :class:`InvalidRequestError`."""
    if isinstance(what, Scene):
        return what
    if isinstance(what, str):
        return preset(what).scene
    return _read(Scene, "scene", what)


def quality_of(quality: QualityLike) -> Quality:
    """Return the settings of a tier, or checked ones. Raises :class:`InvalidRequestError`."""
    if isinstance(quality, Quality):
        return quality
    if isinstance(quality, str):
        if quality not in TIERS:
            raise InvalidRequestError(f"quality: must be one of {', '.join(TIERS)}, not {quality!r}")
        return TIERS[quality]
    return _read(Quality, "quality", quality)


def camera_of(camera: CameraLike | None, own: Camera) -> Camera:
    """Return a camera: ``own`` with the given fields. Raises :class:`InvalidRequestError`."""
    if camera is None or isinstance(camera, Camera):
        return camera or own
    return _read(Camera, "camera", {**own.model_dump(), **camera})


@cache
def schemas() -> dict[str, Any]:
    """Return the names of the tiers, and the JSON schemas of scene and quality: what an editor of them needs."""
    models: list[tuple[type[BaseModel], Literal["validation"]]] = [(Scene, "validation"), (Quality, "validation")]
    _, document = models_json_schema(models, ref_template="#/components/schemas/{model}")
    return {"tiers": list(TIERS), "components": {"schemas": document["$defs"]}}


CHANGED.append(schemas.cache_clear)


def _read(model: type[M], where: str, fields: Mapping[str, Any]) -> M:
    """Return a model with these fields. Raises :class:`InvalidRequestError` with all that is wrong, as one line."""
    try:
        return model.model_validate(fields)
    except ValidationError as error:
        lines = []
        for item in error.errors():
            place = "/".join(str(step) for step in (where, *item["loc"]))
            lines.append(f"{place}: {item['msg'].removeprefix('Value error, ')}, not {item['input']!r:.80}")
        raise InvalidRequestError("; ".join(lines)) from error


def _with_foam(scene: Scene, changes: Mapping[str, str]) -> Scene:
    if not changes:
        return scene
    if scene.foam is None:
        raise InvalidRequestError(f"{next(iter(changes))}: this scene has no foam")
    if changes.get("look", scene.foam.look) not in get_args(Look):
        raise InvalidRequestError(f"look: must be one of {', '.join(get_args(Look))}, not {changes['look']!r}")
    foam = _read(Foam, "foam", {**scene.foam.model_dump(), **changes})
    return scene.model_copy(update={"foam": foam})


def _checked(size: Any, quality: Quality) -> Size:
    fits = isinstance(size, tuple | list) and len(size) == 2
    if not fits or not all(isinstance(side, int) and not isinstance(side, bool) for side in size):
        raise InvalidRequestError(f"size: must be (width, height) in whole pixels, not {size!r}")
    width, height = size
    try:
        IN_PROCESS.check(width, height, quality.samples_drawn)
    except FrameTooLargeError as error:
        raise InvalidRequestError(f"size: {error}") from error
    return width, height
