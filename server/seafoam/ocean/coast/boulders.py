"""The shapes of stones that stand over a current. docs/formulae.md, section 16."""

import math

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.basics.hash import chance
from seafoam.scene import Stone

BOULDER_REACH = 1.2
"""Greatest distance of a stone's surface from its upright axis, radii."""


def cuts(stone: Stone) -> Floats:
    """(8, 3): planes m·x = 1 that cut a stone, five its sides and two its top, x in radii from its middle on still
    water; and last its place in the noise, cells. By a hash of its place; rounded to 2⁻²⁰."""
    a, b, c = chance(*(round(1e3 * part) for part in stone.place), np.arange(9)[:, None], np.arange(3)).T
    k = np.arange(7)
    heading = 2.0 * math.pi * (a[8] + np.where(k < 5, (k + 0.8 * a[:7]) / 5.0, a[:7]))
    lean, near = 0.15 + 0.9 * b[:7] ** 2, 0.6 + 0.6 * c[:7]
    out, up = np.where(k < 5, ((np.ones(7), lean)), (0.2 + 0.5 * lean, np.ones(7)))
    far = np.where(k < 5, near, (0.3 + 0.65 * near) * stone.dome / stone.radius)
    planes = np.stack((out * np.cos(heading), up, out * np.sin(heading))) / far
    return np.round(np.vstack((planes.T, 64.0 * np.array([a[7], b[7], c[7]]))) * 2.0**20) / 2.0**20
