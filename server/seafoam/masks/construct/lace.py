"""Masks whose foam consists of cell walls: ``lace``.

The cells of two polydisperse power diagrams, one coarse and one fine, are filled from their centres: as saturation
falls, the insides of cells open first and their walls last, so holes grow and merge. Walls of the fine diagram
open before those of the coarse one, and noise breaks walls into threads.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.torus import Field, Progress, Ranks, Shape, filter_noise, gaussian_response, rank

COARSE: tuple[float, ...] = (4.0, 2.0, 1.0)
FINE: tuple[float, ...] = (1.4, 0.8, 0.5)
"""Spacings of the grids that sites come from, in sigma. Three of them make large and small cells in one diagram."""
COARSE_CHANCE: tuple[float, ...] = (0.7, 0.4, 0.25)
FINE_CHANCE: tuple[float, ...] = (0.4, 0.5, 0.5)
"""How often a cell of a grid has a site, by grid."""
RADIUS_LEAST, RADIUS_RANGE = 0.35, 0.3
"""Radius of a site in spacings of its grid: least, and what an even random number adds."""
NEIGHBOURS = 4
"""Nearest sites that count at a place: its own and those of the three nearest walls."""
BORDER = 0.05
"""Width, in the finest spacing, over which walls melt together where they meet, as those of real foam do (Plateau)."""
UNION = 0.06
"""Width, in depths of a cell, over which fine walls run into coarse ones."""
FINE_WEIGHT = 0.9
WARP = 0.7
"""Root mean square shift of places, in sigma, by noise of 1.2 sigma: walls bend."""
WARP_WIDTH = 1.2
ROUGH_BANDS: tuple[tuple[float, float, float], ...] = ((5.0 / 3.0, 16.0 / 3.0, 0.8), (2.0 / 3.0, 7.0 / 3.0, 0.15))
"""Band-passed noise that tears walls: narrow and wide Gaussian, texels, and weight."""
PATCH_BAND = (1.4, 5.0)
"""The same for noise that makes foam thicker in some places, in sigma."""


def lace(shape: Shape, sigma: float, aspect: float, age: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Ranks of the walls of a foam; of ``shape``.

    sigma: spacing of the finest grid of coarse sites, texels; the largest cells are some four times as wide.
    aspect: length of cells along x over their width, at least 1. age: 0, young foam, even and whole, to 1, old foam:
    wider holes, torn walls, patches.
    """
    rows, columns = shape
    warp = [WARP * sigma * _noise(rng, shape, WARP_WIDTH * sigma, None) for _ in range(2)]
    # Cells of one area, longer along x; shifts along y shrink with them, or walls along x would turn into waves.
    box = np.array((columns / np.sqrt(aspect), rows * np.sqrt(aspect)))
    x = np.mod(np.arange(columns)[None, :] + 0.5 + warp[0], columns) * (box[0] / columns)
    y = np.mod(np.arange(rows)[:, None] + 0.5 + warp[1] / aspect, rows) * (box[1] / rows)
    places = np.stack((x, y), axis=-1).reshape(-1, 2)
    young = 1.0 - age
    power = 0.85 + 0.1 * young
    spread = 0.9 - 0.1 * young
    progress(0.1)
    coarse = _depths(places, box, [sigma * a for a in COARSE], COARSE_CHANCE, power, spread, rng)
    progress(0.5)
    fine_scale = sigma * (0.75 + 0.25 * young)
    fine = _depths(places, box, [fine_scale * a for a in FINE], FINE_CHANCE, power, spread, rng)
    progress(0.9)
    behind = 0.36 - 0.06 * young
    depth = -UNION * np.logaddexp(-coarse / UNION, -(behind + FINE_WEIGHT * fine) / UNION)
    field = depth.reshape(shape)
    for narrow, wide, weight in ROUGH_BANDS:
        field += (0.04 - 0.01 * young) * weight * _noise(rng, shape, narrow, wide)
    field += (0.08 - 0.02 * young) * _noise(rng, shape, PATCH_BAND[0] * sigma, PATCH_BAND[1] * sigma)
    return rank(field)


def _noise(rng: np.random.Generator, shape: Shape, narrow: float, wide: float | None) -> Field:
    """White noise filtered by a Gaussian, or a difference of two, with a root mean square of 1; of ``shape``."""
    response = gaussian_response(shape, narrow)
    if wide is not None:
        response = response - gaussian_response(shape, wide)
    response[0, 0] = 0.0
    noise = filter_noise(rng, shape, response)
    scaled: Field = noise / noise.std()
    return scaled


def _depths(
    places: Field,
    box: Field,
    spacings: Sequence[float],
    chances: Sequence[float],
    power: float,
    spread: float,
    rng: np.random.Generator,
) -> Field:
    """How deep places (n, 2) lie in the cells of a power diagram on the torus ``box``: 0 at walls; (n,).

    The power distance of a site of radius r is |x - c|^2 - r^2. Depths are counted in radii of the cell to the power
    ``power``, so that cells open nearly together, each by its own random factor within 1 -+ spread / 2.
    """
    # Here, because only new masks need it: shipped ones are read.
    from scipy.spatial import cKDTree

    centres, radii = _sites(box, spacings, chances, rng)
    factor = 1.0 + spread * (rng.random(radii.size) - 0.5)
    largest = radii.max()
    # A third coordinate turns power distances into distances: |x - c|^2 + R^2 - r^2.
    tree = cKDTree(np.column_stack((centres, np.sqrt(largest**2 - radii**2))), boxsize=(*box, 0.0))
    distance, site = tree.query(np.column_stack((places, np.zeros(len(places)))), k=NEIGHBOURS)
    own = site[:, :1]
    apart = centres[site[:, 1:]] - centres[own]
    apart -= box * np.rint(apart / box)
    squared = distance * distance
    walls = (squared[:, 1:] - squared[:, :1]) / (2.0 * np.sqrt((apart * apart).sum(axis=-1)))
    border = BORDER * min(spacings)
    inside = -border * np.log(np.exp(-walls / border).sum(axis=1))
    own_radius = radii[own[:, 0]]
    depth: Field = inside / (max(spacings) ** (1.0 - power) * own_radius**power * factor[own[:, 0]])
    return depth


def _sites(
    box: Field, spacings: Sequence[float], chances: Sequence[float], rng: np.random.Generator
) -> tuple[Field, Field]:
    """Centres (n, 2) anywhere in cells of jittered grids, and radii (n,), texels."""
    centres: list[Field] = []
    radii: list[Field] = []
    for spacing, chance in zip(spacings, chances, strict=True):
        columns, rows = (max(round(side / spacing), 1) for side in box)
        random: NDArray[np.float64] = rng.random((4, rows, columns))
        kept = random[3] < chance
        if spacing == min(spacings):
            # No tile is so small that a place had fewer neighbours than are asked for.
            kept.reshape(-1)[:NEIGHBOURS] = True
        x = (np.arange(columns)[None, :] + random[0]) * (box[0] / columns)
        y = (np.arange(rows)[:, None] + random[1]) * (box[1] / rows)
        place = np.stack((x[kept], y[kept]), axis=-1)
        # Rounding may reach the far side, which is the near side of the next tile.
        centres.append(np.minimum(place, np.nextafter(box, 0.0)))
        radii.append(spacing * (RADIUS_LEAST + RADIUS_RANGE * random[2][kept]))
    return np.concatenate(centres), np.concatenate(radii)
