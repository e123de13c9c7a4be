"""Requests are read strictly: a parameter is given once, nothing in a body is converted, and a preset is there."""

import json
import re
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from fastapi import Path, Query, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, BeforeValidator, ValidationError

from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError, UnsupportedMediaError
from seafoam.scene import Preset, load_preset, preset_names

M = TypeVar("M", bound=BaseModel)
NoParameters = Annotated[Parameters, Query()]
"""Query of an operation that has no parameters: any is refused."""
_SURROGATE = re.compile("[\ud800-\udfff]")


def one_value_each(request: Request) -> None:
    """Reject a query parameter that is given twice, since either value could be meant."""
    names = [name for name, _ in request.query_params.multi_items()]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        errors = (FieldProblem(parameter=name, detail=f"{name} is given more than once") for name in twice)
        raise BadRequestError(*errors)


def _strictly(model: type[M]) -> Any:

    def validate(body: Any) -> Any:
        if isinstance(body, bytes):
            raise UnsupportedMediaError("send JSON, with the header Content-Type: application/json")
        if (path := _no_text(body)) is not None:
            message = "must be Unicode text, without half of a surrogate pair"
            raise RequestValidationError(
                [{"type": "string_unicode", "loc": ("body", *path), "msg": message}], body=body
            )
        try:
            return model.model_validate_json(json.dumps(body), strict=True)
        except ValidationError as error:
            items = [{**item, "loc": ("body", *item["loc"])} for item in error.errors()]
            raise RequestValidationError(items, body=body) from error

    return Annotated[model, BeforeValidator(validate)]


if TYPE_CHECKING:
    Strict = Annotated[M, _strictly]
else:

    class Strict:
        """A JSON body, read without pydantic's conversions: neither the string "1" nor true is a number."""

        __class_getitem__ = staticmethod(_strictly)


def _no_text(body: Any) -> tuple[str | int, ...] | None:
    """Return the path to a string or key that has no UTF-8, which JSON's escapes can spell, or None."""
    waiting: list[tuple[tuple[str | int, ...], Any]] = [((), body)]
    while waiting:
        path, value = waiting.pop()
        match value:
            case str() if _SURROGATE.search(value):
                return path
            case dict():
                waiting += [((*path, key), part) for key, inner in value.items() for part in (inner, key)]
            case list():
                waiting += [((*path, index), inner) for index, inner in enumerate(value)]
    return None


PresetName = Annotated[
    str, Path(description="Name of a preset; /api/presets lists them", examples=["default"], max_length=80)
]


def find_preset(name: str) -> Preset:
    """Return a preset by name. Raises :class:`NotFoundError` with the available names."""
    try:
        return load_preset(name)
    except KeyError:
        raise NotFoundError(f"preset {name!r} was not found", "preset", preset_names()) from None


def known_preset(name: str | None) -> None:
    """Check the name in a body's member ``preset``. Raises :class:`BadRequestError` with the available names."""
    if name is not None and name not in preset_names():
        allowed = {"enum": list(preset_names())}
        raise BadRequestError(
            FieldProblem(pointer="/preset", detail=f"/preset: preset {name!r} was not found", allowed=allowed)
        )
