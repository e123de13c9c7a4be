"""Patterns, tileable and deterministic: bubbles of several sizes with bright walls, and strands of thrown water."""

from functools import lru_cache
from itertools import product
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.torus import rank
from seafoam.ocean.arrays import read_only
from seafoam.textures.spec import Image, TextureSpec, halved

SIZE, STRANDS = 256, 128
"""Texels along a side of the bubbles and of the strands."""
_LAYERS = ((17, 0.55, 11), (41, 0.45, 12))
"""Cells along a side, weight and seed of each layer of bubbles."""
_STEPS = 1024
"""Values are whole multiples of 1/1024, which half floats hold exactly."""


class FoamTexture(TextureSpec):
    """The foam texture, R8 or R32F, all levels: means of 2 × 2 texels."""

    kind: ClassVar[str] = "foam"
    format: Literal["R8", "R32F"] = "R8"

    def image(self) -> Image:
        levels = [foam_texture()]
        while len(levels[-1]) > 1:
            levels.append(halved(levels[-1]))
        if self.format == "R32F":
            return Image("R32F", tuple(level.astype("<f4") for level in levels))
        return Image("R8", tuple(np.round(255.0 * level).astype(np.uint8) for level in levels))


@lru_cache(maxsize=1)
def foam_texture() -> NDArray[np.float64]:
    """(256, 256) float64 in [0, 1], row v, column u, toroidal.

    Each layer is a Voronoi froth (Worley 1996): F2 − F1 is small on the walls between bubbles. Only sums, products,
    quotients and square roots are used, so every machine makes the same texture.
    """
    total = np.zeros((SIZE, SIZE))
    for cells, weight, seed in _LAYERS:
        random = np.random.Generator(np.random.PCG64(seed))
        grid = np.stack(np.meshgrid(np.arange(cells), np.arange(cells), indexing="xy"), axis=-1)
        jitter = 0.9 * (random.random((cells * cells, 2)).reshape(grid.shape) - 0.5)
        first, second = (distance * cells for distance in _nearest_two(((grid + 0.5 + jitter) / cells) % 1.0))
        wall = 1.0 - np.minimum((second - first) / 0.38, 1.0)
        dome = np.maximum(1.0 - 1.7 * first * first, 0.0)
        layer = 0.34 + 0.66 * wall * wall * (3.0 - 2.0 * wall) + 0.16 * dome
        total += weight * layer
    total = np.clip(total / 0.95, 0.0, 1.0)
    return read_only(np.round(total * _STEPS) / _STEPS)


def _nearest_two(sites: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distances from each texel's middle to the nearest site and to the next, on the unit torus; (256, 256) each.

    sites: (cells, cells, 2), x and y, by row and column of the cell that each lies in. The site of the texel's own cell
    and the nearest of its neighbours' are within 1.8 cells, so none that is more than two cells away counts.
    """
    cells = len(sites)
    centres = (np.arange(SIZE) + 0.5) / SIZE
    place = (centres * cells).astype(np.intp)
    first, second = np.full((SIZE, SIZE), np.inf), np.full((SIZE, SIZE), np.inf)
    for down, right in product(range(-2, 3), repeat=2):
        near = np.ix_((place + down) % cells, (place + right) % cells)
        x, y = centres[None, :] - sites[..., 0][near], centres[:, None] - sites[..., 1][near]
        x -= np.rint(x)
        y -= np.rint(y)
        square = x * x + y * y
        np.minimum(second, np.maximum(first, square), out=second)
        np.minimum(first, square, out=first)
    return np.sqrt(first), np.sqrt(second)


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
    return np.floor(rank(total) / total.size * _STEPS) / _STEPS


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
