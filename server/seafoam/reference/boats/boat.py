"""Section 15: boats in float64: how they float, where rays meet them, their light, their wakes and their foam.

A solid is what several inequalities q(x) = xᵀMx + 2l·x + c ≤ 0 leave of space, each of them convex; a hull is such a
solid less another one, which stands over its sheer. A ray is in a convex solid for one interval of its length.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.wakes import Wake, wake_height, wake_slope, wakes
from seafoam.reference.foam.torn import Feet, spread, torn, torn_step
from seafoam.reference.light.light import Air, fresnel, sky_light
from seafoam.reference.noise import KEY, value
from seafoam.reference.types import Bools, Floats, dot, smoothstep, unit
from seafoam.scene.boats import Boat
from seafoam.scene.foam import WakeSaturation
from seafoam.scene.models import Scene

Height = Callable[[Floats, Floats], Floats]
"""Heights at places x, z from the origin."""

BOW, QUARTER, BEAM, STEM, DRAUGHT = 0.36, 0.3, 0.1, 0.42, 0.08
RADON = math.sqrt(2.0 / 3.0)
BOUNCED = 0.1
THROUGH_SAIL = 0.4
UNDER_SAIL = 0.25
HULL_SPEED = 1.25
HULL, DECK, HOUSE, SPAR, SAIL = range(5)

UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Inequality:
    """xᵀMx + 2l·x + c ≤ 0, M diagonal and not negative."""

    m: Floats
    linear: Floats
    c: float

    def gradient(self, x: Floats) -> Floats:
        result: Floats = 2.0 * (self.m * x + self.linear)
        return result


def plane(n: tuple[float, float, float], c: float) -> Inequality:
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
        """The sides meet 0.62 ahead of the middle at the height of the greatest breadth."""
        return self.beam / 0.62**2

    def sheer_at(self, x: Floats) -> Floats:
        result: Floats = self.sheer + self.rise * (x + 0.15) ** 2
        return result

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
    at: Floats
    ahead: Floats
    up: Floats
    right: Floats

    def inward(self, v: Floats) -> Floats:
        """Components along the boat's axes; (r, 3)."""
        return np.stack((dot(v, self.ahead), dot(v, self.up), dot(v, self.right)), axis=-1)

    def outward(self, v: Floats) -> Floats:
        """A direction given along the boat's axes; (r, 3)."""
        result: Floats = v[:, :1] * self.ahead + v[:, 1:2] * self.up + v[:, 2:] * self.right
        return result


@dataclass(frozen=True)
class Course:
    """Where a boat is: from the centre of its course to the origin, m, bearing, rad, and turn."""

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


def course(boat: Boat, time: float, origin: tuple[float, float]) -> Course:
    """Exact reduction: the bearing's rate is the number that float64 holds."""
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


def hull_points(boat: Boat, at: Course) -> tuple[tuple[float, float], ...]:
    """Bow, port and starboard quarter, m from the origin."""
    (x, z), (a, b), size = at.place, at.heading, boat.length
    return (
        (x + BOW * size * a, z + BOW * size * b),
        (x - size * (QUARTER * a - BEAM * b), z - size * (QUARTER * b + BEAM * a)),
        (x - size * (QUARTER * a + BEAM * b), z - size * (QUARTER * b - BEAM * a)),
    )


def felt(height: Height, place: tuple[float, float], reach: float) -> float:
    """Mean height over a disc by Radon's seven points (degree 5)."""
    turns = np.arange(6) * (math.pi / 3.0)
    x = place[0] + RADON * reach * np.concatenate(([0.0], np.cos(turns)))
    z = place[1] + RADON * reach * np.concatenate(([0.0], np.sin(turns)))
    x[0], z[0] = place
    weights = np.array([0.25] + [0.125] * 6)
    return float(weights @ height(x, z))


def float_on(boat: Boat, at: Course, height: Height) -> Pose:
    """The boat on a surface: its water line's plane goes through the heights felt at the hull points."""
    size = boat.length
    bow, port, starboard = (felt(height, place, boat.smoothing) for place in hull_points(boat, at))
    stern = 0.5 * (port + starboard)
    along = (bow - stern) / ((BOW + QUARTER) * size)
    across = (starboard - port) / (2.0 * BEAM * size)
    ahead = np.array([at.heading[0], 0.0, at.heading[1]])
    right = np.cross(ahead, UP)
    slope = along * ahead + across * right
    slope = slope / max(float(np.linalg.norm(slope)), 1.0)
    up = UP - slope
    up /= np.linalg.norm(up)
    ahead = ahead - (ahead @ up) * up
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, up)
    c, s = math.cos(boat.heel), math.sin(boat.heel)
    place = np.array([at.place[0], stern + along * QUARTER * size, at.place[1]])
    return Pose(boat, place, ahead, c * up + s * right, c * right - s * up)


