"""Base of every part of a scene, types of its numbers, and how they follow its wind."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

from pydantic import BaseModel, Field, GetJsonSchemaHandler
from pydantic.fields import FieldInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from seafoam.described import Described

Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Rgb = tuple[Share, Share, Share]
Place = Annotated[float, Field(ge=-1e7, le=1e7)]
"""A horizontal coordinate, m."""
Radians = Annotated[float, Field(json_schema_extra={"unit": "rad"})]
Angle = Annotated[Radians, Field(ge=-6.2832, le=6.2832)]
"""An angle of up to a turn either way, rad."""
Elevation = Annotated[Radians, Field(ge=-1.5708, le=1.5708)]
"""An angle over the horizon, rad."""


@dataclass(frozen=True)
class Follows:
    """How a field that is null follows the scene's wind: factor · (quantity - calm), held in the field's range."""

    quantity: Literal["speed", "direction"]
    alone: float
    """Its value in a scene without a wind."""
    factor: float = 1.0
    calm: float = 0.0

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Return the field's schema with the law, which the panel starts a value of the field's own from."""
        law = {"factor": self.factor, "calm": self.calm, "alone": self.alone}
        return {**handler(schema), "follows": {"field": f"/wind/{self.quantity}", **law}}


@dataclass(frozen=True)
class InEffect:
    """Reads a field that follows the wind: its value, or while it is null the one without a wind."""

    name: str

    def __get__(self, part: BaseModel, kind: type[BaseModel]) -> float:
        """Return the number in effect in a part that has been :func:`settled`, or stands alone."""
        value: float | None = getattr(part, self.name)
        return _laws(kind)[self.name].alone if value is None else value


Downwind = Annotated[
    Angle | None,
    Follows("direction", alone=0.0),
    Field(description="Direction toward which the wind blows, rad from +x toward +z; null: as the scene's wind"),
]


class Part(Described, extra="forbid", frozen=True, allow_inf_nan=False):
    """Base class of every part of a scene: immutable, no unknown keys, no NaN or infinity."""


M = TypeVar("M", bound=BaseModel)


def settled(part: M, wind: Mapping[str, float]) -> M:
    """Return a part in which fields that follow the wind have what comes of it; null where this is so without a wind.

    ``wind``: speed, m/s, and direction, rad; empty without one. So parts that mean the same are equal.
    """
    laws, found = _laws(type(part)), dict[str, Any]()
    for name, value in part:
        if isinstance(value, BaseModel):
            found[name] = settled(value, wind)
        elif law := laws.get(name):
            found[name] = _followed(law, type(part).model_fields[name], wind) if wind and value is None else value
            found[name] = None if found[name] == law.alone else found[name]
    changed = {name: value for name, value in found.items() if value != getattr(part, name)}
    return part.model_copy(update=changed) if changed else part


def _followed(law: Follows, field: FieldInfo, wind: Mapping[str, float]) -> float:
    value = law.factor * (wind[law.quantity] - law.calm)
    for limit in field.metadata:
        value = min(max(value, getattr(limit, "ge", -math.inf)), getattr(limit, "le", math.inf))
    return value


@cache
def _laws(kind: type[BaseModel]) -> dict[str, Follows]:
    """By name of a field that follows the wind, how."""
    laws = ((name, one) for name, field in kind.model_fields.items() for one in field.metadata)
    return {name: law for name, law in laws if isinstance(law, Follows)}


def non_defaults(part: BaseModel) -> dict[str, Any]:
    """Return the fields of a part that differ from their defaults, as JSON values, recursively.

    Discriminators of unions are always included. Equal results mean equal parts, and a new field with a default does
    not change the result of parts that do not use it.
    """
    found: dict[str, Any] = {}
    for name, value in part:
        field = type(part).model_fields.get(name)
        tells_apart = field and get_origin(field.annotation) is Literal and len(get_args(field.annotation)) == 1
        if field is None or tells_apart or value != field.get_default(call_default_factory=True):
            found[name] = _non_defaults(value)
    return found


def _non_defaults(value: Any) -> Any:
    if isinstance(value, BaseModel):
        return non_defaults(value)
    return [_non_defaults(one) for one in value] if isinstance(value, tuple) else value
