"""Numbers as text, in requests, settings and commands: one way to write them, so that no slip is taken for a number."""

import re
from typing import TYPE_CHECKING, Any, get_args

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationInfo

_NUMERAL = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def numeral(text: Any) -> Any:
    """Return what is no text as it is, and a text that is a number: no spaces, underscores, ``nan`` or other digits.

    Raises ``ValueError`` for another text.
    """
    if isinstance(text, str) and not _NUMERAL.fullmatch(text):
        raise ValueError("must be a number such as 12, -0.5 or 1e3")
    return text


def numeral_fields(cls: "type[BaseModel]", value: Any, info: "ValidationInfo") -> Any:
    """Before validator of all fields of a model: those that are numbers take :func:`numeral` only."""
    annotation = cls.model_fields[str(info.field_name)].annotation
    kinds = [each for each in get_args(annotation) or (annotation,) if isinstance(each, type)]
    numbers = any(issubclass(each, int | float) and each is not bool for each in kinds)
    return numeral(value) if numbers else value