@dataclass
class Hit:
    """Nearest hits of r rays so far: distance, normal and place in the boat's lengths and axes, part, and boat."""

    t: Floats
    normal: Floats
    place: Floats
    part: Floats
    boat: Floats


@dataclass(frozen=True)
class Fleet:
    """Every boat of a scene at one time, and the air it is seen in."""

    poses: tuple[Pose, ...]

    def trace(self, o: Floats, d: Floats, least: float = 0.0) -> Hit:
        """First hits of rays o + t d, o and d (r, 3), with t ≥ ``least`` m; t is infinite where there is none."""
        count = d.shape[0]
        nearest = Hit(
            np.full(count, np.inf), np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count), np.full(count, -1.0)
        )
        for number, pose in enumerate(self.poses):
            size = pose.boat.length
            middle = o + 0.0 * d - (pose.at + 0.4 * size * pose.up)
            along = -dot(middle, d)
            close = np.flatnonzero((dot(middle, middle) - along * along) <= (0.9 * size) ** 2)
            if close.size == 0:
                continue
            start = (np.broadcast_to(o, d.shape)[close] - pose.at) + along[close, None] * d[close]
            local, way = pose.inward(start) / size, pose.inward(d[close])
            shift = along[close]
            found = _Boat(local, way, (least - shift) / size, pose.boat)
            t = found.t * size + shift
            better = t < nearest.t[close]
            rows = close[better]
            nearest.t[rows] = t[better]
            nearest.normal[rows] = pose.outward(found.normal[better])
            nearest.place[rows] = local[better] + found.t[better, None] * way[better]
            nearest.part[rows] = found.part[better]
            nearest.boat[rows] = number
        return nearest

    def light(self, of: Air, o: Floats, d: Floats, hit: Hit) -> Floats:
        """Radiance toward where rays come from, before haze; (r, 3), for rays that hit."""
        result = np.zeros_like(d)
        for number, pose in enumerate(self.poses):
            rows = np.flatnonzero(hit.boat == number)
            if rows.size == 0:
                continue
            n, part = hit.normal[rows], hit.part[rows]
            albedo, gloss = _paint(pose, hit.place[rows], pose.inward(n), part)
            facing = dot(n, of.sun)
            share = np.maximum(facing, 0.0)
            sail = part == SAIL
            share[sail] += THROUGH_SAIL * np.maximum(-facing[sail], 0.0)
            lit = np.flatnonzero(share > 0.0)
            if lit.size:
                side = np.where(facing[lit] < 0.0, -1.0, 1.0)
                from_here = np.broadcast_to(o, d.shape)[rows][lit] + hit.t[rows][lit, None] * d[rows][lit]
                from_here = from_here + 3e-3 * pose.boat.length * side[:, None] * n[lit]
                other = self.trace(from_here, np.repeat(of.sun[None, :], lit.size, axis=0))
                share[lit] *= np.where(np.isinf(other.t), 1.0, np.where(other.part == SAIL, UNDER_SAIL, 0.0))
            bounced = BOUNCED * (of.sky_irradiance + of.sun_irradiance * max(float(of.sun[1]), 0.0))
            irradiance = of.sun_irradiance * share[:, None] + sky_light(of, n[:, 1])
            irradiance = irradiance + bounced * (0.5 - 0.5 * n[:, 1])[:, None]
            bare = albedo / math.pi * irradiance
            r = d[rows] - 2.0 * dot(d[rows], n)[:, None] * n
            seen = of.sky(np.stack((r[:, 0], np.abs(r[:, 1]), r[:, 2]), axis=-1))
            seen = seen * (UNDER_SAIL + (1.0 - UNDER_SAIL) * smoothstep(-0.1, 0.1, r[:, 1]))[:, None]
            mirror = gloss * fresnel(np.clip(-dot(n, d[rows]), 0.0, 1.0))
            result[rows] = bare + mirror[:, None] * (seen - bare)
        return result


