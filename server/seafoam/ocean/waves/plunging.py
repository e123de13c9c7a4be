"""A plunging crest: proportions of its section, and how it breaks along a reef. docs/formulae.md, section 17.

Lengths are in the crest's greatest height, x along its travel and z up, from still water under the first vertical face,
which is an arc of New's ellipse (1983, J. Fluid Mech. 130). That fits a part of the loop alone (Greenhow 1983, ibid.
134); the jet falls freely (Longuet-Higgins 1982, ibid. 121).
"""

import math
from typing import NamedTuple

from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Breaker

ASPECT, LONG, TILT = math.sqrt(3.0), 0.6, math.radians(30.0)
"""Of the ellipse: long over short axis, the long semi-axis, and the angle by which that falls toward the front."""
BORE, LENGTH, LEAN = 0.1, 4.0, 3.0
"""Way of the face back until the jet lands, length of the back, and how far ahead a face begins that is not steep."""
_COS, _SIN = math.cos(TILT), math.sin(TILT)
XX, ZZ = _COS**2 + ASPECT**2 * _SIN**2, _SIN**2 + ASPECT**2 * _COS**2
XZ = (ASPECT**2 - 1.0) * _COS * _SIN
"""XX x² + 2 XZ x z + ZZ z² is the square of the ellipse's long semi-axis, x and z from its centre."""
HALF_WIDTH, HALF_HEIGHT = LONG * math.sqrt(ZZ) / ASPECT, LONG * math.sqrt(XX) / ASPECT
VERTICAL, FOREMOST = HALF_HEIGHT + XZ / ZZ * HALF_WIDTH, HALF_HEIGHT - XZ / ZZ * HALF_WIDTH
"""Heights at which the face is vertical, and of the ellipse's foremost point, which the jet's top passes at x = 1."""
THROW, BREAKING_INDEX = 1.0 / math.sqrt(1.0 - FOREMOST), 0.78
"""Way of the jet's tip until it lands; height of a solitary wave over the depth where it breaks (McCowan 1894)."""
LEANING, SHOULDER, TAIL, TAPER = 6.0, 14.0, 8.0, 0.25
"""From the first vertical face along what has not broken: where the face has not steepened at all, and the foot; where
nothing is left of what has, in ways until the jet lands; share of the crest's length over which it rises at an end."""
FRONT, LOWEST = 4.0, 2e-4
"""Farthest that anything of it reaches ahead, and height from which on it is drawn."""
GENTLE, LUMP, SEED, APRON = 0.15, 0.36, 1983, 0.004
"""How gradually the jet begins; size of the first lumps of what it throws up, their seed, and height of foam around."""
STREAK, CLOUDED, RAISED, FOOT, CELL, SOFT, CRESTS = 0.35, 1.2, 0.15, 1.2, 1.2, 0.65, 64
"""Scale of foam along the water's way; extinction by what the back reflects totally; least rise of rays through it;
foot of the bore, size of the patches of foam it leaves, how far its own foam faces up; most crests at one time."""


class Overturning(NamedTuple):
    """How crests break: number under way at once; way along one from the first vertical face to where the jet lands,
    speed of that face along it (1/s), way of the crest ahead for each that the face moves, its length, and way of the
    face from crest to crest and from where one rises to where nothing is left of it."""

    crests: int
    landing: float
    rate: float
    advance: float
    length: float
    period: float
    life: float


def overturning(crest: Breaker) -> Overturning:
    """Return how a crest breaks that travels as fast as a solitary wave of its height where it breaks.

    The reef is oblique to it by the peel angle, so its vertical face moves along it with c/tan of that (Walker 1974).
    """
    height, advance, length = crest.height, math.tan(crest.peel_angle), crest.length / crest.height
    rate = math.sqrt(GRAVITY * height * (1.0 + 1.0 / BREAKING_INDEX)) / advance / height
    landing = rate * math.sqrt(2.0 * height / GRAVITY)
    period, life = rate * crest.every, SHOULDER + length + TAIL * landing
    # The digits that all processors agree on.
    form = (float(f"{value:.8g}") for value in (landing, rate, advance, length, period, life))
    return Overturning(math.ceil(round(life / period, 6)), *form)
