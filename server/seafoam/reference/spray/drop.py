"""Section 13: what a drop of spray is at its birth.

Births (:mod:`bursts`, :mod:`rocks`, :mod:`waters`) are no independent form: they repeat ``spray/births.glsl`` hash by
hash, so that a frame has the same drops as the picture that it judges. What judges births are their statistics and the
float64 surface on which they start (``tests/gpu/reference/test_spray.py``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.reference.noise import Words
from seafoam.reference.types import Bools, Floats, Indices

SHEET, MIST, DRIFT, COLUMN = 0.0, 1.0, 2.0, 3.0
"""Kinds of drops."""


@dataclass(frozen=True, eq=False)
class Drops:
    """Drops in the air, x and z of births relative to the camera; (n,) or (n, 3) each."""

    birth: Floats
    velocity: Floats
    age: Floats
    life: Floats
    radius: Floats
    strength: Floats
    kind: Floats
    word: Words

    def subset(self, chosen: Bools | Indices) -> Drops:
        """A subset, in order."""
        return Drops(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))


def joined(parts: list[Drops]) -> Drops:
    """All drops of the parts, in order."""
    fields = ([getattr(part, name) for part in parts] for name in Drops.__dataclass_fields__)
    return Drops(*map(np.concatenate, fields))


def none() -> Drops:
    """No drops."""
    empty = np.zeros(0)
    return Drops(np.zeros((0, 3)), np.zeros((0, 3)), empty, empty, empty, empty, empty, np.zeros(0, np.uint64))


def cycles(time: float, period: float) -> tuple[int, float]:
    """Number of whole periods since time 0, and the fraction of the current one."""
    passed = Fraction(time) / Fraction(period)
    whole = math.floor(passed)
    return whole, float(passed - whole)
