"""Sums of floats that are the same in every Python."""

from collections.abc import Iterable


def summed(values: Iterable[float]) -> float:
    """Return the sum from left to right, each step rounded; of none 0.

    From Python 3.12 on the built-in ``sum`` compensates for rounding: a frame plan would have other digits there.
    """
    result = 0.0
    for value in values:
        result += value
    return result
