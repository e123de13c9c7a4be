"""Void-and-cluster ordering of the texels of a torus (Ulichney, "The void-and-cluster method for dither array
generation", 1993), with the width of its Gaussian as the design parameter that Yingst, Alford and Parberry
(2011) vary from 1.5 to 24.

Three departures from Ulichney's text, none of which changes what is optimised:

* His phases II and III are one loop. The filter is linear, so the tightest cluster of empty texels is the empty
  texel whose filtered pattern is least: the largest void again.
* The initial pattern is sparse (at most 128 points), relaxed and ordered as he does, and void filling starts
  from there. A sparse start keeps very thin foam even.
* While the points are so far apart that the Gaussian is narrower than 0.45 of their mean distance it is widened
  to that. Narrower, its tails would vanish in rounding and the voids would be chosen by noise.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.torus import Field, Progress, Ranks, Shape, local_minima, wrapped_gaussian

SEED_POINTS = 128
SEED_POINTS_LEAST = 8
SEED_SHARE = 0.35
"""Initial points a sigma^2 area; 0.35 sets them 1.7 sigma apart, still free to order themselves."""
WIDTH_PER_SPACING = 0.45
BATCH_SIGMA_HALF = 1.5
BATCH_SIGMA_ALL = 6.0
"""Up to the first sigma a pass fills only the better half of the voids, from the second on all of them, and in
proportion between: filling all raises the low-frequency power that the construction exists to suppress, while wide
Gaussians hardly mind."""
WINDOW_PER_SIGMA = 1.4


def ordered(shape: Shape, sigma: float, rng: np.random.Generator, progress: Progress, *, exact: bool = False) -> Ranks:
    """Order the texels, largest voids first; ranks of ``shape``.

    A pass fills the voids that are local minima. Voids further apart than the window hardly see one another, so the
    spectrum is that of the exact order within a few per cent, at a cost that grows as N sigma^2. exact: a pass fills
    the largest void of the whole torus: N passes over N texels, some 45 s at 512 x 512 whatever sigma is.
    """
    texels = shape[0] * shape[1]
    count = min(max(round(SEED_SHARE * texels / sigma**2), SEED_POINTS_LEAST), SEED_POINTS, texels // 4)
    order = np.empty(texels, np.intp)
    order[:count] = _initial_order(shape, _width(sigma, texels, count), count, rng)
    reported = count
    while count < texels:
        # The widened Gaussian is kept for an octave of density, then matched again.
        width = _width(sigma, texels, count)
        until = texels if width <= sigma else min(2 * count, texels)
        kernel = wrapped_gaussian(shape, width)
        spectrum, shifted = np.fft.rfft2(kernel), _shifts(kernel)
        # The pattern so far, filtered by the Gaussian; infinite where it is filled.
        energy = _convolve(order[:count], spectrum, shape)
        energy.ravel()[order[:count]] = np.inf
        while count < until:
            if exact:
                voids = np.array([energy.argmin()])
                energy += shifted(int(voids[0]))
            else:
                voids = local_minima(energy, max(1, round(WINDOW_PER_SIGMA * width)))
                voids = voids[: min(max(1, math.ceil(batch_share(sigma) * voids.size)), until - count)]
                energy += _convolve(voids, spectrum, shape)
            energy.ravel()[voids] = np.inf
            order[count : count + voids.size] = voids
            count += voids.size
            if count - reported > texels // 100:
                reported = count
                progress(count / texels)
    ranks = np.empty(texels, np.uint32)
    ranks[order] = np.arange(texels, dtype=np.uint32)
    progress(1.0)
    return ranks.reshape(shape)


def batch_share(sigma: float) -> float:
    """Share of the local voids that a pass of :func:`ordered` fills unless it is exact, 0.5..1."""
    beyond = (sigma - BATCH_SIGMA_HALF) / (BATCH_SIGMA_ALL - BATCH_SIGMA_HALF)
    return 0.5 + 0.5 * min(max(beyond, 0.0), 1.0)


def _width(sigma: float, texels: int, count: int) -> float:
    return max(sigma, WIDTH_PER_SPACING * math.sqrt(texels / count))


def _shifts(kernel: Field) -> Callable[[int], Field]:
    """Shifts of a kernel about texel (0, 0), by the flat index of its new centre."""
    rows, columns = kernel.shape
    # Any shift of the torus is a view into a 2 x 2 tiling.
    tiled = np.tile(kernel, (2, 2))

    def shifted(point: int) -> Field:
        y, x = divmod(point, columns)
        return tiled[rows - y : 2 * rows - y, columns - x : 2 * columns - x]

    return shifted


def _convolve(points: NDArray[np.intp], kernel_spectrum: NDArray[np.complex128], shape: Shape) -> Field:
    impulses = np.zeros(shape)
    impulses.ravel()[points] = 1.0
    return np.fft.irfft2(np.fft.rfft2(impulses) * kernel_spectrum, s=shape)


def _initial_order(shape: Shape, sigma: float, count: int, rng: np.random.Generator) -> NDArray[np.intp]:
    """Ulichney's initial pattern and phase I: relax random points, then order them, loneliest first."""
    rows, columns = shape
    kernel = wrapped_gaussian(shape, sigma)
    shifted = _shifts(kernel)
    points = rng.choice(rows * columns, count, replace=False)
    energy = _convolve(points, np.fft.rfft2(kernel), shape)
    while True:
        tightest = int(energy.ravel()[points].argmax())
        here = int(points[tightest])
        energy -= shifted(here)
        void = int(energy.argmin())
        # Each move lowers the total energy by this difference, so the loop ends.
        if energy.flat[here] - energy.flat[void] <= 1e-9:
            break
        energy += shifted(void)
        points[tightest] = void

    dy = np.abs(points[:, None] // columns - points[None, :] // columns)
    dx = np.abs(points[:, None] % columns - points[None, :] % columns)
    pairs = kernel[dy, dx]
    np.fill_diagonal(pairs, 0.0)
    crowding = pairs.sum(axis=1)
    order = np.empty(count, np.intp)
    for position in range(count - 1, -1, -1):
        tightest = int(crowding.argmax())
        order[position] = points[tightest]
        crowding -= pairs[tightest]
        crowding[tightest] = -np.inf
    return order
