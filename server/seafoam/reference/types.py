"""Array types of the reference, and the smoothstep that every section uses."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Ranks = NDArray[np.uint32] | NDArray[np.int64]


def smoothstep(low: float, high: float, x: ArrayLike) -> Floats:
    """3q² − 2q³ of q = (x − low)/(high − low) clamped to [0, 1]; low < high; of the shape of ``x``."""
    q = np.clip((np.asarray(x, np.float64) - low) / (high - low), 0.0, 1.0)
    result: Floats = q * q * (3.0 - 2.0 * q)
    return result


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar product along the last axis; shapes broadcast."""
    product: Any = np.einsum("...i,...i->...", *np.broadcast_arrays(a, b))
    return np.asarray(product, np.float64)


def unit(a: Floats) -> Floats:
    """Vectors along the last axis scaled to length 1; a zero vector stays zero."""
    length = np.sqrt(dot(a, a))[..., None]
    result: Floats = a / np.where(length > 0.0, length, 1.0)
    return result
