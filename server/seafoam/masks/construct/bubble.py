"""Masks whose foam consists of discs: ``bubble``, and ``mix``, its clustered form.

Sites are scattered over the torus and given birth thresholds r_i. The mask is the rank of min_i(r_i + a d_i^2),
so the foam at a threshold t is the union of discs of radius sqrt((t - r_i) / a): as saturation falls, bubbles
shrink and disappear one after another.
"""

import numpy as np

from seafoam.masks.construct import void_cluster
from seafoam.masks.torus import Progress, Ranks, Shape, band_passed, rank

SITE_SIGMA = 1.5
"""Void-and-cluster Gaussian that orders the sites, in cells (Ulichney's constant)."""
JITTER = 1.0
"""Sites are anywhere in their cells; half as much leaves the lattice visible as spectral peaks."""
CURVATURE = 0.16
"""a, in units of 1/spacing^2: lets about a quarter of the sites show at half cover, with a range of sizes."""
REACH = 3
"""Cells each way that can hold the nearest disc: beyond them CURVATURE * 3^2 exceeds what the own cell gives."""
CLUMP_WEIGHT = 0.6
WIDE_PER_NARROW = 4.0
"""Wide over narrow Gaussian of the noise that gathers clumps."""


def bubble(shape: Shape, spacing: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Ranks of the disc field of about a site for every spacing^2 texels; of ``shape``."""
    cells = (round(shape[0] / spacing), round(shape[1] / spacing))
    order = void_cluster.ordered(cells, SITE_SIGMA, rng, lambda part: progress(0.5 * part))
    birth = (order + 0.5) / order.size
    jitter = JITTER * (rng.random((2, *cells)) - 0.5)
    centres = [(np.arange(side) + 0.5) * (count / side) for side, count in zip(shape, cells, strict=True)]
    own = [np.floor(centre).astype(np.intp) for centre in centres]
    # Rounded to whole cells, the two spacings differ a little: discs stay round.
    high, wide = (side / count for side, count in zip(shape, cells, strict=True))
    mean = np.sqrt(high * wide)
    field = np.full(shape, np.inf)
    for dy in range(-REACH, REACH + 1):
        progress(0.5 + 0.5 * (dy + REACH) / (2 * REACH + 1))
        row = (own[0] + dy) % cells[0]
        from_row = (own[0] + dy + 0.5 - centres[0])[:, None]
        for dx in range(-REACH, REACH + 1):
            column = (own[1] + dx) % cells[1]
            sites = np.ix_(row, column)
            y = (from_row + jitter[0][sites]) * (high / mean)
            x = ((own[1] + dx + 0.5 - centres[1])[None, :] + jitter[1][sites]) * (wide / mean)
            np.minimum(field, birth[sites] + CURVATURE * (x * x + y * y), out=field)
    progress(1.0)
    return rank(field)


def mix(shape: Shape, sigma: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Bubbles gathered into clumps: rank of 0.6 x clump rank + 0.4 x bubble rank, both of scale ``sigma``."""
    clumps = rank(band_passed(rng, shape, sigma, WIDE_PER_NARROW * sigma))
    bubbles = bubble(shape, sigma, rng, progress)
    return rank(CLUMP_WEIGHT * clumps + (1.0 - CLUMP_WEIGHT) * bubbles)
