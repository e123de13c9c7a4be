"""The surface as a height field: the sum of everything that displaces it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from seafoam.reference.types import Floats


class ReliefPart(Protocol):
    """A part of the surface's height, at one time around one origin; heights in [trough, top] m."""

    @property
    def top(self) -> float:
        """Upper bound of the height, m."""

    @property
    def trough(self) -> float:
        """Lower bound of the height, m; at most 0."""

    @property
    def slope(self) -> float:
        """Greatest slope, rounded up."""

    @property
    def curvature(self) -> float:
        """Greatest second derivative along any line, rounded up, 1/m."""

    @property
    def shape(self) -> float:
        """Size of the finest feature, m."""

    def height(self, x: Floats, z: Floats) -> Floats:
        """Height at (x, z), m from the origin, shape (r,); (r,) m."""

    def gradient(self, x: Floats, z: Floats) -> Floats:
        """(h_x, h_z) at (x, z); (2, r)."""


@dataclass(frozen=True)
class Relief:
    """The sum of parts, itself a part."""

    parts: tuple[ReliefPart, ...]

    @cached_property
    def raised(self) -> tuple[ReliefPart, ...]:
        """The parts that are not flat."""
        return tuple(part for part in self.parts if part.top > 0.0)

    @cached_property
    def top(self) -> float:
        return sum(part.top for part in self.raised)

    @cached_property
    def trough(self) -> float:
        return sum(part.trough for part in self.raised)

    @cached_property
    def slope(self) -> float:
        return sum(part.slope for part in self.raised)

    @cached_property
    def curvature(self) -> float:
        return sum(part.curvature for part in self.raised)

    @cached_property
    def shape(self) -> float:
        return min((part.shape for part in self.raised), default=float("inf"))

    def height(self, x: Floats, z: Floats) -> Floats:
        return sum((part.height(x, z) for part in self.raised), np.zeros_like(x))

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return sum((part.gradient(x, z) for part in self.raised), np.zeros((2, x.size)))
