"""What callers may give for a frame, checked and completed into a job."""

import math
from collections.abc import Mapping
from typing import Any, get_args

from pydantic import ValidationError

from seafoam.library.errors import InvalidRequestError
from seafoam.quality import TIERS, Quality, Tier
from seafoam.render.encode import FRAME_FORMATS, FrameFormat
from seafoam.render.service.errors import FrameTooLargeError
from seafoam.render.service.jobs import FrameJob
from seafoam.render.service.limits import IN_PROCESS
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Look
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names

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


def job_of(
    what: SceneLike = "default",
    format: FrameFormat = "png",
    *,
    time: float | None = None,
    size: Size | None = None,
    quality: QualityLike = "standard",
    camera: CameraLike | None = None,
    look: str | None = None,
    mask: str | None = None,
) -> FrameJob:
    """Return the job of a frame; what is absent is the preset's, or of a scene 0 s and 1280 × 720.

    time: s, |time| ≤ 1e9. size: pixels, each side 1 to 8192 and fewer with many samples. look, mask: of the foam.
    Raises :class:`InvalidRequestError`.
    """
    preset = None
    if isinstance(what, str):
        if what not in preset_names():
            raise InvalidRequestError(f"preset {what!r} was not found; available: {', '.join(preset_names())}")
        preset = load_preset(what)
    scene = scene_of(what if preset is None else preset.scene)
    scene = _with_foam(scene, {name: value for name, value in (("look", look), ("mask", mask)) if value is not None})
    at = (preset.time if preset else 0.0) if time is None else time
    if isinstance(at, bool) or not isinstance(at, int | float) or not (math.isfinite(at) and abs(at) <= TIME_LIMIT):
        raise InvalidRequestError(f"time: must be {-TIME_LIMIT:g} to {TIME_LIMIT:g} s, not {at!r}")
    chosen = quality_of(quality)
    width, height = _checked((preset.size if preset else DEFAULT_SIZE) if size is None else size, chosen)
    if format not in FRAME_FORMATS:
        raise InvalidRequestError(f"format: must be one of {', '.join(FRAME_FORMATS)}, not {format!r}")
    eye = camera_of(camera, scene.camera)
    return FrameJob(scene, chosen, float(at), eye, width, height, format, preset.name if preset else None)


def scene_of(what: SceneLike) -> Scene:
    """Return the scene of a preset, or a checked one. Raises :class:`InvalidRequestError`."""
    if isinstance(what, Scene):
        return what
    if isinstance(what, str):
        return job_of(what).scene
    try:
        return Scene.model_validate(what)
    except ValidationError as error:
        raise InvalidRequestError.of("scene", error) from error


def quality_of(quality: QualityLike) -> Quality:
    """Return the settings of a tier, or checked ones. Raises :class:`InvalidRequestError`."""
    if isinstance(quality, Quality):
        return quality
    if isinstance(quality, str):
        if quality not in TIERS:
            raise InvalidRequestError(f"quality: must be one of {', '.join(TIERS)}, not {quality!r}")
        return TIERS[quality]
    try:
        return Quality.model_validate(quality)
    except ValidationError as error:
        raise InvalidRequestError.of("quality", error) from error


def camera_of(camera: CameraLike | None, own: Camera) -> Camera:
    """Return a camera: ``own`` with the given fields. Raises :class:`InvalidRequestError`."""
    if camera is None or isinstance(camera, Camera):
        return camera or own
    try:
        return Camera.model_validate({**own.model_dump(), **camera})
    except ValidationError as error:
        raise InvalidRequestError.of("camera", error) from error


def _with_foam(scene: Scene, changes: Mapping[str, str]) -> Scene:
    if not changes:
        return scene
    if scene.foam is None:
        raise InvalidRequestError(f"{next(iter(changes))}: this scene has no foam")
    if changes.get("look", scene.foam.look) not in get_args(Look):
        raise InvalidRequestError(f"look: must be one of {', '.join(get_args(Look))}, not {changes['look']!r}")
    try:
        foam = type(scene.foam).model_validate({**scene.foam.model_dump(), **changes})
    except ValidationError as error:
        raise InvalidRequestError.of("foam", error) from error
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
