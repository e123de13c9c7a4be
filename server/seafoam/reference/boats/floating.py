"""Section 15: courses of boats, and how they float."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.reference.boats.form import BEAM, BOW, QUARTER, RADON, UP, Pose
from seafoam.reference.types import Floats
from seafoam.scene.boats import Boat

Height = Callable[[Floats, Floats], Floats]
"""Heights at (x, z), m from the origin."""

HULL_SPEED = 1.25


@dataclass(frozen=True)
class Course:
    """Position on a course: vector from its centre to the origin (m), bearing (rad), and sense of rotation."""

    centre: tuple[float, float]
    bearing: float
    turn: float
    radius: float

    @property
    def place(self) -> tuple[float, float]:
        return (
            self.radius * math.cos(self.bearing) - self.centre[0],
            self.radius * math.sin(self.bearing) - self.centre[1],
        )

    @property
    def heading(self) -> tuple[float, float]:
        return -self.turn * math.sin(self.bearing), self.turn * math.cos(self.bearing)


def course_of(boat: Boat, time: float, origin: tuple[float, float]) -> Course:
    """The course at a time, with the bearing reduced exactly, its rate taken as a float64 number."""
    turn = 1.0 if boat.turn == "starboard" else -1.0
    angle = Fraction(boat.bearing) + Fraction(turn * boat.speed / boat.radius) * Fraction(time)
    around = Fraction(2.0 * math.pi)
    return Course(
        (
            float(Fraction(origin[0]) - Fraction(boat.centre[0])),
            float(Fraction(origin[1]) - Fraction(boat.centre[1])),
        ),
        float(angle % around),
        turn,
        boat.radius,
    )


def hull_points(boat: Boat, course: Course) -> tuple[tuple[float, float], ...]:
    """Bow, port and starboard quarter, m from the origin."""
    (x, z), (a, b), size = course.place, course.heading, boat.length
    return (
        (x + BOW * size * a, z + BOW * size * b),
        (x - size * (QUARTER * a - BEAM * b), z - size * (QUARTER * b + BEAM * a)),
        (x - size * (QUARTER * a + BEAM * b), z - size * (QUARTER * b - BEAM * a)),
    )


def mean_height(height: Height, place: tuple[float, float], reach: float) -> float:
    """Mean height over a disc by Radon's seven points (degree 5)."""
    turns = np.arange(6) * (math.pi / 3.0)
    x = place[0] + RADON * reach * np.concatenate(([0.0], np.cos(turns)))
    z = place[1] + RADON * reach * np.concatenate(([0.0], np.sin(turns)))
    x[0], z[0] = place
    weights = np.array([0.25] + [0.125] * 6)
    return float(weights @ height(x, z))


def float_on(boat: Boat, course: Course, height: Height) -> Pose:
    """The boat on a surface: the plane of its water line passes through the mean heights at the hull points."""
    size = boat.length
    bow, port, starboard = (mean_height(height, place, boat.smoothing) for place in hull_points(boat, course))
    stern = 0.5 * (port + starboard)
    along = (bow - stern) / ((BOW + QUARTER) * size)
    across = (starboard - port) / (2.0 * BEAM * size)
    ahead = np.array([course.heading[0], 0.0, course.heading[1]])
    right = np.cross(ahead, UP)
    slope = along * ahead + across * right
    slope = slope / max(float(np.linalg.norm(slope)), 1.0)
    up = UP - slope
    up /= np.linalg.norm(up)
    ahead = ahead - (ahead @ up) * up
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, up)
    c, s = math.cos(boat.heel), math.sin(boat.heel)
    place = np.array([course.place[0], stern + along * QUARTER * size, course.place[1]])
    return Pose(boat, place, ahead, c * up + s * right, c * right - s * up)
