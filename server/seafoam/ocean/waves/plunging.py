"""A plunging crest: proportions of its section, and how it breaks along a reef. docs/formulae.md, section 17.

Lengths in units of the crest's greatest height, x along its travel and z up, from still water under the first vertical
face. The face is an arc of New's ellipse, of axes in the ratio √3 (New 1983, J. Fluid Mech. 130), which fits a part of
the loop alone (Greenhow 1983, J. Fluid Mech. 134). The jet falls freely (Longuet-Higgins 1982, J. Fluid Mech. 121).
"""

import math
from dataclasses import dataclass

from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Breaker

ASPECT = math.sqrt(3.0)
"""Long over short axis of the ellipse (New 1983)."""
LONG = 0.6
"""Its long semi-axis: the barrel is 0.85 high, and lower than the crest."""
TILT = math.radians(30.0)
"""Angle by which the long axis falls toward the front."""
BORE = 0.1
"""Way of the face back under the crest until the jet lands."""
LENGTH = 4.0
"""Of the back."""
LEAN = 3.0
"""How far the face reaches ahead where it has not steepened."""
_COS, _SIN = math.cos(TILT), math.sin(TILT)
XX, XZ, ZZ = (
    _COS**2 + ASPECT**2 * _SIN**2,
    (ASPECT**2 - 1.0) * _COS * _SIN,
    _SIN**2 + ASPECT**2 * _COS**2,
)
"""Of the ellipse: XX x² + 2 XZ x z + ZZ z² is the square of the long semi-axis, x and z from the centre."""
HALF_WIDTH, HALF_HEIGHT = (LONG * math.sqrt(axis) / ASPECT for axis in (ZZ, XX))
VERTICAL = HALF_HEIGHT + XZ / ZZ * HALF_WIDTH
"""Height at which the face is vertical."""
FOREMOST = HALF_HEIGHT - XZ / ZZ * HALF_WIDTH
"""Height of the ellipse's foremost point, which the jet's top passes 1 ahead of the crest."""
THROW = 1.0 / math.sqrt(1.0 - FOREMOST)
"""Way of the jet's tip ahead until it lands on still water."""
SLOPE = 8.0 / (3.0 * math.sqrt(3.0) * LENGTH)
"""Greatest slope of the back."""

BREAKING_INDEX = 0.78
"""Height of a solitary wave over the depth in which it breaks (McCowan 1894)."""
LEANING, SHOULDER = 6.0, 14.0
"""From the first vertical face along what has not broken: where the face has not steepened at all, and the foot."""
TAIL = 8.0
"""Where nothing of the broken crest is left, in ways along it until the jet lands."""
TAPER = 0.25
"""Share of the crest's length over which it rises at either end."""
FRONT, LOWEST = 3.8, 2e-4
"""Farthest that anything of it reaches ahead, and height from which on it is drawn."""
GENTLE = 0.15
"""How gradually the jet begins."""
LUMP, SEED, APRON = 0.3, 1983, 0.004
"""Size of the first lumps of what the jet throws up, their seed, and height of the foam around."""
STREAK = 0.35
"""Scale of foam along the water's way, which draws it out."""
CLOUDED, RAISED = 1.2, 0.15
"""Extinction by what the back reflects totally, over the height; by how much more sky than horizon is seen through."""


@dataclass(frozen=True)
class Overturning:
    """How a crest breaks: numbers in units of its height.

    ``landing``: way along the crest from the first vertical face to where the jet lands; ``rate``: speed of the face
    along it, 1/s; ``advance``: way of the crest ahead for each unit that the face moves along it; ``period``: way
    of the face from one crest to the next.
    """

    landing: float
    rate: float
    advance: float
    length: float
    period: float


def overturning(crest: Breaker) -> Overturning:
    """Return how a crest breaks that travels as fast as a solitary wave of its height where it breaks.

    The reef is oblique to the crest by the peel angle, so the place of the first vertical face moves along the crest
    with c/tan(angle) (Walker 1974).
    """
    speed = math.sqrt(GRAVITY * crest.height * (1.0 + 1.0 / BREAKING_INDEX))
    advance, length = math.tan(crest.peel_angle), crest.length / crest.height
    rate = speed / advance / crest.height
    landing = rate * math.sqrt(2.0 * crest.height / GRAVITY)
    life = SHOULDER + length + TAIL * landing
    return Overturning(landing, rate, advance, length, life + rate * crest.rest)
