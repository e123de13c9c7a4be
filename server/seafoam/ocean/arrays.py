"""Types of arrays, arrays that are kept, and the smoothstep."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
T = TypeVar("T", bound=np.generic)


def read_only(array: NDArray[T]) -> NDArray[T]:
    """Return an array that nobody may write to from now on: caches give the same one to all."""
    array.setflags(write=False)
    return array


def smoothstep(low: float, high: float, x: Floats) -> Floats:
    """3q² − 2q³ of q = (x − low)/(high − low) clamped to [0, 1]; low < high; of the shape of ``x``."""
    q = np.clip((x - low) / (high - low), 0.0, 1.0)
    return q * q * (3.0 - 2.0 * q)


def smooth(low: float, high: float, x: float) -> float:
    """Return :func:`smoothstep` of a number."""
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)
