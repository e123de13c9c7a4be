"""The shapes of stones that stand over a current. docs/formulae.md, section 16."""

import math

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.basics.hash import chance
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Current, Stone

BOULDER_REACH = 1.2
"""Greatest distance of a stone's surface from its upright axis, radii."""
SIDES, TOPS = 5, 2
"""Numbers of the planes that cut a stone's sides and its top."""


def boulders(current: Current | None) -> tuple[Stone, ...]:
    """Return the stones that stand over the water."""
    return () if current is None else tuple(stone for stone in current.stones if stone.height > 0.0)


def dome_height(stone: Stone) -> float:
    """Height of the dome that planes cut to the stone's height, about, m."""
    return round(1.12 * stone.height * stone.radius, 6)


def cuts(stone: Stone) -> Floats:
    """(SIDES + TOPS + 1, 3): planes m·x = 1 that cut the stone, x in radii from its middle on still water; and last the
    place of the stone in its noise, cells. By a hash of its place; rounded to 2⁻²⁰."""
    a, b, c = chance(*(round(1e3 * part) for part in stone.place), np.arange(9)[:, None], np.arange(3)).T
    k = np.arange(SIDES + TOPS)
    heading = 2.0 * math.pi * (a[-1] + np.where(k < SIDES, (k + 0.8 * a[:-2]) / SIDES, a[:-2]))
    level = np.stack((np.cos(heading), np.zeros_like(heading), np.sin(heading)), axis=-1)
    lean, near = 0.15 + 0.9 * b[:-2, None] ** 2, 0.6 + 0.6 * c[:-2, None]
    up = np.array([0.0, 1.0, 0.0])
    sides = (level + lean * up) / near
    tops = ((0.2 + 0.5 * lean) * level + up) / ((0.3 + 0.65 * near) * dome_height(stone) / stone.radius)
    planes = np.where(k[:, None] < SIDES, sides, tops)
    return np.round(np.concatenate((planes, [64.0 * np.array([a[-2], b[-2], c[-2]])])) * 2.0**20) / 2.0**20


def wetted(current: Current) -> float:
    """Height over still water up to which water runs over stones, m: a share of the velocity head, and a film."""
    return round(0.04 + 0.35 * current.speed**2 / (2.0 * GRAVITY), 4)
