"""Shapes of the foam on a mask at a saturation: components, holes, chords and the Euler number, on the torus.

Foam is 8-connected, water 4-connected, so that a diagonal step belongs to exactly one of them.
"""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from seafoam.masks.torus import Ranks

SATURATIONS: tuple[float, ...] = (0.15, 0.3, 0.5, 0.7, 0.9)
HOLE_SHARES: tuple[float, ...] = (0.1, 0.5, 0.9)
"""Fractions of the water's area in holes up to the given diameters."""
JOIN_STEP = 0.025
"""Saturations at which :attr:`MaskMorphology.joined_from` is evaluated, 0.025 apart."""
_DIGITS = 4
Pattern = NDArray[np.bool_]


class FoamShapes(BaseModel, frozen=True):
    """Shapes of the foam at one saturation; lengths in texels."""

    saturation: float
    largest_piece: float
    """Fraction of the foam in its largest connected component, 0..1."""
    euler_number: int
    """Number of components minus number of holes."""
    hole_diameters: tuple[float, ...]
    """Equivalent diameters of the holes below which :data:`HOLE_SHARES` of the water's area lie."""
    foam_chord: float
    water_chord: float
    """Mean length of the runs of foam and of water along rows and columns."""


class MaskMorphology(BaseModel, frozen=True):
    """Shapes of a mask's foam at :data:`SATURATIONS`."""

    unit: Literal["texels"] = "texels"
    hole_shares: tuple[float, ...] = HOLE_SHARES
    joined_from: float
    """Lowest saturation, in steps of :data:`JOIN_STEP`, at which one component contains more than half of the foam."""
    saturations: tuple[FoamShapes, ...]


def measure_morphology(ranks: Ranks) -> MaskMorphology:
    """Measure the patterns ``rank < s N``; about 0.3 s at 512 x 512. ranks: (rows, columns)."""
    steps = (JOIN_STEP * step for step in range(1, round(1.0 / JOIN_STEP)))
    joined = next((s for s in steps if largest_piece(ranks < s * ranks.size) > 0.5), 1.0)
    shapes = tuple(_shapes(ranks, saturation) for saturation in SATURATIONS)
    return MaskMorphology(joined_from=round(joined, 3), saturations=shapes)


def largest_piece(foam: Pattern) -> float:
    """Return the fraction of the foam in its largest 8-connected component; 0 without foam. foam: (rows, columns)."""
    total = int(foam.sum())
    return float(_areas(foam, diagonal=True).max(initial=0)) / total if total else 0.0


def euler_number(foam: Pattern) -> int:
    """Components minus holes of 8-connected foam on the torus: corners - edges + texels. foam: (rows, columns)."""
    beside = foam | np.roll(foam, 1, axis=1)
    below = foam | np.roll(foam, 1, axis=0)
    corners = beside | np.roll(beside, 1, axis=0)
    return int(corners.sum()) - int(beside.sum()) - int(below.sum()) + int(foam.sum())


def hole_areas(ranks: Ranks, saturation: float) -> NDArray[np.int64]:
    """Areas of the holes in the foam at a saturation, (holes,), texels, the smallest first; empty without water.

    ranks: (rows, columns); saturation in [0, 1]. Holes are 4-connected, on the torus.
    """
    return np.sort(_areas(ranks >= saturation * ranks.size, diagonal=False))


def _shapes(ranks: Ranks, saturation: float) -> FoamShapes:
    foam = ranks < saturation * ranks.size
    holes = hole_areas(ranks, saturation)
    cumulative = np.cumsum(holes)
    sizes = holes[[int(np.searchsorted(cumulative, share * cumulative[-1])) for share in HOLE_SHARES]]
    # Each run begins where foam begins: as many along rows as along columns count twice.
    runs = sum(int((foam & ~np.roll(foam, 1, axis=axis)).sum()) for axis in (0, 1))
    area = int(foam.sum())
    return FoamShapes(
        saturation=saturation,
        largest_piece=_rounded(largest_piece(foam)),
        euler_number=euler_number(foam),
        hole_diameters=tuple(_rounded(float(np.sqrt(4.0 * size / np.pi))) for size in sizes),
        foam_chord=_rounded(2.0 * area / runs),
        water_chord=_rounded(2.0 * (foam.size - area) / runs),
    )


def _areas(pattern: Pattern, *, diagonal: bool) -> NDArray[np.int64]:
    """Return the number of texels of each connected component on the torus; (components,)."""
    # Here, because only new masks need it: shipped ones are measured.
    from scipy.ndimage import label
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    labels, count = label(pattern, np.ones((3, 3)) if diagonal else None)
    if count == 0:
        return np.zeros(0, np.int64)
    pairs: list[NDArray[np.int64]] = []
    for first, last in ((labels[0], labels[-1]), (labels[:, 0], labels[:, -1])):
        for shift in (-1, 0, 1) if diagonal else (0,):
            touching = np.stack((last, np.roll(first, shift)))
            pairs.append(touching[:, (touching > 0).all(axis=0)] - 1)
    seam = np.concatenate(pairs, axis=1)
    graph = coo_array((np.ones(seam.shape[1], np.int8), (seam[0], seam[1])), shape=(count, count))
    _, piece = connected_components(graph, directed=False)
    return np.bincount(piece[labels[pattern] - 1])


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
