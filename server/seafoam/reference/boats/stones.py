"""Section 16: standing waves behind stones, as wakes of hulls that move against the current as fast as it flows."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.wakes import LEAST_SPEED, Wake, joint_height, joint_slope, stone_wakes
from seafoam.reference.boats.floating import HULL_SPEED
from seafoam.reference.boats.wake import WakeBounds, pattern, wake_patches
from seafoam.reference.foam.torn import Feet, spread, torn_step
from seafoam.reference.types import Floats
from seafoam.scene.current import Current, Stone
from seafoam.scene.foam import WakeSaturation


@dataclass(frozen=True)
class StoneSet(WakeBounds):
    """The standing waves of a current's stones, as a part of the surface around one origin."""

    current: Current
    wakes: tuple[Wake, ...]
    origin: tuple[float, float]
    top: float
    slope: float

    def along(self, stone: Stone, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """How far places (x, z), m from the origin, are downstream of a stone's middle and to the right; (r,) m."""
        c, s = math.cos(self.current.direction), math.sin(self.current.direction)
        from_x, from_z = (
            at + float(Fraction(a) - Fraction(b)) for at, a, b in zip((x, z), self.origin, stone.place, strict=True)
        )
        return c * from_x + s * from_z, c * from_z - s * from_x

    def height(self, x: Floats, z: Floats) -> Floats:
        total = np.zeros_like(x)
        for wake, stone in zip(self.wakes, self.current.stones, strict=True):
            behind, aside = self.along(stone, x, z)
            total += pattern(wake, behind + stone.radius, np.abs(aside))[0]
        return total

    def gradient(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        c, s = math.cos(self.current.direction), math.sin(self.current.direction)
        h_x, h_z = np.zeros_like(x), np.zeros_like(x)
        for wake, stone in zip(self.wakes, self.current.stones, strict=True):
            behind, aside = self.along(stone, x, z)
            _, rise, spread = pattern(wake, behind + stone.radius, np.abs(aside))
            spread = spread * np.where(aside < 0.0, -1.0, 1.0)
            h_x += c * rise - s * spread
            h_z += s * rise + c * spread
        return h_x, h_z

    def foam(self, source: WakeSaturation, x: Floats, z: Floats, cap: float, feet: Feet | None) -> Floats:
        """f of the stones' foam at (x, z), m from the origin, averaged over footprints; (r,) in [0, cap]."""
        total = np.zeros_like(x)
        speed = self.current.speed
        if speed < LEAST_SPEED:
            return total
        c, s = math.cos(self.current.direction), math.sin(self.current.direction)
        for stone in self.current.stones:
            r = stone.radius
            behind, aside = (way / r for way in self.along(stone, x, z))
            on_x, on_z = ((c * behind - s * aside) / 4.0, (s * behind + c * aside) / 4.0)
            patches = wake_patches(on_x, on_z, 4.0 * r, feet)
            v_x = np.zeros_like(x) if feet is None else spread((np.full_like(x, c), np.full_like(x, s)), feet) / r**2
            v_z = np.zeros_like(x) if feet is None else spread((np.full_like(x, -s), np.full_like(x, c)), feet) / r**2
            down = np.maximum(behind, 0.0)
            width = 0.9 + 0.2 * np.sqrt(down)
            band = torn_step(-1.2 * width, -0.6 * width, aside, v_z) - torn_step(0.6 * width, 1.2 * width, aside, v_z)
            band *= torn_step(-0.7, 0.3, behind, v_x) * np.exp(-np.minimum(down * r / (source.life * speed), 80.0))
            wider = 1.0 + 2.0 * (v_x + v_z) / 0.25**2
            off = (np.hypot(behind, aside) - 1.0) / 0.25
            rim = np.exp(-np.minimum(off**2 / wider, 80.0)) / np.sqrt(wider)
            cushion = rim * (1.0 - torn_step(-0.5, 0.5, behind, v_x))
            share = min(speed / (HULL_SPEED * math.sqrt(4.0 * r)), 1.0)
            total += share * source.amount * band * (0.3 + 0.9 * patches)
            total += share * source.bow * cushion * (0.3 + patches)
        return np.minimum(total, cap)


def stone_set(current: Current, origin: tuple[float, float]) -> StoneSet:
    """The standing waves of a current's stones around an origin (x, z) in m."""
    patterns = stone_wakes(current)
    return StoneSet(current, patterns, origin, joint_height(patterns), joint_slope(patterns))
