"""Textures of shores: the floor's heights, and the table of shore-wave profiles. docs/formulae.md, section 8."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.seabed import floor_grid
from seafoam.scene.shore import Shore

ROWS = 16
"""Profiles: γ from 1 (row 0) to the skew of a breaking wave (last row)."""
FRONT = 0.012
"""Standard deviation of the Gaussian that smooths profiles, in wavelengths: a height field cannot overhang."""
_SIZES = (32, 64, 128, 256, 512, 1024)


def shore_floor_name(shore: Shore, texels: int) -> str:
    """Name in the texture store of a shore's height field."""
    return f"shore-floor/{texels}/{shore.ground}"


def shore_floor(texels: str, ground: str) -> NDArray[np.float32]:
    """(texels, texels, 2) float32: height (m) and tint. Raises ``ValueError`` for other sizes and grounds."""
    if texels not in map(str, _SIZES):
        raise ValueError(texels)
    shore = Shore.of_ground(ground)
    return floor_grid(shore, int(texels)).astype(np.float32)


def shore_profiles_name(skew: float, sharpness: float, nodes: int) -> str:
    """Name in the texture store of a table of profiles."""
    return f"shore-profiles/{nodes}/{skew!r}/{sharpness!r}"


def with_next_row(table: NDArray[np.float32]) -> NDArray[np.float32]:
    """(rows, nodes, 2): each entry with that of the next row, for one fetch of both; the last row is repeated."""
    return np.stack([table, np.concatenate([table[1:], table[-1:]])], axis=-1)


@lru_cache(maxsize=16)
def shore_profiles(nodes: int, skew: float, sharpness: float) -> NDArray[np.float32]:
    """(ROWS, nodes) float32: height of a wave in [0, 1] at x = (i + ½)/nodes wavelengths, the front toward rising x.

    Where the trochoid overhangs, its highest branch is used. Raises ``ValueError`` out of range.
    """
    if nodes not in _SIZES or not (0.0 <= skew <= 1.0 and 0.0 <= sharpness <= 0.15):
        raise ValueError(nodes, skew, sharpness)
    fine = 2048
    u = np.arange(fine) / fine
    table = np.empty((ROWS, nodes), np.float32)
    places = (np.arange(fine) + 0.5) / fine
    wave = np.fft.rfftfreq(fine, 1.0 / fine)
    spread = np.exp(-0.5 * (2.0 * np.pi * FRONT * wave) ** 2)
    at = (np.arange(nodes) + 0.5) / nodes
    for row in range(ROWS):
        gamma = 1.0 - (1.0 - skew) * row / (ROWS - 1)
        phase = 2.0 * np.pi * u**gamma
        x, y = u - sharpness * np.sin(phase), 0.5 + 0.5 * np.cos(phase)
        x, y = np.append(x, x[0] + 1.0), np.append(y, y[0])
        top = np.full(fine, -1.0)
        for turn in (-1.0, 0.0, 1.0):
            a, b = x[:-1] + turn, x[1:] + turn
            first = np.ceil(np.minimum(a, b) * fine - 0.5).astype(int)
            last = np.floor(np.maximum(a, b) * fine - 0.5).astype(int)
            for step in range(int((last - first).max()) + 1):
                place = first + step
                inside = (place <= last) & (place >= 0) & (place < fine)
                share = (places[place[inside]] - a[inside]) / np.where(b == a, 1.0, b - a)[inside]
                height = y[:-1][inside] + share * (y[1:] - y[:-1])[inside]
                np.maximum.at(top, place[inside], height)
        smooth = np.fft.irfft(np.fft.rfft(top) * spread, fine)
        profile = np.interp(at, places, smooth, period=1.0)
        table[row] = np.round(np.clip(profile, 0.0, 1.0) * 65536.0) / 65536.0
    return table
