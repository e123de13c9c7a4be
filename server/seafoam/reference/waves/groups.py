"""Section 2: groups of high waves, a factor of the heights of parametric waves."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.waves.groups import PERIOD, group_cells, group_corners, group_velocity, in_groups
from seafoam.reference.types import Floats, smoothstep_slope
from seafoam.scene.models import Scene


@dataclass(frozen=True, eq=False)
class GroupFactor:
    """The factor at one time around one origin."""

    corners: Floats
    """Values of the noise at its corners, in [0, 1]; (PERIOD, PERIOD), rows along the second axis."""
    along: tuple[float, float]
    """Step of the noise along the way of the groups, (x, z) cells/m; the other is at right angles to it."""
    contrast: float
    velocity: tuple[float, float]
    """(x, z) m/s."""
    place: tuple[float, float]
    """The origin in the noise, cells."""

    def __call__(self, x: Floats, z: Floats, ago: Floats | float = 0.0) -> Floats:
        """Factor at (x, z), m from the origin, ``ago`` s before; in [1 − contrast, 1]."""
        noise = self._noise(x + self.velocity[0] * ago, z + self.velocity[1] * ago)[0]
        return 1.0 - self.contrast * (1.0 - noise)

    def gradient(self, x: Floats, z: Floats) -> Floats:
        """Its derivatives, (2, r) 1/m."""
        _, by_u, by_v = self._noise(x, z)
        k_x, k_z = self.along
        return self.contrast * np.stack((k_x * by_u - k_z * by_v, k_z * by_u + k_x * by_v))

    @property
    def slope(self) -> float:
        """Greatest derivative along any line, 1/m: that of smoothstep, ³⁄₂ a cell."""
        return 1.000001 * self.contrast * 1.5 * math.hypot(*self.along)

    @property
    def curvature(self) -> float:
        """Greatest second derivative along any line, 1/m²: that of smoothstep, 6 a cell²."""
        return self.contrast * 6.0 * math.hypot(*self.along) ** 2

    def _noise(self, x: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
        """Value noise and its derivatives per cell."""
        k_x, k_z = self.along
        u, v = self.place[0] + k_x * x + k_z * z, self.place[1] - k_z * x + k_x * z
        i, j = np.floor(u), np.floor(v)
        s, t = u - i, v - j
        column, row = np.mod(i, PERIOD).astype(np.int64), np.mod(j, PERIOD).astype(np.int64)
        right, down = (column + 1) % PERIOD, (row + 1) % PERIOD
        a, b, c, d = (self.corners[m, n] for m in (row, down) for n in (column, right))
        (s_in, s_rate), (t_in, t_rate) = smoothstep_slope(0.0, 1.0, s), smoothstep_slope(0.0, 1.0, t)
        top, bottom = a + (b - a) * s_in, c + (d - c) * s_in
        by_u = s_rate * ((b - a) * (1.0 - t_in) + (d - c) * t_in)
        return top + (bottom - top) * t_in, by_u, t_rate * (bottom - top)


def group_factor(scene: Scene, time: float, origin: tuple[float, float]) -> GroupFactor | None:
    """The factor of the scene's groups at a time (s) around an origin (x, z) in m; None without groups."""
    groups = scene.wave_groups
    if groups is None or not in_groups(scene):
        return None
    along, velocity = group_cells(scene, groups), group_velocity(scene)
    moved = [Fraction(start) - Fraction(speed) * Fraction(time) for start, speed in zip(origin, velocity, strict=True)]
    k_x, k_z = Fraction(along[0]), Fraction(along[1])
    place = (float((k_x * moved[0] + k_z * moved[1]) % PERIOD), float((k_x * moved[1] - k_z * moved[0]) % PERIOD))
    return GroupFactor(group_corners(groups.seed), along, groups.contrast, velocity, place)
