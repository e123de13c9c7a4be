"""What the widget's page asks of Python: plans, textures, the scene's schema, lists of names.

All of it travels over the notebook's own connection, so a notebook on another machine needs no server and no open port.
"""

from collections.abc import Callable, Mapping
from typing import Any

from pydantic.json_schema import models_json_schema

from seafoam.library.errors import InvalidRequestError
from seafoam.library.request import quality_of, scene_of
from seafoam.masks.catalogue import load_catalogue
from seafoam.planner import PlanError, make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene.models import Scene
from seafoam.textures.spec import UnknownTextureError
from seafoam.textures.store import spec_of, texture

Answer = tuple[Any, list[bytes]]
"""A JSON value, and binary parts."""


def answer(asked: Mapping[str, Any]) -> Answer:
    """Answer a request of the page: its ``kind``, and the fields of that kind.

    ``plan``: ``scene`` and ``quality`` as JSON; ``texture``: ``url`` as in a plan; ``schema``; ``choices``: ``url`` as
    in the schema. Raises :class:`seafoam.library.errors.InvalidRequestError`.
    """
    kind = asked.get("kind")
    if kind not in _ANSWERS:
        raise InvalidRequestError(f"kind: must be one of {', '.join(_ANSWERS)}, not {kind!r}")
    try:
        return _ANSWERS[kind](asked)
    except KeyError as error:
        raise InvalidRequestError(f"{kind}: {error.args[0]!r} is missing") from error


def schema() -> dict[str, Any]:
    """Return the JSON schemas of scene and quality as ``GET /api/schema`` does."""
    _, document = models_json_schema(
        [(Scene, "validation"), (Quality, "validation")], ref_template="#/components/schemas/{model}"
    )
    return {"tiers": list(TIERS), "components": {"schemas": document["$defs"]}}


def _plan(asked: Mapping[str, Any]) -> Answer:
    try:
        plan = make_plan(scene_of(asked["scene"]), quality_of(asked["quality"]))
    except PlanError as error:
        raise InvalidRequestError(f"scene{error.pointer}: {error.message}") from error
    return plan.model_dump(mode="json"), []


def _texture(asked: Mapping[str, Any]) -> Answer:
    try:
        return None, [texture(spec_of(asked["url"])).data]
    except UnknownTextureError as error:
        raise InvalidRequestError(f"url: there is no texture {asked['url']!r:.200}") from error


def _choices(asked: Mapping[str, Any]) -> Answer:
    if asked["url"] != "/api/masks":
        raise InvalidRequestError(f"url: there is no list {asked['url']!r:.200}")
    return [{"name": name, "title": entry.title} for name, entry in load_catalogue().items()], []


_ANSWERS: dict[str, Callable[[Mapping[str, Any]], Answer]] = {
    "plan": _plan,
    "texture": _texture,
    "schema": lambda _: (schema(), []),
    "choices": _choices,
}
