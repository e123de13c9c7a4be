"""The surface as a height field: the sum of everything that displaces it."""

from collections.abc import Iterable
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


class Relief:
    """The sum of parts, itself a part."""

    def __init__(self, parts: Iterable[ReliefPart]) -> None:
        self.raised = tuple(part for part in parts if part.top > 0.0)
        """The parts that are not flat."""
        self.top = sum(part.top for part in self.raised)
        self.trough = sum(part.trough for part in self.raised)
        self.slope = sum(part.slope for part in self.raised)
        self.curvature = sum(part.curvature for part in self.raised)
        self.shape = min((part.shape for part in self.raised), default=float("inf"))

    def height(self, x: Floats, z: Floats) -> Floats:
        return sum((part.height(x, z) for part in self.raised), np.zeros_like(x))

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return sum((part.gradient(x, z) for part in self.raised), np.zeros((2, x.size)))
