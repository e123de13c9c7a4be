"""Functions whose keyword arguments are checked by name before anything is done."""

import inspect
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def named(function: Callable[P, R]) -> Callable[P, R]:
    """Return the function, with a ``TypeError`` for a keyword that it does not have that lists those it has.

    Signature, types and documentation are the function's. Python's own error names the keyword alone.
    """
    known = [name for name in inspect.signature(function).parameters if name != "self"]
    called = function.__qualname__.removesuffix(".__init__").rpartition(".")[2]

    @wraps(function)
    def checked(*args: P.args, **options: P.kwargs) -> R:
        for name in options:
            if name not in known:
                raise TypeError(f"{called}() has no keyword {name!r}; it has {', '.join(known)}")
        return function(*args, **options)

    return checked
