"""The section of a plunging crest as a curve, in closed form. docs/formulae.md, section 17.

Lengths in the crest's heights, x along its travel, z up. Five pieces, in order from the back: the back, the top of the
jet, its underside, the face of the barrel, the trough before it. The curve and its tangent are continuous, but for the
jet's tip, which is a cusp.
"""

import math
from dataclasses import dataclass

import numpy as np

from seafoam.ocean.arrays import Floats
from seafoam.ocean.waves.plunging import (
    ASPECT,
    BORE,
    FOREMOST,
    HALF_HEIGHT,
    HALF_WIDTH,
    LENGTH,
    LONG,
    THROW,
    TILT,
    VERTICAL,
    XX,
    XZ,
    ZZ,
)

FRONT = 1.5
"""Where the curve ends in the trough."""
SLOPE = 8.0 / (3.0 * math.sqrt(3.0) * LENGTH)
"""Greatest slope of the back."""
_COS, _SIN = math.cos(TILT), math.sin(TILT)


@dataclass(frozen=True, eq=False)
class Curve:
    """Points of a section from the back's foot to the trough, (n, 2), and unit normals out of the water, (n, 2)."""

    points: Floats
    normals: Floats


@dataclass(frozen=True)
class PlungingSection:
    """The section at a phase of overturning: 0 at the first vertical face, 1 where the jet lands.

    Raises ``ValueError`` for a phase outside [0, 1].
    """

    phase: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.phase <= 1.0:
            raise ValueError("phase: must be in [0, 1]")

    @property
    def tip(self) -> tuple[float, float]:
        """The jet's tip, which falls freely: the square of the phase is proportional to the way down."""
        return THROW * self.phase, 1.0 - self.phase**2

    @property
    def hindmost(self) -> float:
        """x of the face where it is vertical."""
        return -BORE * self.phase

    @property
    def centre(self) -> tuple[float, float]:
        """Of the ellipse, which touches the trough's level."""
        return self.hindmost + HALF_WIDTH, HALF_HEIGHT

    @property
    def toe(self) -> float:
        """x where the face is level with the trough: of the ellipse's lowest point."""
        return self.centre[0] + XZ / XX * HALF_HEIGHT

    def curve(self, count: int) -> Curve:
        """Return the section with ``count`` points, at least 2, on each of its five pieces."""
        (c_x, c_z), (tip, _), behind = self.centre, self.tip, self.hindmost
        back = np.linspace(-LENGTH, 0.0, count)
        jet = np.linspace(0.0, tip, count)
        pieces = [(x, _top(x), np.ones(count), _top_slope(x)) for x in (back, jet)]
        turn, thick = np.linspace(0.5 * math.pi, 0.0, count), float(_top(np.float64(behind))) - VERTICAL
        width = tip - behind
        x = behind + width * (1.0 - np.cos(turn))
        dx = -width * np.sin(turn)
        z = _top(x) - thick * (1.0 - np.sin(turn))
        pieces.append((x, z, dx, dx * _top_slope(x) - thick * np.cos(turn)))
        # The angle about the ellipse's own axes, from its hindmost point to its lowest.
        ends = [math.atan2(ASPECT * (_SIN * p + _COS * q), _COS * p - _SIN * q) for p, q in _touching()]
        angle = np.linspace(ends[0] % math.tau, ends[1] % math.tau, count)
        u, n = LONG * np.cos(angle), LONG / ASPECT * np.sin(angle)
        du, dn = -LONG * np.sin(angle), LONG / ASPECT * np.cos(angle)
        x, z = c_x + _COS * u + _SIN * n, c_z - _SIN * u + _COS * n
        pieces.append((x, z, _COS * du + _SIN * dn, _COS * dn - _SIN * du))
        level = np.linspace(self.toe, FRONT, count)
        pieces.append((level, 0.0 * level, 1.0 + 0.0 * level, 0.0 * level))
        x, z, dx, dz = (np.concatenate(part) for part in zip(*pieces, strict=True))
        speed = np.maximum(np.hypot(dx, dz), 1e-300)
        return Curve(np.stack((x, z), axis=-1), np.stack((-dz / speed, dx / speed), axis=-1))


def _touching() -> tuple[tuple[float, float], tuple[float, float]]:
    """Hindmost and lowest point of the ellipse from its centre."""
    return (-HALF_WIDTH, XZ / ZZ * HALF_WIDTH), (XZ / XX * HALF_HEIGHT, -HALF_HEIGHT)


def _top(x: Floats | np.float64) -> Floats:
    """Height of the back, and before the crest of the jet's top."""
    back = np.maximum(1.0 - (np.minimum(x, 0.0) / LENGTH) ** 2, 0.0) ** 2
    return np.asarray(back - (1.0 - FOREMOST) * np.maximum(x, 0.0) ** 2, np.float64)


def _top_slope(x: Floats) -> Floats:
    behind = np.minimum(x, 0.0)
    back = -4.0 * behind / LENGTH**2 * np.maximum(1.0 - (behind / LENGTH) ** 2, 0.0)
    return np.asarray(back - 2.0 * (1.0 - FOREMOST) * np.maximum(x, 0.0), np.float64)
