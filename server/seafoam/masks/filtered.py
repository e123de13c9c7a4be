"""Masks that are white noise, filtered and ranked: ``blur`` (low-pass) and ``clump`` (band-pass)."""

from __future__ import annotations

import numpy as np

from seafoam.masks.torus import Field, Ranks, filter_noise, gaussian_response, rank

WIDE_PER_NARROW = 4.0
"""Wide over narrow Gaussian of a difference of Gaussians."""


def blur(size: int, sigma: float, rng: np.random.Generator) -> Ranks:
    """White noise filtered by a Gaussian of ``sigma`` texels, ranked; (size, size).

    The literal reading of the sentence in Yingst, Alford and Parberry (2011) that a Gaussian filters white
    noise. Its spectrum has neither the oscillation nor the high frequencies that the paper plots.
    """
    return rank(filter_noise(rng, size, gaussian_response(size, sigma)))


def clump(size: int, sigma: float, rng: np.random.Generator) -> Ranks:
    """White noise filtered by a difference of Gaussians of ``sigma`` and 4 ``sigma`` texels, ranked; (size, size).

    Band-passed ("green") noise: irregular lace without the continents that low frequencies make.
    """
    return rank(band_passed(size, sigma, rng))


def band_passed(size: int, sigma: float, rng: np.random.Generator) -> Field:
    """The noise that :func:`clump` ranks; (size, size) float64."""
    response = gaussian_response(size, sigma) - gaussian_response(size, WIDE_PER_NARROW * sigma)
    return filter_noise(rng, size, response)
