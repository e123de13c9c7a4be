"""Section 13: what a drop of spray is at its birth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from seafoam.reference.noise import pcg, share
from seafoam.reference.types import Bools, Floats, Indices

SHEET, MIST, DRIFT, COLUMN = 0.0, 1.0, 2.0, 3.0
"""Kinds of drops."""
Words = NDArray[np.uint64]
LOW = np.uint64(0xFFFFFFFF)


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

    def of(self, chosen: Bools | Indices) -> Drops:
        """A subset, in order."""
        return Drops(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))

    def joined(self, other: Drops) -> Drops:
        """These and others."""
        return Drops(
            *(np.concatenate((getattr(self, name), getattr(other, name))) for name in self.__dataclass_fields__)
        )


def number(word: Words, k: int | Indices) -> Floats:
    """The k-th random number in [0, 1) that goes with each word."""
    return share(pcg((word + np.asarray(k, np.uint64)) & LOW))


def none() -> Drops:
    """No drops."""
    empty = np.zeros(0)
    return Drops(np.zeros((0, 3)), np.zeros((0, 3)), empty, empty, empty, empty, empty, np.zeros(0, np.uint64))


def cycles(time: float, period: float) -> tuple[int, float]:
    """Number of whole periods since time 0, and the fraction of the current one."""
    passed = Fraction(time) / Fraction(period)
    whole = math.floor(passed)
    return whole, float(passed - whole)