class _Boat:
    """Nearest hit of rays in a boat's own lengths and axes, t ≥ least (r,)."""

    def __init__(self, o: Floats, d: Floats, least: Floats, boat: Boat) -> None:
        self.o, self.d, self.least = o, d, least
        self.t = np.full(o.shape[0], np.inf)
        self.normal = np.zeros_like(o)
        self.part = np.zeros(o.shape[0])
        form = FORMS[boat.kind]
        c, s = math.cos(boat.boom), math.sin(boat.boom)
        self._hull(form)
        if boat.kind == "motor":
            self._solid(_house(-0.02, 0.15, 0.1, 0.085, 0.34, 0.0, -0.15), HOUSE)
            self._solid(_house(-0.3, -0.1, 0.1, 0.07, 0.155, 0.3, 0.0), HOUSE)
            self._spar((0.02, 0.34, 0.0), (0.0, 1.0, 0.0), 0.3, 0.007)
            self._spar((-0.36, 0.1, 0.0), (0.0, 1.0, 0.0), 0.38, 0.009)
            self._spar((-0.36, 0.2, 0.0), (0.8 * c, 0.6, 0.8 * s), 0.3, 0.006)
            return
        self._solid(_house(-0.2, 0.17, 0.08, 0.08, 0.14, 0.3, 1.2), HOUSE)
        self._spar((0.07, 0.08, 0.0), (0.0, 1.0, 0.0), 1.06, 0.0075)
        self._spar((0.06, 0.19, 0.0), (-c, 0.0, s), 0.45, 0.007)
        self._sail((0.06, 0.2, 0.0), (0.06, 1.12, 0.0), (0.06 - 0.44 * c, 0.205, 0.44 * s), 0.16)
        self._sail((0.47, 0.14, 0.0), (0.085, 0.95, 0.0), (0.1, 0.18, 0.22 * s), -0.06)

    def _interval(self, walls: tuple[Inequality, ...]) -> tuple[Floats, Floats, Floats]:
        """Where rays are inside: entry, exit, and the gradient at entry."""
        enter, leave = np.full(self.t.shape, -1e30), np.full(self.t.shape, 1e30)
        gradient = np.zeros_like(self.o)
        for wall in walls:
            a = dot(self.d * wall.m, self.d)
            b = dot(self.d * wall.m, self.o) + dot(self.d, wall.linear)
            c = dot(self.o * wall.m, self.o) + 2.0 * dot(self.o, wall.linear) + wall.c
            first, last = _roots(a, b, c)
            later = first > enter
            enter = np.where(later, first, enter)
            later &= np.isfinite(first)
            at = self.o[later] + first[later, None] * self.d[later]
            gradient[later] = wall.gradient(at)
            leave = np.minimum(leave, last)
        return enter, leave, gradient

    def _take(self, start: Floats, end: Floats, gradient: Floats, part: int) -> None:
        """Solid from start to end along each ray."""
        t = np.maximum(start, self.least)
        met = (start < end) & (end > self.least) & (t < self.t)
        self.t = np.where(met, t, self.t)
        self.normal[met] = unit(gradient[met])
        self.part[met] = part

    def _solid(self, walls: tuple[Inequality, ...], part: int) -> None:
        self._take(*self._interval(walls), part)

    def _hull(self, form: Form) -> None:
        enter, leave, gradient = self._interval(form.sides())
        cut, uncut, _ = self._interval((form.above(),))
        none = ~(cut < uncut)
        cut, uncut = np.where(none, np.inf, cut), np.where(none, np.inf, uncut)
        # What is left is before the cut and after it.
        self._take(enter, np.minimum(leave, cut), gradient, HULL)
        inside = enter >= uncut
        self._take(np.where(inside, enter, np.inf), leave, gradient, HULL)
        late = np.where(inside | np.isinf(uncut), np.inf, uncut)
        at = self.o + np.where(np.isinf(late), 0.0, late)[:, None] * self.d
        self._take(late, leave, -form.above().gradient(at), DECK)

    def _spar(
        self, foot: tuple[float, float, float], way: tuple[float, float, float], reach: float, radius: float
    ) -> None:
        axis, base = np.array(way), np.array(foot)
        from_foot = self.o - base
        a = self.d - dot(self.d, axis)[:, None] * axis
        b = from_foot - dot(from_foot, axis)[:, None] * axis
        first, last = _roots(dot(a, a), dot(a, b), dot(b, b) - radius * radius)
        ends = plane(way, float(axis @ base) + reach), plane((-way[0], -way[1], -way[2]), -float(axis @ base))
        enter, leave, gradient = self._interval(ends)
        around = (first > enter) & np.isfinite(first)
        gradient[around] = b[around] + first[around, None] * a[around]
        self._take(np.maximum(enter, first), np.minimum(leave, last), gradient, SPAR)

    def _sail(
        self,
        tack: tuple[float, float, float],
        head: tuple[float, float, float],
        clew: tuple[float, float, float],
        roach: float,
    ) -> None:
        corner = np.array(tack)
        luff, foot = np.array(head) - corner, np.array(clew) - corner
        n = np.cross(luff, foot)
        rate = dot(self.d, n)
        flat = np.abs(rate) < 1e-12
        t = dot(corner - self.o, n) / np.where(flat, 1.0, rate)
        at = self.o + t[:, None] * self.d - corner
        square = float(n @ n)
        u, v = np.cross(at, foot) @ n / square, np.cross(luff, at) @ n / square
        met = ~flat & (t >= self.least) & (t < self.t) & (u >= 0.0) & (v >= 0.0)
        met &= u + v <= 1.0 + 4.0 * roach * u * v
        belly = 0.5 * (2.0 * np.minimum(v / np.maximum(1.0 - u, 0.05), 1.0) - 0.8)
        normal = n / math.sqrt(square) + belly[:, None] * (foot / np.linalg.norm(foot))
        normal *= np.where(dot(normal, self.d) > 0.0, -1.0, 1.0)[:, None]
        self.t = np.where(met, t, self.t)
        self.normal[met] = unit(normal[met])
        self.part[met] = SAIL


