"""Start positions of spray on a shore's rocks, and the strands of thrown water. docs/formulae.md, section 13."""

from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from seafoam.ocean.coast.rocks import rocks
from seafoam.textures.shore import Ground
from seafoam.textures.spec import Image, TextureSpec, halved

STRANDS = 128
"""Texels along a side of the strands' texture."""
_STEPS = 1024
"""Values are whole multiples of 1/1024, which half floats hold exactly."""


class SprayRocks(TextureSpec):
    """Places on a shore's rocks, RGBA32F (1, ROCKS), see :func:`seafoam.ocean.coast.rocks.rocks`."""

    kind: ClassVar[str] = "spray-rocks"
    shore: Ground
    steep: float = Field(ge=0.0, le=2.0)

    def image(self) -> Image:
        """Return the places as a row. Raises ``ValueError`` where there are none."""
        places = rocks(self.shore, self.steep)
        if len(places) == 0:
            raise ValueError("shore: has no rocks as steep as that")
        return Image("RGBA32F", (places.astype("<f4")[None],))


class SprayStrands(TextureSpec):
    """The strands, R16F, all levels: means of 2 × 2 texels."""

    kind: ClassVar[str] = "spray-strands"

    def image(self) -> Image:
        return Image("R16F", tuple(level.astype("<f2") for level in strand_levels()))


@lru_cache(maxsize=1)
def strand_levels() -> tuple[NDArray[np.float64], ...]:
    """Return the strands and their means over 2 × 2 texels and so on, rounded to half floats."""
    levels = [spray_strands()]
    while len(levels[-1]) > 1:
        levels.append(halved(levels[-1]).astype(np.float16).astype(np.float64))
    return tuple(levels)


def spray_strands() -> NDArray[np.float64]:
    """(128, 128) float64 in [0, 1): ranks of a field that is low on strands along u, lowest at beads on them; toroidal.

    Ridges of noise that is long along u, with noise of beads added; ranks, so that the share below s is s. Only sums,
    products and comparisons are used, so every machine makes the same texture.
    """
    along = np.arange(STRANDS) / STRANDS
    u, v = np.meshgrid(along, along, indexing="xy")
    bent = v + 0.05 * (_noise(u, v, 3, 3, 1) - 0.5)
    total = np.zeros_like(u)
    for columns, rows, weight, seed in ((3, 9, 0.5, 2), (6, 21, 0.3, 3)):
        total += weight * np.abs(2.0 * _noise(u, bent, columns, rows, seed) - 1.0)
    total += 0.22 * _noise(u, bent, 14, 18, 4) + 0.16 * _noise(u, bent, 29, 37, 5) + 0.25 * _noise(u, v, 2, 3, 6)
    order = np.argsort(total, axis=None, kind="stable")
    ranks = np.empty(order.size)
    ranks[order] = np.arange(order.size) / order.size
    return np.floor(ranks.reshape(total.shape) * _STEPS) / _STEPS


def _noise(u: NDArray[np.float64], v: NDArray[np.float64], columns: int, rows: int, seed: int) -> NDArray[np.float64]:
    """Value noise in [0, 1] of columns × rows cells, toroidal, smooth between them."""
    values = np.random.Generator(np.random.PCG64(seed)).random((rows, columns))
    x, y = u * columns, v * rows
    i, j = np.floor(x), np.floor(y)
    s, t = x - i, y - j
    s, t = s * s * (3.0 - 2.0 * s), t * t * (3.0 - 2.0 * t)
    i0, j0 = i.astype(np.intp) % columns, j.astype(np.intp) % rows
    i1, j1 = (i0 + 1) % columns, (j0 + 1) % rows
    low = values[j0, i0] + (values[j0, i1] - values[j0, i0]) * s
    high = values[j1, i0] + (values[j1, i1] - values[j1, i0]) * s
    return low + (high - low) * t
