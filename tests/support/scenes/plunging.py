"""The section of a plunging crest, in closed form. docs/formulae.md, section 17.

Lengths in units of the wave's height, x along its travel, z up, both from the trough under the crest's first vertical
face. Five pieces, in order from the back: the back, the top of the jet, its underside, the face of the barrel, the
trough before it. The curve and its tangent are continuous, but for the jet's tip, which is a cusp.

The face is an arc of New's ellipse, of axes in the ratio √3 (New 1983, J. Fluid Mech. 130), which fits a part of the
loop alone (Greenhow 1983, J. Fluid Mech. 134); so it ends where it is vertical. The jet falls freely (Longuet-Higgins
1982, J. Fluid Mech. 121): what leaves the crest with one speed stands along one parabola.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.arrays import Floats
from seafoam.ocean.constants import GRAVITY

ASPECT = math.sqrt(3.0)
"""Long over short axis of the ellipse (New 1983)."""
LONG = 0.6
"""Its long semi-axis: the barrel is 0.85 high, and lower than the crest."""
TILT = math.radians(30.0)
"""Angle by which the long axis falls toward the front."""
THROW = 1.0
"""Way of the jet's tip ahead until it lands."""
BORE = 0.1
"""Way of the face back under the crest until then."""
LENGTH = 4.0
"""Of the back."""
FRONT = 1.5
"""Where the section ends in the trough."""
_COS, _SIN = math.cos(TILT), math.sin(TILT)
XX, XZ, ZZ = (
    _COS**2 + ASPECT**2 * _SIN**2,
    (ASPECT**2 - 1.0) * _COS * _SIN,
    _SIN**2 + ASPECT**2 * _COS**2,
)
"""Of the ellipse: XX x² + 2 XZ x z + ZZ z² is the square of the long semi-axis, x and z from the centre."""
HALF_WIDTH, HALF_HEIGHT = (LONG * math.sqrt(axis) / ASPECT for axis in (ZZ, XX))
VERTICAL = HALF_HEIGHT + XZ / ZZ * HALF_WIDTH
"""Height at which the face is vertical."""
LANDS = HALF_HEIGHT - XZ / ZZ * HALF_WIDTH
"""Height at which the tip lands: of the ellipse's foremost point."""
SLOPE = 8.0 / (3.0 * math.sqrt(3.0) * LENGTH)
"""Greatest slope of the back."""


def fall_time(height: float) -> float:
    """Return the time from the first vertical face until the tip of a wave ``height`` m high lands, s."""
    return math.sqrt(2.0 * (1.0 - LANDS) * height / GRAVITY)


def phase_at(along: Floats, time: float, peel: float, length: float) -> Floats:
    """Return the phases of overturning along a crest that peels, in [0, 1]; of the shape of ``along``.

    ``along``: places along the crest, m, toward what has not broken; ``peel``: speed of the first vertical face along
    it, m/s; ``length``: way from there to where the jet lands, m, over 0. Ahead of the first the phase is 0, behind the
    second 1.
    """
    return np.clip((peel * time - along) / length, 0.0, 1.0)


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
        return THROW * self.phase, 1.0 - (1.0 - LANDS) * self.phase**2

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

    def inside(self, x: Floats, z: Floats) -> NDArray[np.bool_]:
        """Whether points are in the water; of their shape."""
        (c_x, c_z), (tip, _), behind = self.centre, self.tip, self.hindmost
        z_c = np.minimum(z, VERTICAL) - c_z
        # Over the vertical place the face goes on straight up; rounding there must not make a root of less than 0.
        root = np.sqrt(np.maximum((XZ * z_c) ** 2 - XX * (ZZ * z_c**2 - LONG**2), 0.0))
        body = x <= c_x - (XZ * z_c + root) / XX
        width = max(tip - behind, 1e-12)
        left = np.clip(1.0 - (x - behind) / width, 0.0, 1.0)
        thick = (_top(np.float64(behind)) - VERTICAL) * (1.0 - np.sqrt(1.0 - left**2))
        jet = (x > behind) & (x <= tip) & (z >= _top(x) - thick)
        return (z <= 0.0) | ((z <= _top(x)) & (body | jet) & (x >= -LENGTH))

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
    return np.asarray(back - (1.0 - LANDS) * (np.maximum(x, 0.0) / THROW) ** 2, np.float64)


def _top_slope(x: Floats) -> Floats:
    behind = np.minimum(x, 0.0)
    back = -4.0 * behind / LENGTH**2 * np.maximum(1.0 - (behind / LENGTH) ** 2, 0.0)
    return np.asarray(back - 2.0 * (1.0 - LANDS) * np.maximum(x, 0.0) / THROW**2, np.float64)
