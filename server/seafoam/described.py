"""Base of models whose fields are described below them."""

import ast
import inspect
import sys
from functools import cache
from itertools import pairwise
from typing import Annotated, Any

from pydantic import BaseModel, Field


@cache
def _texts_below(module: str) -> dict[str, dict[str, str]]:
    """By name of a module's class and of its field, the text below the field, on one line; none without the source."""
    try:
        classes = [
            one for one in ast.parse(inspect.getsource(sys.modules[module])).body if isinstance(one, ast.ClassDef)
        ]
    except (KeyError, OSError, TypeError):
        return {}
    return {
        one.name: {
            field.target.id: " ".join(str(text).split())
            for field, below in pairwise(one.body)
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
            if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant) and (text := below.value.value)
        }
        for one in classes
    }


class Described(BaseModel):
    """Base class of models whose fields have their description below them, or in their ``Field`` where it is short.

    Pydantic's own ``use_attribute_docstrings`` reads the source once for each class, which costs ten times as much.
    """

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        for name, text in _texts_below(cls.__module__).get(cls.__name__, {}).items():
            cls.__annotations__[name] = Annotated[cls.__annotations__[name], Field(description=text)]
