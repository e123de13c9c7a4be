"""Wind ripples: two cascades of sines with integer wavenumbers on incommensurate tiles."""

import math
from dataclasses import dataclass
from functools import lru_cache

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.hash import chance
from seafoam.scene.water import Chop

TILES = (18.9, 4.1)
"""Sides of the two tiles, m; their common period is so long that no repetition is visible."""
REPEATING_TILES = (9.3, 3.1)
"""Sides of the two tiles, m, if ripples must repeat with the larger one, as caustics on a tile require."""
WAVES_PER_TILE = 14
BANDS = 2
"""Number of wavenumber bands of a tile, of equal count; a band is filtered as one."""
SURFACE_TENSION = 7.4e-5
"""Surface tension over density of water, m³/s²."""

_RANGES = ((1.1, 6.5), (0.16, 1.05))
"""Shortest and longest wavelength of each tile, m."""


@dataclass(frozen=True)
class Ripple:
    """A ripple θ = ωt − k·x + phase; slope is the amplitude of the slope along k."""

    kx: float
    kz: float
    omega: float
    phase: float
    slope: float

    @property
    def k(self) -> float:
        """Wavenumber, rad/m."""
        return math.hypot(self.kx, self.kz)


def tiles(repeats: bool) -> tuple[float, float]:
    """Sides of the two tiles, m."""
    return REPEATING_TILES if repeats else TILES


@lru_cache(maxsize=64)
def ripples(chop: Chop, repeats: bool = False) -> tuple[tuple[Ripple, ...], ...]:
    """Return the ripples of each cascade by rising wavenumber. Their mean square slopes add up to ``chop.slope``²."""
    cascades = []
    weights = []
    for cascade, tile in enumerate(tiles(repeats)):
        longest, shortest = _RANGES[cascade][1], _RANGES[cascade][0]
        drawn: list[tuple[float, float, float, float]] = []
        used: set[tuple[int, int]] = set()
        for index in range(WAVES_PER_TILE):
            share = (index + float(chance(chop.seed, cascade, index, 0))) / WAVES_PER_TILE
            wavelength = longest * (shortest / longest) ** share
            normal = math.sqrt(-2.0 * math.log(float(chance(chop.seed, cascade, index, 1)))) * math.cos(
                2.0 * math.pi * float(chance(chop.seed, cascade, index, 2))
            )
            heading = chop.wind_direction + chop.spread * normal
            number = tile / wavelength
            ix, iz = round(number * math.cos(heading)), round(number * math.sin(heading))
            # Two ripples with the same wavevector would add up or cancel, so the second gets the next free integers.
            while (ix, iz) in used or (ix == 0 and iz == 0):
                ix += 1
            used.add((ix, iz))
            kx, kz = 2.0 * math.pi * ix / tile, 2.0 * math.pi * iz / tile
            k = math.hypot(kx, kz)
            drawn.append((k, kx, kz, 2.0 * math.pi * float(chance(chop.seed, cascade, index, 3))))
            # Equal mean square slope in each octave of wavenumber, the tail of a saturated wind sea (Phillips 1958).
            weights.append(1.0)
        cascades.append(sorted(drawn))
    amplitude = chop.slope * math.sqrt(2.0 / sum(weights))
    return tuple(
        tuple(
            Ripple(kx, kz, math.sqrt(GRAVITY * k + SURFACE_TENSION * k**3), phase, amplitude)
            for k, kx, kz, phase in drawn
        )
        for drawn in cascades
    )
