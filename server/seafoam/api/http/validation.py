"""Requests are read strictly: a parameter is given once, and nothing in a body is converted."""

import json
import re
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from fastapi import Query, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, BeforeValidator, ValidationError

from seafoam.api.http.parameters import Parameters
from seafoam.api.http.problems import BadRequestError, FieldProblem, UnsupportedMediaError

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