def _roots(a: Floats, b: Floats, c: Floats) -> tuple[Floats, Floats]:
    """Between which t at² + 2bt + c ≤ 0, a ≥ 0; an empty interval (∞, −∞) where nowhere."""
    first, last = np.full(a.shape, np.inf), np.full(a.shape, -np.inf)
    straight = a < 1e-14
    rate = np.where(b == 0.0, 1.0, b)
    t = -0.5 * c / rate
    first = np.where(straight & (b < 0.0), t, np.where(straight & (b > 0.0), -np.inf, first))
    last = np.where(straight & (b < 0.0), np.inf, np.where(straight & (b > 0.0), t, last))
    everywhere = straight & (b == 0.0) & (c <= 0.0)
    first, last = np.where(everywhere, -np.inf, first), np.where(everywhere, np.inf, last)
    square = b * b - a * c
    bent = ~straight & (square > 0.0)
    q = -(b + np.where(b < 0.0, -1.0, 1.0) * np.sqrt(np.maximum(square, 0.0)))
    one = q / np.where(straight, 1.0, a)
    two = c / np.where(q == 0.0, 1.0, q)
    first = np.where(bent, np.minimum(one, two), first)
    last = np.where(bent, np.maximum(one, two), last)
    return first, last


def _house(
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


def _paint(pose: Pose, at: Floats, n: Floats, part: Floats) -> tuple[Floats, Floats]:
    """Reflectance (r, 3) and gloss (r,) of places in the boat's lengths and axes."""
    motor = pose.boat.kind == "motor"
    form = FORMS[pose.boat.kind]
    x, y, z = at.T
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
    albedo, gloss = np.zeros_like(at), np.zeros(at.shape[0])
    for kind, (colour, shine) in enumerate(choices):
        here = part == kind
        albedo[here] = np.broadcast_to(colour, at.shape)[here]
        gloss[here] = np.broadcast_to(shine, gloss.shape)[here]
    return albedo, gloss


@dataclass(frozen=True)
class WakeSet:
    """The wakes of a scene's boats as a part of its surface."""

    wakes: tuple[Wake, ...]
    courses: tuple[Course, ...]
    top: float
    slope: float

    @property
    def trough(self) -> float:
        return -self.top

    @property
    def curvature(self) -> float:
        return self.slope * max((2.0 * wake.shortest for wake in self.wakes if wake.shows), default=0.0)

    @property
    def shape(self) -> float:
        return min((1.0 / wake.shortest for wake in self.wakes if wake.shows), default=math.inf)

    def height(self, x: Floats, z: Floats) -> Floats:
        total = np.zeros_like(x)
        for wake, at in zip(self.wakes, self.courses, strict=True):
            behind, aside, _, _ = along(wake.boat, at, x, z)
            total += pattern(wake, behind, np.abs(aside))[0]
        return total

    def gradient(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        h_x, h_z = np.zeros_like(x), np.zeros_like(x)
        for wake, at in zip(self.wakes, self.courses, strict=True):
            behind, aside, on_behind, on_aside = along(wake.boat, at, x, z)
            _, rise, spread = pattern(wake, behind, np.abs(aside))
            spread = spread * np.where(aside < 0.0, -1.0, 1.0)
            h_x += rise * on_behind[0] + spread * on_aside[0]
            h_z += rise * on_behind[1] + spread * on_aside[1]
        return h_x, h_z

    def foam(self, source: WakeSaturation, x: Floats, z: Floats, cap: float, feet: Feet | None) -> Floats:
        """f of the boats' foam at (x, z), m from the origin, averaged over footprints; (r,) in [0, cap]."""
        total = np.zeros_like(x)
        for wake, at in zip(self.wakes, self.courses, strict=True):
            boat = wake.boat
            if boat.speed < 0.5:
                continue
            size = boat.length
            behind, aside, on_behind, on_aside = along(boat, at, x, z)
            b, s = behind / size, np.abs(aside) / size
            past = np.maximum(b - 0.86, 0.0)
            on_x, on_z = (x + at.centre[0]) / size, (z + at.centre[1]) / size
            t_x, t_z = 0.8 * on_x - 0.6 * on_z, 0.6 * on_x + 0.8 * on_z
            noises = [
                (0.4, 0.31 * size, value(KEY, on_x / 0.31, on_z / 0.31)),
                (0.35, 0.11 * size, value(KEY, t_x / 0.11, t_z / 0.11)),
                (0.25, 0.037 * size, value(KEY, on_x / 0.037, on_z / 0.037)),
            ]
            if feet is None:
                patches = smoothstep(0.25, 0.72, np.sum([part * noise for part, _, noise in noises], axis=0))
            else:
                patches = torn_step(0.25, 0.72, *torn(noises, feet))
            width = 0.085 + 0.055 * np.sqrt(past)
            q = np.clip((s - 0.5 * width) / (0.65 * width), 0.0, 1.0)
            band = (1.0 - q * q * (3.0 - 2.0 * q)) * smoothstep(-0.06, 0.04, b - 0.86)
            age = np.exp(-np.minimum(past * size / (source.life * boat.speed), 80.0))
            run, ahead = np.minimum(b / 0.55, 1.0), np.maximum(b, 0.0)
            edge = 0.015 + 0.105 * run * (2.0 - run) + 0.16 * np.maximum(b - 0.55, 0.0)
            off = (s - edge) / (0.02 + 0.025 * ahead)
            thrown = smoothstep(-0.01, 0.06, b) * np.exp(-np.minimum(off * off + 1.3 * ahead, 80.0))
            if feet is not None:
                v_b, v_s = spread(on_behind, feet) / size**2, spread(on_aside, feet) / size**2
                band = torn_step(-1.15 * width, -0.5 * width, s, v_s) - torn_step(0.5 * width, 1.15 * width, s, v_s)
                band = band * torn_step(-0.06, 0.04, b - 0.86, v_b)
                wider = 1.0 + 2.0 * v_s / (0.02 + 0.025 * ahead) ** 2
                bell = np.exp(-np.minimum(off * off / wider + 1.3 * ahead, 80.0)) / np.sqrt(wider)
                thrown = torn_step(-0.01, 0.06, b, v_b) * bell
            share = min(boat.speed / (HULL_SPEED * math.sqrt(size)), 1.0) ** 2
            total += source.amount * band * age * (0.3 + 0.9 * patches) + source.bow * share * thrown * (0.3 + patches)
        return np.minimum(total, cap)


def along(
    boat: Boat, at: Course, x: Floats, z: Floats
) -> tuple[Floats, Floats, tuple[Floats, Floats], tuple[Floats, Floats]]:
    """How far places are behind the bow along the course and outside it, m, and the gradients of both."""
    from_x, from_z = x + at.centre[0], z + at.centre[1]
    out = np.hypot(from_x, from_z)
    far = np.maximum(out, 0.1 * at.radius)
    angle = at.turn * (at.bearing - np.arctan2(from_z, from_x))
    angle = np.mod(angle + 0.3, 2.0 * math.pi) - 0.3
    share = at.turn * at.radius / (far * far)
    return (
        at.radius * angle + STEM * boat.length,
        out - at.radius,
        (share * from_z, -share * from_x),
        (from_x / far, from_z / far),
    )


def pattern(wake: Wake, behind: Floats, aside: Floats) -> tuple[Floats, Floats, Floats]:
    """Height of a wake at places behind the bow and aside (≥ 0), m, and its slopes; (r,) each."""
    boat = wake.boat
    if not wake.shows:
        return np.zeros_like(behind), np.zeros_like(behind), np.zeros_like(behind)
    x = np.maximum(behind, 1e-3)
    q = aside / x
    inside: Bools = (behind > 0.0) & (8.0 * q * q < 1.0) & (behind < wake.length)
    q = np.where(inside, q, 0.0)
    root = np.sqrt(1.0 - 8.0 * q * q)
    root_q = -8.0 * q / np.maximum(root, 1e-6)
    size, end = boat.length, wake.length
    edge, edge_s = _step(0.0, 0.5, root * root)
    begin, begin_x = _step(0.0, 0.6 * size, behind)
    stop, stop_x = _step(0.5 * end, end, behind)
    side, side_z = _step(0.25 * boat.radius, 0.4 * boat.radius, aside)
    window = edge * begin * (1.0 - stop) * (1.0 - side) * inside
    window_q = edge_s * (-16.0 * q) * begin * (1.0 - stop) * (1.0 - side) * inside
    window_x = edge * (begin_x * (1.0 - stop) - begin * stop_x) * (1.0 - side) * inside
    window_z = -edge * begin * (1.0 - stop) * side_z * inside
    fall = np.where(inside, 1.0 / (1.0 + behind / wake.wavelength), 0.0)
    fall_x = -fall * fall / wake.wavelength
    height, rise, spread = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    steep = np.maximum(q, 1e-4)
    systems = (
        (2.0 * q / (1.0 + root), 2.0 / (1.0 + root) - 2.0 * q * root_q / (1.0 + root) ** 2, 0.5, 0.5),
        ((1.0 + root) / (4.0 * steep), root_q / (4.0 * steep) - (1.0 + root) / (4.0 * steep**2), 1.0, 1.0 / 3.0),
    )
    for t, t_q, share, power in systems:
        secant = np.sqrt(1.0 + t * t)
        # a = share A window(q, x, z) fall(x)^power cut(q), and its change with each.
        a = share * boat.wake * fall**power
        a_x, a_z, a_q = a * window_x, a * window_z, a * window_q
        a_x = a_x + share * boat.wake * power * np.where(fall > 0.0, fall, 1.0) ** (power - 1.0) * fall_x * window
        a = a * window
        k = wake.k * secant * secant
        short = np.exp(-np.minimum((k / wake.shortest) ** 2, 700.0))
        a_q = (a_q - a * 4.0 * k * wake.k * t * t_q / wake.shortest**2) * short
        a, a_x, a_z = a * short, a_x * short, a_z * short
        phase = wake.k * secant * (behind - aside * t)
        cosine, down = np.cos(phase), -a * np.sin(phase) * wake.k * secant
        height += a * cosine
        rise += down + (a_x - a_q * q / x) * cosine
        spread += -down * t + (a_z + a_q / x) * cosine
    return height, rise, spread


def _step(low: float, high: float, x: Floats) -> tuple[Floats, Floats]:
    """The smoothstep and its derivative."""
    u = np.clip((x - low) / (high - low), 0.0, 1.0)
    return u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / (high - low)


def wake_set(scene: Scene, time: float, origin: tuple[float, float]) -> WakeSet:
    """The wakes of a scene's boats at a time (s) around an origin (x, z) in m."""
    found = wakes(scene.boats)
    courses = tuple(course(boat, time, origin) for boat in scene.boats)
    return WakeSet(found, courses, wake_height(scene.boats), wake_slope(scene.boats))


def fleet(scene: Scene, time: float, origin: tuple[float, float], height: Height, ground: Height | None) -> Fleet:
    """The boats of a scene as they float on a surface, and where that is too shallow on the ground under it."""

    def carried(boat: Boat) -> Height:
        if ground is None:
            return height
        return lambda x, z: np.maximum(height(x, z), ground(x, z) + DRAUGHT * boat.length)

    return Fleet(tuple(float_on(boat, course(boat, time, origin), carried(boat)) for boat in scene.boats))
