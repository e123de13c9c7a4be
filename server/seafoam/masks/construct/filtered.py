"""Masks that are white noise, filtered and ranked: ``blur`` (low-pass) and ``clump`` (band-pass)."""

import numpy as np

from seafoam.masks.torus import Field, Ranks, Shape, filter_noise, gaussian_response, rank

WIDE_PER_NARROW = 4.0
"""Wide over narrow Gaussian of a difference of Gaussians."""


def blur(shape: Shape, sigma: float, rng: np.random.Generator) -> Ranks:
    """White noise filtered by a Gaussian of ``sigma`` texels, ranked; of ``shape``.

    The literal reading of the sentence in Yingst, Alford and Parberry (2011) that a Gaussian filters white
    noise. Its spectrum has neither the oscillation nor the high frequencies that the paper plots.
    """
    return rank(filter_noise(rng, shape, gaussian_response(shape, sigma)))


def clump(shape: Shape, sigma: float, rng: np.random.Generator) -> Ranks:
    """White noise filtered by a difference of Gaussians of ``sigma`` and 4 ``sigma`` texels, ranked; of ``shape``.

    Band-passed ("green") noise: irregular lace without the continents that low frequencies make.
    """
    return rank(band_passed(shape, sigma, rng))


def band_passed(shape: Shape, sigma: float, rng: np.random.Generator) -> Field:
    """The noise that :func:`clump` ranks; float64 of ``shape``."""
    response = gaussian_response(shape, sigma) - gaussian_response(shape, WIDE_PER_NARROW * sigma)
    return filter_noise(rng, shape, response)
