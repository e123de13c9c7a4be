"""Requests are read strictly: nothing in a body is converted, and a preset is there."""

import json
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from fastapi import Path, Query
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, BeforeValidator, ValidationError

from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, NotFoundError, UnsupportedMediaError
from seafoam.scene import Preset, load_preset, preset_names

M = TypeVar("M", bound=BaseModel)
NoParameters = Annotated[Parameters, Query()]
"""Query of an operation that has no parameters: any is refused."""


def _strictly(model: type[M]) -> Any:

    def validate(body: Any) -> Any:
        if isinstance(body, bytes):
            raise UnsupportedMediaError("send JSON, with the header Content-Type: application/json")
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
