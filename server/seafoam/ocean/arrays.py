"""Types of arrays, and arrays that are kept."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
T = TypeVar("T", bound=np.generic)


def read_only(array: NDArray[T]) -> NDArray[T]:
    """Return an array that nobody may write to from now on: caches give the same one to all."""
    array.setflags(write=False)
    return array
