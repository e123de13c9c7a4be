"""Base of every part of a scene, and types of its numbers."""

from typing import Annotated, Any, Literal, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field
from pydantic.fields import FieldInfo

Finite = Annotated[float, Field(allow_inf_nan=False)]

Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]

Rgb = tuple[Share, Share, Share]

Place = Annotated[float, Field(ge=-1e7, le=1e7)]
"""A horizontal coordinate, m."""

Angle = Annotated[float, Field(ge=-6.2832, le=6.2832, json_schema_extra={"unit": "rad"})]
"""An angle of up to a turn either way, rad."""

Elevation = Annotated[float, Field(ge=-1.5708, le=1.5708, json_schema_extra={"unit": "rad"})]
"""An angle over the horizon, rad."""


class Part(BaseModel):
    """Base class of every part of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


def non_defaults(part: BaseModel) -> dict[str, Any]:
    """Return the fields of a part that differ from their defaults, as JSON values, recursively.

    Discriminators of unions are always included. Equal results mean equal parts, and a new field with a default does
    not change the result of parts that do not use it.
    """
    found: dict[str, Any] = {}
    for name, value in part:
        field = type(part).model_fields.get(name)
        if field is None or _tells_apart(field) or value != field.get_default(call_default_factory=True):
            found[name] = _non_defaults(value)
    return found


def _non_defaults(value: Any) -> Any:
    if isinstance(value, BaseModel):
        return non_defaults(value)
    return [_non_defaults(one) for one in value] if isinstance(value, tuple) else value


def _tells_apart(field: FieldInfo) -> bool:
    return get_origin(field.annotation) is Literal and len(get_args(field.annotation)) == 1
