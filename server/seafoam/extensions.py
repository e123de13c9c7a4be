"""Fields that effects outside the package add to scenes and qualities, and their float64 reference.

An effect declares a model (:class:`seafoam.effects.effect.Extension`). While the effect is registered, scenes and
qualities accept this model under ``extensions`` and its name; the model is validated, hashed and part of the schema.
"""

import json
from collections.abc import Callable
from typing import Any, ClassVar, Self, TypeVar

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler, ValidationInfo, create_model, model_validator
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

M = TypeVar("M", bound=BaseModel)


class Extensions(BaseModel):
    """Parts by name; base class of the extensions of scenes and of qualities."""

    model_config = ConfigDict(extra="allow", frozen=True)

    known: ClassVar[dict[str, type[BaseModel]]] = {}
    """Name -> model; each subclass has its own dictionary."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        cls.known = {}

    @model_validator(mode="before")
    @classmethod
    def _parts(cls, value: Any, info: ValidationInfo) -> Any:
        """Return the parts that are not null. Raises ``ValidationError`` with the field of every error."""
        if not isinstance(value, dict):
            return value
        fields: dict[str, Any] = {name: (model | None, None) for name, model in cls.known.items()}
        whole = create_model(cls.__name__, __config__=ConfigDict(extra="forbid", frozen=True), **fields)
        # JSON is validated as strictly as the API validates the rest; Python callers may pass tuples and models.
        read = whole.model_validate_json(json.dumps(value), strict=True) if info.mode == "json" else None
        found = read or whole.model_validate(value)
        return {name: part for name, part in found if part is not None}

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Return the schema of the parts that are registered now."""
        made = handler(schema)
        members = {
            name: {"anyOf": [handler(model.__pydantic_core_schema__), {"type": "null"}]}
            for name, model in cls.known.items()
        }
        handler.resolve_ref_schema(made).update(properties=members, additionalProperties=False)
        return made

    def given(self, model: type[M]) -> M | None:
        """Return the part of this model, or None if it is absent."""
        return next((part for _, part in self if isinstance(part, model)), None)

    def part(self, name: str) -> BaseModel:
        """Return a part, or its defaults if it is absent. Raises ``KeyError`` for an unknown name."""
        return dict(self).get(name) or self.known[name]()

    def with_defaults(self) -> Self:
        """Return a copy in which no registered part is absent."""
        return type(self).model_validate({name: self.part(name) for name in self.known})


class Extensible(BaseModel):
    """Base class of models with a field ``extensions``, which the schema omits while no part is registered."""

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Return the schema, without ``extensions`` if no part is registered."""
        annotation = cls.model_fields["extensions"].annotation
        assert isinstance(annotation, type)
        assert issubclass(annotation, Extensions)
        if annotation.known or schema["type"] != "model" or schema["schema"]["type"] != "model-fields":
            return handler(schema)
        fields = {name: field for name, field in schema["schema"]["fields"].items() if name != "extensions"}
        return handler({**schema, "schema": {**schema["schema"], "fields": fields}})


TRUTHS: dict[type[BaseModel], Callable[..., Any]] = {}
"""Model of a scene part -> its foam saturation in float64 (:mod:`seafoam.reference.renderer.sources`)."""
