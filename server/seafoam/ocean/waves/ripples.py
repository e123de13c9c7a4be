"""Wind ripples: two cascades of sines with integer wavenumbers on tiles, and each once more, turned and shifted."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from seafoam.ocean.basics.hash import chance
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Ripples

TILES = (18.9, 4.1)
"""Sides of the two tiles, m."""
TURN = (20.0 / 29.0, 21.0 / 29.0)
"""Cosine and sine of the angle by which each tile is turned for its second copy, 0.81 rad. A tile alone shows as a
lattice; both copies repeat together after 29 sides only."""
SHIFTS = ((0.37, 0.19), (0.83, 0.56))
"""Place of the second copy's origin in each tile, in sides: about the origin the copies are not alike."""
LEAST_SPREAD = 0.5
"""Spread from which ripples have a second copy, rad: with less, the copies would cross as two wave trains."""
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
    return REPEATING_TILES if repeats else TILES


def _copy(wave: Ripple, shift: tuple[float, float], side: float) -> Ripple:
    (c, s), (kx, kz) = TURN, (wave.kx, wave.kz)
    phase = wave.phase - side * (kx * shift[0] + kz * shift[1])
    return replace(wave, kx=c * kx - s * kz, kz=s * kx + c * kz, phase=math.remainder(phase, 2.0 * math.pi))


@lru_cache(maxsize=64)
def ripple_cascades(ripples: Ripples, repeats: bool = False) -> tuple[tuple[Ripple, ...], ...]:
    """Return the ripples of each tile by rising wavenumber, then those of the tiles' second copies if there are any.

    Mean square slopes add up to ``ripples.slope``².
    """
    copied = not repeats and ripples.spread >= LEAST_SPREAD
    # Both copies' mean directions and their spread make up what is asked for.
    half = 0.5 * math.atan2(TURN[1], TURN[0]) if copied else 0.0
    mean, spread = ripples.downwind - half, math.sqrt(ripples.spread**2 - half**2)
    # Equal mean square slope in each octave of wavenumber, the tail of a saturated wind sea (Phillips 1958).
    amplitude = ripples.slope * math.sqrt((1.0 if copied else 2.0) / (len(TILES) * WAVES_PER_TILE))
    cascades = []
    for cascade, (side, (shortest, longest)) in enumerate(zip(tiles(repeats), _RANGES, strict=True)):
        waves: dict[tuple[int, int], Ripple] = {}
        for index in range(WAVES_PER_TILE):
            draws = [float(chance(ripples.seed, cascade, index, part)) for part in range(4)]
            wavelength = longest * (shortest / longest) ** ((index + draws[0]) / WAVES_PER_TILE)
            normal = math.sqrt(-2.0 * math.log(draws[1])) * math.cos(2.0 * math.pi * draws[2])
            heading = mean + spread * normal
            number = side / wavelength
            ix, iz = round(number * math.cos(heading)), round(number * math.sin(heading))
            # Two ripples with the same wavevector would add up or cancel, so the second gets the next free integers.
            while (ix, iz) in waves or (ix, iz) == (0, 0):
                ix += 1
            kx, kz = 2.0 * math.pi * ix / side, 2.0 * math.pi * iz / side
            k = math.hypot(kx, kz)
            omega = math.sqrt(GRAVITY * k + SURFACE_TENSION * k**3)
            waves[ix, iz] = Ripple(kx, kz, omega, 2.0 * math.pi * draws[3], amplitude)
        cascades.append(tuple(sorted(waves.values(), key=lambda wave: (wave.k, wave.kx, wave.kz))))
    if not copied:
        return tuple(cascades)
    per_tile = zip(cascades, SHIFTS, TILES, strict=True)
    copies = (tuple(_copy(wave, shift, side) for wave in waves) for waves, shift, side in per_tile)
    return (*cascades, *copies)
