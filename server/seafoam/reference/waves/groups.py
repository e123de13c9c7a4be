"""Section 2: groups of high waves, a factor of the heights of parametric waves."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from seafoam.ocean.groups import AMPLITUDE, TEXELS, group_side, group_velocity, group_waves
from seafoam.reference.types import Floats
from seafoam.scene.models import Scene


@dataclass(frozen=True, eq=False)
class GroupFactor:
    """The factor at one time around one origin."""

    field: Floats
    """(n, ∂n/∂x, ∂n/∂z) at the corners of a period, rows along z; (TEXELS, TEXELS, 3), derivatives in 1/m."""
    side: float
    """Length of the period, m."""
    contrast: float
    velocity: tuple[float, float]
    """(x, z) m/s."""
    place: tuple[float, float]
    """The origin in the period, in periods."""

    def __call__(self, x: Floats, z: Floats, ago: Floats | float = 0.0) -> Floats:
        """Factor at (x, z), m from the origin, ``ago`` s before; in [1 − contrast, 1]."""
        n = self._at(x + self.velocity[0] * ago, z + self.velocity[1] * ago)[..., 0]
        result: Floats = 1.0 - 0.5 * self.contrast * (1.0 - n)
        return result

    def gradient(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """Its derivatives, 1/m."""
        values = self._at(x, z)
        return 0.5 * self.contrast * values[..., 1], 0.5 * self.contrast * values[..., 2]

    @property
    def slope(self) -> float:
        """Greatest derivative of the factor along any line, 1/m, read or between corners, rounded up."""
        step = self.side / TEXELS
        values = self.field[..., 0]
        between = [float(np.abs(values - np.roll(values, 1, axis)).max()) / step for axis in (0, 1)]
        read = float(np.hypot(self.field[..., 1], self.field[..., 2]).max())
        return 0.5 * self.contrast * 1.001 * max(read, math.hypot(*between))

    @property
    def curvature(self) -> float:
        """Greatest change of the slope over a texel, 1/m²: bilinear values have kinks at its edges."""
        values, worst, step = self.field[..., 0], 0.0, self.side / TEXELS
        for axis in (0, 1):
            bend = np.roll(values, 1, axis) - 2.0 * values + np.roll(values, -1, axis)
            worst += 2.0 * float(np.abs(bend).max()) / (step * step)
        return 0.5 * self.contrast * worst

    def _at(self, x: Floats, z: Floats) -> Floats:
        """The field, bilinear between corners."""
        u, v = (self.place[0] + x / self.side) * TEXELS, (self.place[1] + z / self.side) * TEXELS
        i, j = np.floor(u), np.floor(v)
        s, t = (u - i)[..., None], (v - j)[..., None]
        i0, j0 = i.astype(np.intp) % TEXELS, j.astype(np.intp) % TEXELS
        i1, j1 = (i0 + 1) % TEXELS, (j0 + 1) % TEXELS
        near = (1.0 - s) * self.field[j0, i0] + s * self.field[j0, i1]
        far = (1.0 - s) * self.field[j1, i0] + s * self.field[j1, i1]
        result: Floats = (1.0 - t) * near + t * far
        return result


def group_factor(scene: Scene, time: float, origin: tuple[float, float]) -> GroupFactor | None:
    """The factor of the scene's groups at a time (s) around an origin (x, z) in m; None without groups."""
    groups = scene.wave_groups
    if groups is None or groups.contrast == 0.0 or all(wave.amplitude == 0.0 for wave in scene.waves):
        return None
    side = group_side(groups)
    velocity = group_velocity(scene)
    place = tuple(
        float((Fraction(at) - Fraction(speed) * Fraction(time)) / Fraction(side) % 1)
        for at, speed in zip(origin, velocity, strict=True)
    )
    return GroupFactor(_field(groups.seed, side), side, groups.contrast, velocity, (place[0], place[1]))


@lru_cache(maxsize=8)
def _field(seed: int, side: float) -> Floats:
    """n = sin X and its derivatives (1/m) at the corners, X the sum of the cosines."""
    along: Floats = np.arange(TEXELS) / TEXELS
    total, by_x, by_z = (np.zeros((TEXELS, TEXELS)) for _ in range(3))
    for ix, iz, phase in group_waves(seed):
        angle = 2.0 * math.pi * (ix * along[None, :] + iz * along[:, None]) + phase
        total += AMPLITUDE * np.cos(angle)
        by_x -= 2.0 * math.pi * ix / side * AMPLITUDE * np.sin(angle)
        by_z -= 2.0 * math.pi * iz / side * AMPLITUDE * np.sin(angle)
    field: Floats = np.stack((np.sin(total), np.cos(total) * by_x, np.cos(total) * by_z), axis=-1)
    return field
