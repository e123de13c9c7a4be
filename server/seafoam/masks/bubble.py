"""Masks whose foam is made of discs: ``bubble``, and ``mix``, its clustered form.

Sites are scattered over the torus and given birth thresholds r_i. The mask is the rank of min_i(r_i + a d_i^2),
so the foam at a threshold t is the union of discs of radius sqrt((t - r_i) / a): as saturation falls, bubbles
shrink and go out one after another.
"""

from __future__ import annotations

import numpy as np

from seafoam.masks import void_cluster
from seafoam.masks.filtered import band_passed
from seafoam.masks.torus import Field, Progress, Ranks, rank

SITE_SIGMA = 1.5
"""Void-and-cluster Gaussian that orders the sites, in cells (Ulichney's constant)."""
JITTER = 1.0
"""Sites are anywhere in their cells; half as much leaves the lattice visible as spectral peaks."""
CURVATURE = 0.16
"""a, in units of 1/spacing^2: lets about a quarter of the sites show at half cover, with a range of sizes."""
REACH = 3
"""Cells each way that can hold the nearest disc: beyond them CURVATURE * 3^2 exceeds what the own cell gives."""
CLUMP_WEIGHT = 0.6


def bubble(size: int, spacing: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Ranks of the disc field of about (size/spacing)^2 sites; (size, size)."""
    return rank(_disc_field(size, spacing, rng, progress))


def mix(size: int, sigma: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Bubbles gathered into clumps: rank of 0.6 x clump rank + 0.4 x bubble rank, both of scale ``sigma``."""
    clumps = rank(band_passed(size, sigma, rng))
    bubbles = bubble(size, sigma, rng, progress)
    return rank(CLUMP_WEIGHT * clumps + (1.0 - CLUMP_WEIGHT) * bubbles)


def _disc_field(size: int, spacing: float, rng: np.random.Generator, progress: Progress) -> Field:
    cells = round(size / spacing)
    order = void_cluster.batched(cells, SITE_SIGMA, rng, lambda part: progress(0.5 * part))
    birth = (order + 0.5) / order.size
    jitter = JITTER * (rng.random((2, cells, cells)) - 0.5)
    centre = (np.arange(size) + 0.5) * (cells / size)
    cell = np.floor(centre).astype(np.intp)
    field = np.full((size, size), np.inf)
    for dy in range(-REACH, REACH + 1):
        progress(0.5 + 0.5 * (dy + REACH) / (2 * REACH + 1))
        row = (cell + dy) % cells
        from_row = (cell + dy + 0.5 - centre)[:, None]
        for dx in range(-REACH, REACH + 1):
            column = (cell + dx) % cells
            sites = np.ix_(row, column)
            y = from_row + jitter[0][sites]
            x = (cell + dx + 0.5 - centre)[None, :] + jitter[1][sites]
            np.minimum(field, birth[sites] + CURVATURE * (x * x + y * y), out=field)
    progress(1.0)
    return field
