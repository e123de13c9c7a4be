"""Numbers of spray from open water. docs/formulae.md, section 13."""

import math

from seafoam.ocean.arrays import smooth
from seafoam.ocean.basics.spectrum import peak_frequency
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.whitecaps import whitecap_model
from seafoam.ocean.waves.cascades import BAND
from seafoam.scene import Sea, Spray, WhitecapSaturation

EPOCHS = 65536
"""Number of batches, or of surf periods, after which the same drops are emitted again."""
BATCHES = 2
"""Batches of drops in the air at any time."""
LEVELS = 4
"""Grids of cells in which drops are born, each twice as coarse as the one before."""
CELLS = 8
"""Cells along a side of a grid."""
PLACES = 12
"""Places of its cell at which a drop looks for breaking water."""
CLUSTER = 8
"""Drops that start beside each other."""
BESIDE = 0.4
"""How far beside each other, at most, in sides of a cell."""
SEA_TEXELS = 4 * BAND
"""Texels along a tile of the sea at a birth: with half as many, births were up to 25 cm off the surface of a storm."""
MOMENT = 0.04
"""Half the time over which the rise of a shore's waves is taken, s."""
GRID = 3.0
"""Side of a grid, in distances at which it has its full share of drops."""
CREST = 0.5
"""Speed of breaking crests, in phase speeds of the spectral peak."""
_STRONG = (6.0, 20.0)
"""Wind, m/s, from which on crests throw drops, and at which they do so fully."""
_TORN = (15.0, 21.0)
"""Wind, m/s, from which on it tears spindrift from crests, and at which it does so fully."""


def cell_sides(spray: Spray) -> tuple[float, ...]:
    """Sides of the cells of each grid, m."""
    return tuple(GRID / CELLS * spray.reach * 2.0 ** (level - LEVELS) for level in range(LEVELS))


def crest_velocity(sea: Sea) -> tuple[float, float]:
    """Velocity of breaking crests (x, z), m/s."""
    if sea.wind_speed <= 0.0:
        return 0.0, 0.0
    speed = CREST * GRAVITY / peak_frequency(sea.wind_speed, sea.fetch)
    return speed * math.cos(sea.downwind), speed * math.sin(sea.downwind)


def fold_limits(sea: Sea, spray: Spray, depth: float | None) -> tuple[float, float] | None:
    """Divergence below which crests throw drops, and the width from which on they do so fully; None if none do."""
    if spray.crests == 0.0 or crest_strength(sea) == 0.0:
        return None
    model = whitecap_model(sea, WhitecapSaturation(), depth, 0, 0.0, SEA_TEXELS)
    return None if model is None else (model.now[0], model.now[1] / spray.crests)


def torn_share(sea: Sea, spray: Spray) -> float:
    """Fraction of drops that are spindrift."""
    return spray.spindrift * smooth(*_TORN, sea.wind_speed)


def crest_strength(sea: Sea) -> float:
    """Strength of spray from breaking crests, in [0, 1]."""
    return smooth(*_STRONG, sea.wind_speed)
