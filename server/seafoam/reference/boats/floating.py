"""Section 15: boats: their shapes as inequalities, their colours and courses, and how they float."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.reference.types import Floats, Pair, Vec2, Vec3, dot
from seafoam.scene import Boat

BOW, QUARTER, BEAM, STEM, DRAUGHT = 0.36, 0.3, 0.1, 0.42, 0.08
RADON = math.sqrt(2.0 / 3.0)
UP = np.array([0.0, 1.0, 0.0])
HULL_SPEED = 1.25
Height = Callable[[Floats, Floats], Floats]  # heights at (x, z), m from the origin


@dataclass(frozen=True)
class Inequality:
    """xᵀMx + 2l·x + c ≤ 0, M diagonal with entries of at least 0."""

    m: Floats
    linear: Floats
    c: float

    def gradient(self, x: Floats) -> Floats:
        return 2.0 * (self.m * x + self.linear)


def plane(n: Vec3, c: float) -> Inequality:
    """n·x ≤ c."""
    return Inequality(np.zeros(3), 0.5 * np.array(n), -c)


@dataclass(frozen=True)
class Form:
    """A hull: half breadth amidships, height of the greatest breadth, keel's depth, sheer and its rise."""

    beam: float
    widest: float
    flare: float
    sheer: float
    rise: float

    @property
    def fine(self) -> float:
        """Coefficient with which the sides meet 0.62 lengths ahead of the middle, at the height of the greatest
        breadth."""
        return self.beam / 0.62**2

    def sheer_at(self, x: Floats) -> Floats:
        return self.sheer + self.rise * (x + 0.15) ** 2

    def sides(self) -> tuple[Inequality, ...]:
        """±z ≤ beam − fine (x + 0.12)² − flare (y − widest)², and the transom."""
        a, f = self.fine, self.flare
        c = a * 0.12**2 + f * self.widest**2 - self.beam
        both = tuple(
            Inequality(np.array([a, f, 0.0]), np.array([a * 0.12, -f * self.widest, 0.5 * side]), c)
            for side in (-1.0, 1.0)
        )
        return (plane((-1.0, -0.2, 0.0), 0.45), *both)

    def above(self) -> Inequality:
        """y ≥ sheer."""
        r = self.rise
        return Inequality(np.array([r, 0.0, 0.0]), np.array([0.15 * r, -0.5, 0.0]), r * 0.15**2 + self.sheer)


FORMS = {"sail": Form(0.15, 0.1, 4.63, 0.085, 0.1065), "motor": Form(0.17, 0.15, 2.515, 0.12, 0.26)}


@dataclass(frozen=True)
class Pose:
    """A boat as it floats: the middle of its water line, and its axes."""

    boat: Boat
    place: Floats
    ahead: Floats
    up: Floats
    right: Floats

    def inward(self, v: Floats) -> Floats:
        """Components along the boat's axes; (r, 3)."""
        return np.stack((dot(v, self.ahead), dot(v, self.up), dot(v, self.right)), axis=-1)

    def outward(self, v: Floats) -> Floats:
        """A direction given along the boat's axes; (r, 3)."""
        return v[:, :1] * self.ahead + v[:, 1:2] * self.up + v[:, 2:] * self.right


def house(
    aft: float, ahead: float, foot: float, half: float, roof: float, lean: float, rake: float
) -> tuple[Inequality, ...]:
    return (
        plane((0.0, 1.0, 0.0), roof),
        plane((0.0, -1.0, 0.0), -foot),
        plane((-1.0, 0.0, 0.0), -aft),
        plane((1.0, rake, 0.0), ahead + rake * foot),
        plane((0.0, lean, 1.0), half + lean * foot),
        plane((0.0, lean, -1.0), half + lean * foot),
    )


def paint(pose: Pose, place: Floats, n: Floats, part: Floats) -> Pair:
    """Reflectance (r, 3) and gloss (r,) of places in the boat's lengths and axes."""
    motor = pose.boat.kind == "motor"
    form = FORMS[pose.boat.kind]
    x, y, z = place.T
    strip = (y < 0.012) | (form.sheer_at(x) - y < 0.013)
    hull = np.where(strip[:, None], np.array([0.75, 0.74, 0.7]), np.array(pose.boat.hull))
    hull = np.where((y < 0.0)[:, None], np.array([0.16, 0.03, 0.02]), hull)
    if motor:
        pillar = (np.abs(np.abs(z) - 0.028) < 0.004) | (np.abs(x - 0.06) < 0.006)
        pillar |= (np.abs(z) > 0.062) & ((x > 0.12) | (x < -0.012))
        glass = (y > 0.25) & (y < 0.315) & (x > -0.017) & ~pillar & (n[:, 1] < 0.5)
    else:
        turn = 11.0 * x
        glass = (y > 0.1) & (y < 0.122) & (np.abs(turn - np.floor(turn) - 0.5) < 0.3)
        glass &= (x > -0.16) & (x < 0.11) & (n[:, 1] < 0.7)
    wall = np.array(pose.boat.sails if motor else (0.72, 0.71, 0.68))
    house = np.where(glass[:, None], np.array([0.012, 0.014, 0.016]), wall)
    choices: tuple[tuple[Floats, Floats | float], ...] = (
        (hull, 0.5),
        (np.array([0.16, 0.19, 0.17] if motor else [0.42, 0.3, 0.17]), 0.1),
        (house, np.where(glass, 1.0, 0.3)),
        (np.array([0.55, 0.2, 0.05] if motor else [0.5, 0.5, 0.48]), 0.3),
        (np.array(pose.boat.sails), 0.0),
    )
    albedo, gloss = np.zeros_like(place), np.zeros(place.shape[0])
    for kind, (colour, shine) in enumerate(choices):
        here = part == kind
        albedo[here] = np.broadcast_to(colour, place.shape)[here]
        gloss[here] = np.broadcast_to(shine, gloss.shape)[here]
    return albedo, gloss


@dataclass(frozen=True)
class Course:
    """Position on a course: vector from its centre to the origin (m), bearing (rad), and sense of rotation."""

    centre: Vec2
    bearing: float
    turn: float
    radius: float

    @property
    def place(self) -> Vec2:
        return (
            self.radius * math.cos(self.bearing) - self.centre[0],
            self.radius * math.sin(self.bearing) - self.centre[1],
        )

    @property
    def heading(self) -> Vec2:
        return -self.turn * math.sin(self.bearing), self.turn * math.cos(self.bearing)


def course_of(boat: Boat, time: float, origin: Vec2) -> Course:
    """The course at a time, with the bearing reduced exactly, its rate taken as a float64 number."""
    turn = 1.0 if boat.turn == "starboard" else -1.0
    angle = Fraction(boat.bearing) + Fraction(turn * boat.speed / boat.radius) * Fraction(time)
    around = Fraction(2.0 * math.pi)
    return Course((origin[0] - boat.centre[0], origin[1] - boat.centre[1]), float(angle % around), turn, boat.radius)


def hull_points(boat: Boat, course: Course) -> tuple[Vec2, ...]:
    """Bow, port and starboard quarter, m from the origin."""
    (x, z), (a, b), size = course.place, course.heading, boat.length
    return (
        (x + BOW * size * a, z + BOW * size * b),
        (x - size * (QUARTER * a - BEAM * b), z - size * (QUARTER * b + BEAM * a)),
        (x - size * (QUARTER * a + BEAM * b), z - size * (QUARTER * b - BEAM * a)),
    )


def mean_height(height: Height, place: Vec2, reach: float) -> float:
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
