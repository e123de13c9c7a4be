"""The spectrum of an open sea as a texture, and the roots of unity of its transform."""

import math

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from seafoam.ocean.cascades import cascades
from seafoam.scene.water import Water
from seafoam.scene.waves import Sea

ROOTS = 512


class UnknownSeaError(KeyError):
    """The name is not that of a sea."""


def sea_spectrum_name(sea: Sea, depth: float | None) -> str:
    """Name in the texture store of an FFT sea's spectrum over water of a depth, m."""
    numbers = (sea.wind, sea.fetch, sea.wind_direction, sea.spread, sea.against)
    words = [f"{value:.9g}" for value in numbers]
    return "/".join(["sea", *words, str(sea.seed), "deep" if depth is None else f"{depth:.9g}"])


def sea_spectrum(words: list[str]) -> NDArray[np.float32]:
    """(4·BAND, 8·BAND, 2) float32: first (Re, Im) of h₀ in m, then (periods in a loop, 0).

    ``words``: the parts of the texture's name after ``sea/``.

    Raises :class:`UnknownSeaError`.
    """
    try:
        wind, fetch, direction, spread, against, seed, depth = words
        sea = Sea(
            wind=float(wind),
            fetch=float(fetch),
            wind_direction=float(direction),
            spread=float(spread),
            against=float(against),
            seed=int(seed),
        )
        water = Water(depth=None if depth == "deep" else float(depth))
    except (ValueError, ValidationError) as error:
        raise UnknownSeaError("/".join(words)) from error
    tiles = cascades(sea, water.depth)
    amplitude = np.concatenate([tile.h0 for tile in tiles], axis=1)
    turns = np.concatenate([tile.turns for tile in tiles], axis=1)
    below = np.stack((amplitude.real, amplitude.imag), axis=-1)
    above = np.stack((turns, np.zeros_like(turns)), axis=-1)
    return np.concatenate((below, above)).astype(np.float32)


def fft_twiddles() -> NDArray[np.float32]:
    """(512, 2) float32: cos and sin of 2πj/512, computed by ``math`` alone."""
    angles = [2.0 * math.pi * j / ROOTS for j in range(ROOTS)]
    return np.array([(math.cos(angle), math.sin(angle)) for angle in angles], np.float32)
