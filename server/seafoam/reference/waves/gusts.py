"""Section 9: gusts, which vary the ripples' amplitude over the water."""

import math

import numpy as np

from seafoam.reference.noise import PERIOD, fractal
from seafoam.reference.types import Floats
from seafoam.reference.waves.parametric import reduced
from seafoam.scene.water import Chop

OCTAVES = 3


class GustField:
    """Factor on the ripples' amplitude at one time (s) around one origin (x, z) in m; 1 without gusts."""

    def __init__(self, chop: Chop | None, time: float, origin: tuple[float, float]) -> None:
        self.gusts = None if chop is None else chop.gusts
        if chop is None or self.gusts is None:
            return
        gusts = self.gusts
        turn = 2.0 * math.pi / (PERIOD * gusts.size)
        speed = (gusts.speed * math.cos(chop.wind_direction), gusts.speed * math.sin(chop.wind_direction))
        cells = PERIOD / (2.0 * math.pi)
        self.place = (
            cells * reduced((turn, origin[0]), (-turn * speed[0], time)),
            cells * reduced((turn, origin[1]), (-turn * speed[1], time)),
            cells * reduced((2.0 * math.pi / (PERIOD * gusts.change), time)),
        )

    def __call__(self, x: Floats, z: Floats) -> Floats:
        """The factor at (x, z); (r,), in [0, 2]."""
        if self.gusts is None:
            return np.ones_like(x)
        place = np.column_stack((x / self.gusts.size, z / self.gusts.size, np.zeros_like(x))) + self.place
        noise = fractal(place, np.zeros_like(x), OCTAVES, 64 * self.gusts.seed)
        result: Floats = 1.0 + self.gusts.strength * np.clip(0.8 * noise, -1.0, 1.0)
        return result
