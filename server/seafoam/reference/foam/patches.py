"""Section 4: patches in which fronts foam more, and less."""

import math

import numpy as np

from seafoam.reference.noise import PERIOD, fractal
from seafoam.reference.types import Floats
from seafoam.reference.waves.parametric import reduced
from seafoam.scene.foam import FrontSaturation

OCTAVES, SEED, CHANGE = 3, 64 * 91, 25.0
"""Octaves of the noise, its seed, and the time in which it changes, s."""


class FrontPatches:
    """What is added to the sum of the waves, at a time (s) around an origin (x, z) in m; drifts by ``drift``, m/s."""

    def __init__(
        self, source: FrontSaturation, time: float, origin: tuple[float, float], drift: tuple[float, float]
    ) -> None:
        self.source = source
        turn, cells = 2.0 * math.pi / (PERIOD * source.variation_size), PERIOD / (2.0 * math.pi)
        self.place = (
            cells * reduced((turn, origin[0]), (-turn * drift[0], time)),
            cells * reduced((turn, origin[1]), (-turn * drift[1], time)),
            cells * reduced((2.0 * math.pi / (PERIOD * CHANGE), time)),
        )

    def __call__(self, x: Floats, z: Floats, footprints: tuple[Floats, Floats] | None) -> Floats:
        """At (x, z), filtered to footprints (each (r, 2) m) if there are any; (r,)."""
        size = self.source.variation_size
        width = np.zeros_like(x)
        if footprints is not None:
            width = np.maximum(*(np.hypot(side[:, 0], side[:, 1]) for side in footprints)) / size
        place = np.column_stack((x / size, z / size, np.zeros_like(x))) + self.place
        result: Floats = self.source.variation * fractal(place, width, OCTAVES, SEED)
        return result
