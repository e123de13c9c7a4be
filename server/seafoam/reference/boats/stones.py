"""Section 16: standing waves behind stones, as wakes of hulls that move against the current as fast as it flows."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.waves.wakes import LEAST_SPEED, joint_height, joint_slope, stone_wakes
from seafoam.reference.boats.floating import HULL_SPEED
from seafoam.reference.boats.wake import Wakes, wake_patches
from seafoam.reference.noise import filtered_step, footprint_variance
from seafoam.reference.types import Floats, Footprints, Gradient
from seafoam.scene.foam import WakeSaturation
from seafoam.scene.water import Current, Stone


@dataclass(frozen=True)
class StoneSet(Wakes):
    """The standing waves of a current's stones."""

    current: Current
    origin: tuple[float, float]

    @property
    def _downstream(self) -> tuple[float, float]:
        return math.cos(self.current.direction), math.sin(self.current.direction)

    def along(self, i: int, x: Floats, z: Floats) -> tuple[Floats, Floats, Gradient, Gradient]:
        c, s = self._downstream
        behind, aside = self._from_middle(self.current.stones[i], x, z)
        return behind + self.current.stones[i].radius, aside, (c, s), (-s, c)

    def _from_middle(self, stone: Stone, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """How far places (x, z), m from the origin, are downstream of a stone's middle and to the right; (r,) m."""
        c, s = self._downstream
        from_x, from_z = (
            part + float(Fraction(a) - Fraction(b)) for part, a, b in zip((x, z), self.origin, stone.place, strict=True)
        )
        return c * from_x + s * from_z, c * from_z - s * from_x

    def foam(self, source: WakeSaturation, x: Floats, z: Floats, cap: float, footprints: Footprints | None) -> Floats:
        """f of the stones' foam at (x, z), m from the origin, averaged over footprints; (r,) in [0, cap]."""
        total = np.zeros_like(x)
        speed = self.current.speed
        if speed < LEAST_SPEED:
            return total
        c, s = self._downstream
        for stone in self.current.stones:
            r = stone.radius
            behind, aside = (distance / r for distance in self._from_middle(stone, x, z))
            on_x, on_z = ((c * behind - s * aside) / 4.0, (s * behind + c * aside) / 4.0)
            torn = wake_patches(on_x, on_z, 4.0 * r, footprints)
            v_x = footprint_variance((c, s), footprints) / r**2
            v_z = footprint_variance((-s, c), footprints) / r**2
            down = np.maximum(behind, 0.0)
            width = 0.9 + 0.2 * np.sqrt(down)
            band = filtered_step(-1.2 * width, -0.6 * width, aside, v_z)
            band -= filtered_step(0.6 * width, 1.2 * width, aside, v_z)
            band *= filtered_step(-0.7, 0.3, behind, v_x) * np.exp(-np.minimum(down * r / (source.life * speed), 80.0))
            wider = 1.0 + 2.0 * (v_x + v_z) / 0.25**2
            off = (np.hypot(behind, aside) - 1.0) / 0.25
            rim = np.exp(-np.minimum(off**2 / wider, 80.0)) / np.sqrt(wider)
            cushion = rim * (1.0 - filtered_step(-0.5, 0.5, behind, v_x))
            share = min(speed / (HULL_SPEED * math.sqrt(4.0 * r)), 1.0)
            total += share * source.amount * band * (0.3 + 0.9 * torn)
            total += share * source.bow * cushion * (0.3 + torn)
        return np.minimum(total, cap)


def stone_set(current: Current, origin: tuple[float, float]) -> StoneSet:
    """The standing waves of a current's stones around an origin (x, z) in m."""
    patterns = stone_wakes(current)
    return StoneSet(patterns, joint_height(patterns), joint_slope(patterns), current, origin)
