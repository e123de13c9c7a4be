"""Textures of shores: heights, a swell's way, profiles of waves, rocks. docs/formulae.md, sections 8 and 13."""

from functools import lru_cache
from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, Field

from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.coast.travel import travel_grid
from seafoam.scene import Shore
from seafoam.textures.spec import Image, TextureSpec

ROWS = 16
"""Profiles: γ from 1 (row 0) to the skew of a breaking wave (last row)."""
FRONT = 0.012
"""Standard deviation of the Gaussian that smooths profiles, in wavelengths: a height field cannot overhang."""
Side = Literal[32, 64, 128, 256, 512, 1024]
Ground = Annotated[Shore, AfterValidator(lambda shore: shore.ground)]
"""A shore without what its heights do not depend on."""
Approach = Annotated[Shore, AfterValidator(lambda shore: shore.approach)]
"""A shore without what a swell's way over it does not depend on."""


class ShoreFloor(TextureSpec):
    """A shore's height field, RG32F (texels, texels): height (m) and tint."""

    kind: ClassVar[str] = "shore-floor"
    shore: Ground
    texels: Side

    def image(self) -> Image:
        return Image("RG32F", (floor_grid(self.shore, self.texels).astype("<f4"),))


class ShoreTravel(TextureSpec):
    """Travel time of a swell over a shore's floor, RG32F (texels, texels): periods, and the share of its height."""

    kind: ClassVar[str] = "shore-travel"
    shore: Approach
    texels: Side

    def image(self) -> Image:
        return Image("RG32F", (travel_grid(self.shore, self.texels).astype("<f4"),))


class ShoreProfiles(TextureSpec):
    """Profiles of shore waves, RG32F (ROWS, nodes): each height beside that of the next row."""

    kind: ClassVar[str] = "shore-profiles"
    nodes: Side
    skew: float = Field(ge=0.0, le=1.0)
    sharpness: float = Field(ge=0.0, le=0.15)

    def image(self) -> Image:
        table = shore_profiles(self.nodes, self.skew, self.sharpness)
        # For one fetch of both; the last row is repeated.
        return Image("RG32F", (np.stack([table, np.concatenate([table[1:], table[-1:]])], axis=-1).astype("<f4"),))


class SprayRocks(TextureSpec):
    """Places on a shore's rocks, RGBA32F (1, ROCKS), see :func:`seafoam.ocean.coast.rocks.rocks`."""

    kind: ClassVar[str] = "spray-rocks"
    shore: Ground
    steep: float = Field(ge=0.0, le=2.0)

    def image(self) -> Image:
        """Return the places as a row. Raises ``ValueError`` where there are none."""
        places = rocks(self.shore, self.steep)
        if len(places) == 0:
            raise ValueError("shore: has no rocks as steep as that")
        return Image("RGBA32F", (places.astype("<f4")[None],))


@lru_cache(maxsize=16)
def shore_profiles(nodes: int, skew: float, sharpness: float) -> NDArray[np.float32]:
    """(ROWS, nodes) float32: height of a wave in [0, 1] at x = (i + ½)/nodes wavelengths, the front toward rising x.

    Where the trochoid overhangs, the highest of its branches counts.
    """
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
