"""Errors that the API raises, what they say of a field, and what a JSON schema allows there.

:mod:`seafoam.api.http.errors` makes answers of them. Nothing here imports the web framework, for commands use it too.
"""

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import Any

from pydantic import Field

from seafoam.described import Described


class FieldProblem(Described):
    """An error in one body member or parameter."""

    pointer: str | None = Field(default=None, description="JSON pointer (RFC 6901) into the request body")
    parameter: str | None = Field(default=None, description="Name of the query or path parameter")
    detail: str = Field(description="Description of the error")
    allowed: dict[str, Any] | None = Field(default=None, examples=[{"minimum": 1, "maximum": 4096}])
    """Allowed values: minimum and maximum (inclusive), enum, members, pattern or type"""


class ApiError(Exception):
    """Base class of errors that routers raise.

    Of any error the answer has ``errors`` of fields, a ``remedy`` and, s, ``retry_after``, where it has them.
    """


class NotFoundError(ApiError):
    """A resource does not exist. ``parameter``: path parameter with the wrong name; ``known``: available names."""

    def __init__(self, detail: str, parameter: str, known: Sequence[str] = ()) -> None:
        super().__init__(detail)
        allowed = {"enum": list(known)} if known else None
        self.errors = [FieldProblem(parameter=parameter, detail=detail, allowed=allowed)]


class BadRequestError(ApiError):
    """Parts of the request are invalid."""

    def __init__(self, *errors: FieldProblem) -> None:
        super().__init__("; ".join(error.detail for error in errors))
        self.errors = list(errors)


class UnsupportedMediaError(ApiError):
    """The body is not JSON."""


class NotBuiltError(ApiError):
    """The web client is not built. ``remedy``: how to build it."""

    remedy = "run: make webclient"


class BusyError(ApiError):
    """The queue for this kind of work is full; retry after ``retry_after`` seconds."""

    def __init__(self, detail: str, retry_after: int) -> None:
        super().__init__(detail)
        self.retry_after = retry_after


class NotMeasuredError(BusyError):
    """A measurement that the response requires is still running; the text gives its progress."""


class StreamsFullError(BusyError):
    """All streams are taken."""


Schema = Mapping[str, Any]

_BOUNDS = ("minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum")
_LENGTHS = ("minLength", "maxLength", "minItems", "maxItems", "pattern")


def allowed_at(schema: Schema, root: Schema, path: Sequence[str | int], value: Any = None) -> dict[str, Any] | None:
    """Return what is allowed at ``path`` of ``schema``: bounds, choices, lengths or member names; None if unrestricted.

    root: document that ``$ref`` points into. value: the whole value that was sent, which selects among alternatives.
    """
    schemas = _descend(schema, root, tuple(path), value)
    return None if schemas is None else _summary(schemas, root)


def describe_allowed(allowed: Mapping[str, Any]) -> str:
    """Describe the result of :func:`allowed_at` in words."""
    if "minimum" in allowed and "maximum" in allowed:
        return f"{allowed['minimum']:g} to {allowed['maximum']:g}"
    said = {key: ", ".join(map(str, value)) if isinstance(value, list) else value for key, value in allowed.items()}
    return "; ".join(f"{key} {value}" for key, value in said.items())


def _alternatives(schema: Schema, root: Schema) -> list[Schema]:
    while "$ref" in schema:
        schema = reduce(lambda target, part: target[part], schema["$ref"].removeprefix("#/").split("/"), root)
    nested = [*schema.get("anyOf", ()), *schema.get("oneOf", ())]
    if not nested:
        return [schema]
    return [leaf for alternative in nested for leaf in _alternatives(alternative, root)]


def _fits(schema: Schema, value: Any) -> bool:
    """Whether the discriminating members of a schema (its constants) match those of the value."""
    if not isinstance(value, Mapping):
        return True
    fixed = {name: part["const"] for name, part in schema.get("properties", {}).items() if "const" in part}
    return all(value.get(name, const) == const for name, const in fixed.items())


def _descend(schema: Schema, root: Schema, path: tuple[str | int, ...], value: Any) -> Schema | None:
    if not path:
        return schema
    step, rest = path[0], path[1:]
    for alternative in _alternatives(schema, root):
        if not _fits(alternative, value):
            continue
        inner: Schema | None = None
        if isinstance(step, int):
            prefix = alternative.get("prefixItems", ())
            inner = prefix[step] if step < len(prefix) else alternative.get("items")
            part = value[step] if isinstance(value, Sequence) and step < len(value) else None
        else:
            inner = alternative.get("properties", {}).get(step)
            part = value.get(step) if isinstance(value, Mapping) else None
        if isinstance(inner, Mapping) and (found := _descend(inner, root, rest, part)) is not None:
            return found
    return None


def _summary(schema: Schema, root: Schema) -> dict[str, Any] | None:
    choices: list[Any] = []
    said: dict[str, Any] = {}
    for alternative in _alternatives(schema, root):
        if alternative.get("type") == "null":
            continue
        if "enum" in alternative or "const" in alternative:
            choices += alternative.get("enum", [alternative.get("const")])
        elif "properties" in alternative:
            said.setdefault("members", sorted(alternative["properties"]))
        else:
            said |= {key: alternative[key] for key in (*_BOUNDS, *_LENGTHS, "type") if key in alternative}
    if choices:
        said = {"enum": choices}
    elif len(said) > 1:
        said.pop("type", None)
    return said or None
