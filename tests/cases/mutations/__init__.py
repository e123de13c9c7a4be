"""Mutations that take the guards of hard cases out, by the cases' names, in modules by subject."""

import importlib
import pkgutil

from support.hard.mutations import Mutation

MUTATIONS: dict[str, tuple[Mutation, ...]] = {}
UNSEEN: dict[str, str] = {}
"""Cases whose guards neither a picture nor a function's value shows here, and why."""

for _found in pkgutil.iter_modules(__path__):
    _module = importlib.import_module(f"{__name__}.{_found.name}")
    MUTATIONS |= _module.MUTATIONS
    UNSEEN |= _module.UNSEEN
