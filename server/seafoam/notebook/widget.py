"""``Water``: the live water in a notebook, its scene shared with Python both ways, and what its page asks of Python.

All of it travels over the notebook's own connection, so a notebook on another machine needs no server and no open port.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import anywidget
import traitlets
from PIL.Image import Image

from seafoam.library import frame, request
from seafoam.library.request import InvalidRequestError, quality_of, scene_of, schemas
from seafoam.masks.catalogue import load_catalogue
from seafoam.planner import PlanError, make_plan
from seafoam.render.service.jobs import described
from seafoam.resources import data_dir
from seafoam.textures.store import spec_of, texture

CLIENT = "notebook/seafoam-widget.js"
"""The widget's page, in the built web client."""


def _client() -> Path:
    path = data_dir("webclient") / CLIENT
    if not path.is_file():
        raise RuntimeError(f"{path} is missing: the web client is not built; run: make webclient")
    return path


def _to_json(value: Any, _: object) -> Any:
    return value if value is None else value.model_dump(mode="json")


class _CheckedTrait(traitlets.TraitType[Any, Any]):
    """A trait that takes what a request takes, in the words of its errors. check: of the widget and the value."""

    def __init__(self, check: Callable[[Any, Any], Any], default: Any = traitlets.Undefined) -> None:
        super().__init__(default)
        self._check = check

    def validate(self, obj: Any, value: Any) -> Any:
        try:
            return self._check(obj, value)
        except InvalidRequestError as error:
            raise traitlets.TraitError(str(error)) from error


class WaterWidget(anywidget.AnyWidget):
    """Water in a notebook: it moves, a drag moves the camera, and a panel has every field of the scene.

    what: a preset's name, a :class:`seafoam.Scene` or its fields. time: s, absent: the preset's. quality: a tier or
    settings. Each argument is a trait of the same name; assignment changes the picture, and what is changed in the
    picture is read back from the trait. Raises :class:`seafoam.InvalidRequestError` here, and ``traitlets.TraitError``
    with the same text at assignments.
    """

    _esm = _client()

    scene = _CheckedTrait(lambda _, value: scene_of(value)).tag(sync=True, to_json=_to_json)
    """The scene, a :class:`seafoam.Scene`; also takes a preset's name or the fields as JSON has them."""
    camera = _CheckedTrait(lambda water, value: request.camera_of(value, water.scene.camera)).tag(
        sync=True, echo_update=False, to_json=_to_json
    )
    """The camera, a :class:`seafoam.Camera`; also takes the fields that differ from the scene's."""
    quality = _CheckedTrait(lambda _, value: described(quality_of(value)), "standard").tag(sync=True)
    """A tier's name, or the fields that differ from tier standard."""
    time = traitlets.Float(0.0, min=-request.TIME_LIMIT, max=request.TIME_LIMIT).tag(sync=True, echo_update=False)
    """Time of the picture, s. While it plays, the page reports it twice a second."""
    playing = traitlets.Bool(True).tag(sync=True)
    """Whether time runs. Pages of visitors who prefer reduced motion stand still."""
    panel = traitlets.Bool(False).tag(sync=True)
    """Whether the panel with the scene's fields is open."""
    error = traitlets.Unicode("").tag(sync=True)
    """Why the last change was not drawn; empty: it was."""

    def __init__(
        self,
        what: request.SceneLike = "default",
        *,
        time: float | None = None,
        camera: request.CameraLike | None = None,
        quality: request.QualityLike = "standard",
        playing: bool = True,
        panel: bool = False,
    ) -> None:
        job = request.PictureRequest(what, time=time, camera=camera, quality=quality).job()
        shown = {"scene": job.scene, "camera": job.camera, "quality": described(job.quality), "time": job.time}
        super().__init__(**shown, playing=playing, panel=panel)
        self.on_msg(self._answer)
        self.observe(self._follow_camera, "scene")

    def still(self, size: request.Size = (1280, 720)) -> Image:
        """Return the present picture, drawn in Python: an RGB image of ``size`` pixels."""
        return frame(self.scene, time=self.time, camera=self.camera, quality=self.quality, size=size)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Take what the page has changed; what is not allowed is undone there, with the reason in :attr:`error`."""
        try:
            super().set_state(sync_data)
        except traitlets.TraitError as error:
            self.error = str(error)
            self.send_state(list(sync_data))
        else:
            self.error = ""

    def _follow_camera(self, change: Mapping[str, Any]) -> None:
        before, now = change["old"], change["new"]
        if before is None or before is traitlets.Undefined or before.camera != now.camera:
            self.camera = now.camera

    def _answer(self, _: object, content: Any, buffers: object) -> None:
        if not isinstance(content, dict) or "id" not in content:
            return
        try:
            value, parts = answer(content)
        except InvalidRequestError as error:
            self.send({"id": content["id"], "error": str(error)})
            return
        self.send({"id": content["id"], "value": value}, parts)


Answer = tuple[Any, list[bytes]]
"""A JSON value, and binary parts."""


def answer(asked: Mapping[str, Any]) -> Answer:
    """Answer a request of the page: its ``kind``, and the fields of that kind.

    ``plan``: ``scene`` and ``quality`` as JSON; ``texture``: ``url`` as in a plan; ``schema``; ``choices``: ``url`` as
    in the schema. Raises :class:`seafoam.library.request.InvalidRequestError`; other requests than those of the page
    have no answers.
    """
    return _ANSWERS[asked["kind"]](asked)


def _plan(asked: Mapping[str, Any]) -> Answer:
    try:
        plan = make_plan(scene_of(asked["scene"]), quality_of(asked["quality"]))
    except PlanError as error:
        raise InvalidRequestError(f"scene{error.pointer}: {error.message}") from error
    return plan.model_dump(mode="json"), []


def _texture(asked: Mapping[str, Any]) -> Answer:
    return None, [texture(spec_of(asked["url"])).data]


_ANSWERS: dict[str, Callable[[Mapping[str, Any]], Answer]] = {
    "plan": _plan,
    "texture": _texture,
    "schema": lambda _: (schemas(), []),
    "choices": lambda _: ([{"name": name, "title": entry.title} for name, entry in load_catalogue().items()], []),
}
