"""What ``make test`` runs of large tables of cases, evenly spread; ``make sweep`` runs the rest."""

from collections.abc import Callable, Iterable
from itertools import product
from typing import Any

import pytest

REST = pytest.mark.sweep


def spread(values: Iterable[Any], every: int, name: Callable[[Any], str] = str) -> list[Any]:
    """Parameters of which one in ``every`` runs always, beginning with the first."""
    return [pytest.param(value, id=name(value), marks=() if i % every == 0 else REST) for i, value in enumerate(values)]


def crossed(rows: Iterable[Any], columns: Iterable[Any], every: int, name: Callable[[Any], str] = str) -> list[Any]:
    """Pairs of parameters of which one in ``every`` runs always, along diagonals.

    Every column runs where there are as many rows, and every row where ``every`` is at most the number of columns.
    """
    return [
        pytest.param(row, column, id=f"{name(row)}-{name(column)}", marks=() if (i + j) % every == 0 else REST)
        for (i, row), (j, column) in product(enumerate(rows), enumerate(columns))
    ]


def rested(parameters: Iterable[Any], every: int) -> list[Any]:
    """The same of parameters that have identifiers already."""
    return [
        one if i % every == 0 else pytest.param(*one.values, id=one.id, marks=(*one.marks, REST))
        for i, one in enumerate(parameters)
    ]
