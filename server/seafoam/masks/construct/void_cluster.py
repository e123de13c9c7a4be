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


def exact(shape: Shape, sigma: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Order the texels one at a time, each time filling the largest void of the whole torus.

    Returns ranks of ``shape``. Takes N passes over N texels: some 45 s at 512 x 512 whatever sigma is.
    """
    return _Ordering(shape, sigma, rng).fill(progress, batched=False)


def batched(shape: Shape, sigma: float, rng: np.random.Generator, progress: Progress) -> Ranks:
    """Order the texels many at a time: a pass fills the voids that are local minima, largest first.

    Returns ranks of ``shape``. Voids further apart than the window hardly see one another, so the spectrum is
    that of :func:`exact` within a few per cent, at a cost that grows as N sigma^2.
    """
    return _Ordering(shape, sigma, rng).fill(progress, batched=True)


def batch_share(sigma: float) -> float:
    """Share of the local voids that a pass of :func:`batched` fills, 0.5..1."""
    beyond = (sigma - BATCH_SIGMA_HALF) / (BATCH_SIGMA_ALL - BATCH_SIGMA_HALF)
    return 0.5 + 0.5 * min(max(beyond, 0.0), 1.0)


class _Ordering:
    """The pattern so far: its order, and its energy (pattern filtered by the Gaussian; infinite where filled)."""

    def __init__(self, shape: Shape, sigma: float, rng: np.random.Generator) -> None:
        self.shape = shape
        self.sigma = sigma
        self.texels = shape[0] * shape[1]
        self.order = np.empty(self.texels, np.intp)
        wanted = round(SEED_SHARE * self.texels / sigma**2)
        self.count = min(max(wanted, SEED_POINTS_LEAST), SEED_POINTS, self.texels // 4)
        self._set_width()
        self.order[: self.count] = _initial_order(shape, self.width, self.count, rng)

    def fill(self, progress: Progress, *, batched: bool) -> Ranks:
        while self.count < self.texels:
            # The widened Gaussian is kept for an octave of density, then matched again.
            self._set_width()
            until = self.texels if self.width <= self.sigma else min(2 * self.count, self.texels)
            if batched:
                self._fill_batches(until, progress)
            else:
                self._fill_singly(until, progress)
        ranks = np.empty(self.texels, np.uint32)
        ranks[self.order] = np.arange(self.texels, dtype=np.uint32)
        progress(1.0)
        return ranks.reshape(self.shape)

    def _set_width(self) -> None:
        spacing = math.sqrt(self.texels / self.count)
        self.width = max(self.sigma, WIDTH_PER_SPACING * spacing)

    def _energy(self, kernel_spectrum: NDArray[np.complex128]) -> Field:
        filled = self.order[: self.count]
        energy = _convolve(filled, kernel_spectrum, self.shape)
        energy.ravel()[filled] = np.inf
        return energy

    def _fill_singly(self, until: int, progress: Progress) -> None:
        rows, columns = self.shape
        kernel = wrapped_gaussian(self.shape, self.width)
        energy = self._energy(np.fft.rfft2(kernel))
        # Any shift of the torus is a view into a 2 x 2 tiling.
        tiled = np.tile(kernel, (2, 2))
        step = max(1, self.texels // 200)
        while self.count < until:
            void = int(energy.argmin())
            self.order[self.count] = void
            self.count += 1
            y, x = divmod(void, columns)
            energy += tiled[rows - y : 2 * rows - y, columns - x : 2 * columns - x]
            energy[y, x] = np.inf
            if self.count % step == 0:
                progress(self.count / self.texels)

    def _fill_batches(self, until: int, progress: Progress) -> None:
        share = batch_share(self.sigma)
        kernel_spectrum = np.fft.rfft2(wrapped_gaussian(self.shape, self.width))
        energy = self._energy(kernel_spectrum)
        radius = max(1, round(WINDOW_PER_SIGMA * self.width))
        reported = self.count
        while self.count < until:
            voids = local_minima(energy, radius)
            voids = voids[: min(max(1, math.ceil(share * voids.size)), until - self.count)]
            self.order[self.count : self.count + voids.size] = voids
            self.count += voids.size
            energy += _convolve(voids, kernel_spectrum, self.shape)
            energy.ravel()[voids] = np.inf
            if self.count - reported > self.texels // 100:
                reported = self.count
                progress(self.count / self.texels)


def _convolve(points: NDArray[np.intp], kernel_spectrum: NDArray[np.complex128], shape: Shape) -> Field:
    impulses = np.zeros(shape)
    impulses.ravel()[points] = 1.0
    return np.fft.irfft2(np.fft.rfft2(impulses) * kernel_spectrum, s=shape)


def _initial_order(shape: Shape, sigma: float, count: int, rng: np.random.Generator) -> NDArray[np.intp]:
    """Ulichney's initial pattern and phase I: relax random points, then order them, loneliest first."""
    rows, columns = shape
    kernel = wrapped_gaussian(shape, sigma)
    tiled = np.tile(kernel, (2, 2))

    def shifted(point: int) -> Field:
        y, x = divmod(point, columns)
        return tiled[rows - y : 2 * rows - y, columns - x : 2 * columns - x]

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
