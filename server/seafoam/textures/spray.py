"""Start positions of spray on a shore's rocks. docs/formulae.md, section 13."""

import math

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.rocks import rocks
from seafoam.scene.shore import Shore


def spray_rocks_name(shore: Shore, steep: float) -> str:
    """Name in the texture store of the points on a shore's rocks."""
    return f"spray-rocks/{steep!r}/{shore.ground}"


def spray_rocks(steep: str, ground: str) -> NDArray[np.float32]:
    """(1, ROCKS, 4) float32, see :func:`seafoam.ocean.rocks.rocks`. Raises ``ValueError`` if there are none."""
    least = float(steep)
    if not (math.isfinite(least) and 0.0 <= least <= 2.0):
        raise ValueError(steep)
    points = rocks(ground, least)
    if len(points) == 0:
        raise ValueError(ground)
    return points.astype(np.float32)[None]
