"""Operations on the torus that the constructions share: Gaussians, noise filtering, ranking, local minima."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Ranks = NDArray[np.uint32]
Progress = Callable[[float], None]
Shape = tuple[int, int]
"""Rows and columns of a tile, texels."""
WRAPPED_SIGMAS = 9.0
"""Reach of a Gaussian beyond which its images on the torus are below rounding."""


def wrapped_gaussian(shape: Shape, sigma: float) -> Field:
    """Gaussian of peak ~1 about texel (0, 0), summed over the images of the torus; float64 of ``shape``.

    It is not cut off. A square cut at 4.5 sigma already shows as a plaid in wide-kernel masks, because the
    energy differences that order the texels are smaller than what such a cut leaves out.
    """
    kernel: Field = np.outer(*(_profile(side, sigma) for side in shape))
    # Subnormal values change no comparison, and adding them is slow.
    kernel[kernel < 1e-300] = 0.0
    return kernel


def _profile(side: int, sigma: float) -> Field:
    images = float(max(3, math.ceil(WRAPPED_SIGMAS * sigma / side)))
    offset = np.arange(side, dtype=np.float64)[:, None] + side * np.arange(-images, images)[None, :]
    profile: Field = np.exp(-0.5 * (offset / sigma) ** 2).sum(axis=1)
    return profile


def gaussian_response(shape: Shape, sigma: float) -> Field:
    """Transfer function exp(-2 pi^2 sigma^2 f^2) of a unit-sum Gaussian on ``rfft2`` bins; (rows, columns//2+1)."""
    fy = np.fft.fftfreq(shape[0])[:, None]
    fx = np.fft.rfftfreq(shape[1])[None, :]
    return np.exp(-2.0 * (np.pi * sigma) ** 2 * (fx * fx + fy * fy))


def filter_noise(rng: np.random.Generator, shape: Shape, response: Field) -> Field:
    """Periodic white Gaussian noise times a transfer function on ``rfft2`` bins; float64 of ``shape``."""
    noise = np.fft.rfft2(rng.standard_normal(shape))
    return np.fft.irfft2(noise * response, s=shape)


def band_passed(rng: np.random.Generator, shape: Shape, narrow: float, wide: float) -> Field:
    """White Gaussian noise filtered by a difference of Gaussians of these widths, texels; float64 of ``shape``.

    Band-passed ("green") noise: irregular lace without the continents that low frequencies make.
    """
    return filter_noise(rng, shape, gaussian_response(shape, narrow) - gaussian_response(shape, wide))


def rank(values: Field) -> Ranks:
    """Rank of each value, 0 for the least; equal values rank in raster order. An exact permutation."""
    order = np.argsort(values, axis=None, kind="stable")
    ranks = np.empty(values.size, np.uint32)
    ranks[order] = np.arange(values.size, dtype=np.uint32)
    return ranks.reshape(values.shape)


def local_minima(values: Field, radius: int) -> NDArray[np.intp]:
    """Flat indices of the finite local minima over a (2 radius + 1)^2 window, least value first.

    Along a side that is shorter than the window it is over almost the whole side.
    """
    # Here, because only new masks need it: shipped ones are read.
    from scipy.ndimage import minimum_filter

    window = [2 * min(radius, (side - 1) // 2) + 1 for side in values.shape]
    minima = np.flatnonzero((values == minimum_filter(values, window, mode="wrap")) & np.isfinite(values))
    return minima[np.argsort(values.ravel()[minima], kind="stable")]
