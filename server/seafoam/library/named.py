"""Functions whose keyword arguments are checked by name before anything is done."""

import inspect
from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar, cast

P = ParamSpec("P")
Q = TypeVar("Q")
R = TypeVar("R")
S = TypeVar("S")


def named(function: Callable[P, R], called: str = "") -> Callable[P, R]:
    """Return the function, with a ``TypeError`` for a keyword that it does not have that lists those it has.

    Signature, types and documentation are the function's. Python's own error names the keyword alone. ``called``: the
    name that users call it by, if it is another than its own.
    """
    known = [name for name in inspect.signature(function).parameters if name != "self"]
    called = called or function.__qualname__.removesuffix(".__init__").rpartition(".")[2]

    @wraps(function)
    def checked(*args: P.args, **options: P.kwargs) -> R:
        for name in options:
            if name not in known:
                raise TypeError(f"{called}() has no keyword {name!r}; it has {', '.join(known)}")
        return function(*args, **options)

    return checked


def asking(request: Callable[P, Q]) -> Callable[[Callable[[S, Q], R]], Callable[Concatenate[S, P], R]]:
    """Make of a method that takes a request one with the parameters of the function that makes it, checked by name.

    Editors and ``help()`` show these parameters, which are written once.
    """

    def decorate(method: Callable[[S, Q], R]) -> Callable[Concatenate[S, P], R]:
        own = inspect.signature(method)
        parameters = [own.parameters["self"], *inspect.signature(request).parameters.values()]
        shown = own.replace(parameters=parameters)

        @wraps(method)
        def asked(self: S, /, *args: P.args, **options: P.kwargs) -> R:
            shown.bind(self, *args, **options)  # else the error would name the request's function
            return method(self, request(*args, **options))

        cast(Any, asked).__signature__ = shown
        return named(asked)

    return decorate
