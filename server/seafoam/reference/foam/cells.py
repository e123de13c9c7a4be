"""Section 5: the mask with another rotation and offset in each cell of a triangular lattice."""

import math
from dataclasses import dataclass

import numpy as np

from seafoam.reference.noise import chained, number
from seafoam.reference.types import Floats, Pair, Vec2, smoothstep
from seafoam.scene import Foam

COUNT = 4096
LEAST = 0.25  # barycentric weight below which a cell has no influence
LAST = 1.0 / 256.0  # uncovered share below which the power is replaced by a ramp to 0


@dataclass(frozen=True, eq=False)
class Corner:
    """One of the three cells around each of r places."""

    weight: Floats  # (r,); the weights of the three cells sum to 1
    u: Floats  # mask coordinates, in tiles; (r,) each
    v: Floats
    cosine: Floats  # of the cell's rotation; (r,) each
    sine: Floats

    def turned(self, foot: Floats) -> Floats:
        """Footprints (r, 2) in tiles, rotated with the cell; (r, 2)."""
        x, y = foot[:, 0], foot[:, 1]
        return np.stack((self.cosine * x + self.sine * y, self.cosine * y - self.sine * x), axis=-1)


def corners(u: Floats, v: Floats, blended: bool) -> list[Corner]:
    """The three cells around (u, v), in tiles from the world's origin, rotated as the mask is.

    Not ``blended``: the nearest cell has the whole weight.
    """
    a, b = u - v / math.sqrt(3.0), 2.0 / math.sqrt(3.0) * v
    i, j = np.floor(a), np.floor(b)
    s, t = a - i, b - j
    upper = s + t > 1.0
    shares = np.where(upper, (s + t - 1.0, 1.0 - t, 1.0 - s), (1.0 - s - t, s, t))
    if blended:
        weights = np.maximum(shares - LEAST, 0.0) ** 4
    else:
        weights = (np.argmax(shares, axis=0) == np.arange(3)[:, None]).astype(np.float64)
    both = upper.astype(np.float64)
    offsets: tuple[tuple[Floats | float, Floats | float], ...] = ((both, both), (1.0, 0.0), (0.0, 1.0))
    around = []
    for weight, (di, dj) in zip(weights / weights.sum(axis=0), offsets, strict=True):
        word = chained(0, i + di, j + dj, period=COUNT)
        angle = 2.0 * math.pi * number(word, 0)
        cosine, sine = -np.cos(angle), -np.sin(angle)
        x, y = (s - di) + 0.5 * (t - dj), 0.5 * math.sqrt(3.0) * (t - dj)
        place = cosine * x + sine * y + number(word, 1), cosine * y - sine * x + number(word, 2)
        around.append(Corner(weight, *place, cosine, sine))
    return around


def part(s: Floats, weight: Floats) -> Floats:
    """Coverage of a cell of weight w for a saturation s in [0, 1]: 1 − (1 − s)^w, with a ramp to 1 at s = 1; (r,)."""
    left = 1.0 - np.clip(s, 0.0, 1.0)
    return 1.0 - np.maximum(left, LAST) ** weight * smoothstep(0.0, LAST, left)


def counted(x: Floats, z: Floats, foam: Foam, origin: Vec2) -> Pair:
    """Rotated coordinates of (x, z), m from the origin, in tiles from the world's origin; (r,) each.

    Whole periods of the lattice, 4096 cells along each side, are subtracted.
    """
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    far_u = (origin[0] * cosine + origin[1] * sine) / foam.mask_tile
    far_v = (origin[1] * cosine - origin[0] * sine) / foam.mask_tile
    rows = math.floor(far_v / (COUNT * math.sqrt(3.0) / 2.0))
    far_v -= rows * COUNT * math.sqrt(3.0) / 2.0
    far_u = math.fmod(far_u - rows * COUNT / 2.0, COUNT)
    u = (x * cosine + z * sine) / foam.mask_tile + far_u
    v = (z * cosine - x * sine) / foam.mask_tile + far_v
    return u, v
