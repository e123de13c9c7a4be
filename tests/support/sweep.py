"""What ``make test`` runs of large tables of cases, evenly spread; ``make sweep`` runs the rest."""

from collections import defaultdict
from collections.abc import Callable, Iterable
from itertools import product
from pathlib import Path
from typing import Any

import pytest

REST = pytest.mark.sweep


def spread(values: Iterable[Any], every: int, first: int = 0, name: Callable[[Any], str] = str) -> list[Any]:
    """Parameters of which one in ``every`` runs always, beginning with ``first``."""
    return [
        pytest.param(value, id=name(value), marks=() if i % every == first else REST) for i, value in enumerate(values)
    ]


def crossed(
    rows: Iterable[Any],
    columns: Iterable[Any],
    every: int,
    one_row_in: int = 1,
    first: int = 0,
    name: Callable[[Any], str] = str,
) -> list[Any]:
    """Pairs of parameters of which one in ``every * one_row_in`` runs always: of some rows, along diagonals.

    Rows run of which one in ``one_row_in``, beginning with ``first``, so that tables of the same rows can have others;
    each of them if ``every`` is at most the number of columns. Every column runs where there are rows enough.
    """
    return [
        pytest.param(
            row,
            column,
            id=f"{name(row)}-{name(column)}",
            marks=() if i % one_row_in == first and (i // one_row_in + j) % every == 0 else REST,
        )
        for (i, row), (j, column) in product(enumerate(rows), enumerate(columns))
    ]


def rested(parameters: Iterable[Any], every: int) -> list[Any]:
    """The same of parameters that have identifiers already."""
    return [
        one if i % every == 0 else pytest.param(*one.values, id=one.id, marks=(*one.marks, REST))
        for i, one in enumerate(parameters)
    ]


def leave_to_sweep(items: Iterable[pytest.Item], most: int) -> None:
    """Mark all but ``most`` cases of each test function, evenly spread, as the sweep's.

    Not where the function says itself what is left to the sweep, or is marked whole.
    """
    tables: dict[tuple[Path, str], list[pytest.Item]] = defaultdict(list)
    for item in items:
        if isinstance(item, pytest.Function):
            tables[item.path, item.originalname].append(item)
    for cases in tables.values():
        marked = any(case.get_closest_marker(name) for case in cases for name in (REST.name, "whole"))
        if marked or len(cases) <= most:
            continue
        kept = {i * len(cases) // most for i in range(most)}
        for i, case in enumerate(cases):
            if i not in kept:
                case.add_marker(REST)
