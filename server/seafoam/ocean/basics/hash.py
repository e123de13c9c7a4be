"""Pseudo-random numbers that are the same on every machine: a hash of integers."""

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.arrays import Floats

_Words = NDArray[np.uint64]
_LOW = np.uint64(0xFFFFFFFF)


def chance(*words: int | NDArray[np.integer]) -> Floats:
    """Return a number in (0, 1) for integers taken modulo 2³², in the shape to which they broadcast.

    The integers are chained through PCG-RXS-M-XS 32 (O'Neill 2014): pcg(… pcg(pcg(first) ⊕ second) … ⊕ last).
    """
    word: _Words = np.zeros((1,), np.uint64)
    for part in words:
        word = _pcg(word ^ (np.asarray(part, np.int64).astype(np.uint64) & _LOW))
    shape = np.broadcast_shapes(*(np.shape(part) for part in words))
    return (word.astype(np.float64).reshape(shape) + 0.5) / 2.0**32


def _pcg(word: _Words) -> _Words:
    state = (word * np.uint64(747796405) + np.uint64(2891336453)) & _LOW
    mixed = (((state >> ((state >> np.uint64(28)) + np.uint64(4))) ^ state) * np.uint64(277803737)) & _LOW
    result: _Words = (mixed >> np.uint64(22)) ^ mixed
    return result
