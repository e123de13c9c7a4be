"""Section 15: boats in float64: their shapes, colours and courses, how they float, where rays meet them, their light.

A solid is the set that satisfies several convex inequalities q(x) = xᵀMx + 2l·x + c ≤ 0; a hull is such a solid minus
another above its sheer. A ray is inside a convex solid on one interval of its length.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.reference.light.light import Air, fresnel, sky_light
from seafoam.reference.types import Floats, Pair, Rows, Sunlight, Vec2, Vec3, dot, smoothstep, unit
from seafoam.scene import Boat, Scene

BOW, QUARTER, BEAM, STEM, DRAUGHT = 0.36, 0.3, 0.1, 0.42, 0.08
RADON = math.sqrt(2.0 / 3.0)
UP = np.array([0.0, 1.0, 0.0])
HULL_SPEED = 1.25
Height = Callable[[Floats, Floats], Floats]  # heights at (x, z), m from the origin
BOUNCED, THROUGH_SAIL, UNDER_SAIL = 0.1, 0.4, 0.25
"""Share of the light that arrives from below, and of the sun's that passes a sail and that its shadow has."""
HULL, DECK, HOUSE, SPAR, SAIL = range(5)


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
        """Coefficient with which the sides meet 0.62 lengths ahead of the middle, where the breadth is greatest."""
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
    place: Vec2
    heading: Vec2


def course_of(boat: Boat, time: float, origin: Vec2) -> Course:
    """The course at a time, with the bearing reduced exactly, its rate taken as a float64 number."""
    turn = 1.0 if boat.turn == "starboard" else -1.0
    angle = Fraction(boat.bearing) + Fraction(turn * boat.speed / boat.radius) * Fraction(time)
    bearing, centre = float(angle % Fraction(2.0 * math.pi)), (origin[0] - boat.centre[0], origin[1] - boat.centre[1])
    c, s = math.cos(bearing), math.sin(bearing)
    place = boat.radius * c - centre[0], boat.radius * s - centre[1]
    return Course(centre, bearing, turn, boat.radius, place, (-turn * s, turn * c))


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


@dataclass
class Hit(Rows):
    """Nearest hits of r rays: distance, normal and position (in the boat's axes and lengths), part, and boat."""

    t: Floats
    normal: Floats
    place: Floats
    part: Floats
    boat: Floats


class Fleet:
    """The boats of a scene at one time, floating on a surface or, where that is too shallow, resting on the ground."""

    def __init__(self, scene: Scene, time: float, origin: Vec2, height: Height, ground: Height | None) -> None:
        def support(boat: Boat) -> Height:
            if ground is None:
                return height
            return lambda x, z: np.maximum(height(x, z), ground(x, z) + DRAUGHT * boat.length)

        courses = [(boat, course_of(boat, time, origin)) for boat in scene.boats]
        self.poses = [float_on(boat, course, support(boat)) for boat, course in courses]

    def trace(self, o: Floats, d: Floats) -> Hit:
        """First hits of rays o + t d, o and d (r, 3), with t ≥ 0; t is infinite where there is none."""
        count = d.shape[0]
        nearest = Hit(
            np.full(count, np.inf), np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count), np.full(count, -1.0)
        )
        for number, pose in enumerate(self.poses):
            size = pose.boat.length
            middle = o + 0.0 * d - (pose.place + 0.4 * size * pose.up)
            along = -dot(middle, d)
            close = np.flatnonzero((dot(middle, middle) - along * along) <= (0.9 * size) ** 2)
            start = (np.broadcast_to(o, d.shape)[close] - pose.place) + along[close, None] * d[close]
            local, direction = pose.inward(start) / size, pose.inward(d[close])
            shift = along[close]
            traced = _Boat(local, direction, -shift / size, pose.boat)
            t = traced.t * size + shift
            better = t < nearest.t[close]
            rows = close[better]
            nearest.t[rows] = t[better]
            nearest.normal[rows] = pose.outward(traced.normal[better])
            nearest.place[rows] = local[better] + traced.t[better, None] * direction[better]
            nearest.part[rows] = traced.part[better]
            nearest.boat[rows] = number
        return nearest

    def sunlight(self, place: Floats, sun: Floats) -> Floats:
        """Share of the sunlight that boats leave to places (r, 3), (r,): none under a hull, some through a sail."""
        hit = self.trace(place, np.repeat(sun[None, :], place.shape[0], axis=0))
        return np.where(np.isinf(hit.t), 1.0, np.where(hit.part == SAIL, UNDER_SAIL, 0.0))

    def light(self, air: Air, open_sun: Sunlight, o: Floats, d: Floats, hit: Hit) -> Floats:
        """Radiance (r, 3) toward where rays that hit come from, before haze. ``open_sun``: what else leaves."""
        result = np.zeros_like(d)
        for number, pose in enumerate(self.poses):
            rows = np.flatnonzero(hit.boat == number)
            n, part = hit.normal[rows], hit.part[rows]
            albedo, gloss = paint(pose, hit.place[rows], pose.inward(n), part)
            facing = dot(n, air.sun)
            share = np.maximum(facing, 0.0)
            sail = part == SAIL
            share[sail] += THROUGH_SAIL * np.maximum(-facing[sail], 0.0)
            lit = np.flatnonzero(share > 0.0)
            side, none = np.where(facing[lit] < 0.0, -1.0, 1.0), np.zeros((lit.size, 2))
            from_here = np.broadcast_to(o, d.shape)[rows][lit] + hit.t[rows][lit, None] * d[rows][lit]
            from_here = from_here + 3e-3 * pose.boat.length * side[:, None] * n[lit]
            share[lit] *= self.sunlight(from_here, air.sun)
            share[lit] *= open_sun(from_here, (none, none))
            bounced = BOUNCED * (air.sky_irradiance + air.sun_irradiance * max(float(air.sun[1]), 0.0))
            irradiance = air.sun_irradiance * share[:, None] + sky_light(air, n[:, 1])
            irradiance = irradiance + bounced * (0.5 - 0.5 * n[:, 1])[:, None]
            bare = albedo / math.pi * irradiance
            r = d[rows] - 2.0 * dot(d[rows], n)[:, None] * n
            seen = air.sky(np.stack((r[:, 0], np.abs(r[:, 1]), r[:, 2]), axis=-1))
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
            self._solid(house(-0.02, 0.15, 0.1, 0.085, 0.34, 0.0, -0.15), HOUSE)
            self._solid(house(-0.3, -0.1, 0.1, 0.07, 0.155, 0.3, 0.0), HOUSE)
            self._spar((0.02, 0.34, 0.0), (0.0, 1.0, 0.0), 0.3, 0.007)
            self._spar((-0.36, 0.1, 0.0), (0.0, 1.0, 0.0), 0.38, 0.009)
            self._spar((-0.36, 0.2, 0.0), (0.8 * c, 0.6, 0.8 * s), 0.3, 0.006)
            return
        self._solid(house(-0.2, 0.17, 0.08, 0.08, 0.14, 0.3, 1.2), HOUSE)
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
        # Outside the removed interval two parts remain: before it and after it.
        self._take(enter, np.minimum(leave, cut), gradient, HULL)
        inside = enter >= uncut
        self._take(np.where(inside, enter, np.inf), leave, gradient, HULL)
        late = np.where(inside | np.isinf(uncut), np.inf, uncut)
        at = self.o + np.where(np.isinf(late), 0.0, late)[:, None] * self.d
        self._take(late, leave, -form.above().gradient(at), DECK)

    def _spar(self, foot: Vec3, direction: Vec3, reach: float, radius: float) -> None:
        axis, base = np.array(direction), np.array(foot)
        from_foot = self.o - base
        a = self.d - dot(self.d, axis)[:, None] * axis
        b = from_foot - dot(from_foot, axis)[:, None] * axis
        first, last = _roots(dot(a, a), dot(a, b), dot(b, b) - radius * radius)
        x, y, z = direction
        ends = plane(direction, float(axis @ base) + reach), plane((-x, -y, -z), -float(axis @ base))
        enter, leave, gradient = self._interval(ends)
        around = (first > enter) & np.isfinite(first)
        gradient[around] = b[around] + first[around, None] * a[around]
        self._take(np.maximum(enter, first), np.minimum(leave, last), gradient, SPAR)

    def _sail(self, tack: Vec3, head: Vec3, clew: Vec3, roach: float) -> None:
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
        # The rounded leech ends where u or v is 1; far beyond, its product would hold again.
        met &= (u <= 1.0) & (v <= 1.0) & (u + v <= 1.0 + 4.0 * roach * u * v)
        belly = 0.5 * (2.0 * np.minimum(v / np.maximum(1.0 - u, 0.05), 1.0) - 0.8)
        normal = n / math.sqrt(square) + belly[:, None] * (foot / np.linalg.norm(foot))
        normal *= np.where(dot(normal, self.d) > 0.0, -1.0, 1.0)[:, None]
        self.t = np.where(met, t, self.t)
        self.normal[met] = unit(normal[met])
        self.part[met] = SAIL


def _roots(a: Floats, b: Floats, c: Floats) -> Pair:
    """The interval of t in which at² + 2bt + c ≤ 0, a ≥ 0; (∞, −∞) if it is empty."""
    straight, square = a < 1e-14, b * b - a * c
    q = -(b + np.where(b < 0.0, -1.0, 1.0) * np.sqrt(np.maximum(square, 0.0)))
    one, two = q / np.where(straight, 1.0, a), c / np.where(q == 0.0, 1.0, q)
    t = -0.5 * c / np.where(b == 0.0, 1.0, b)
    everywhere = straight & (b == 0.0) & (c <= 0.0)
    cases = [~straight & (square > 0.0), straight & (b < 0.0), straight & (b > 0.0), everywhere]
    first = np.select(cases, [np.minimum(one, two), t, np.full_like(t, -np.inf), np.full_like(t, -np.inf)], np.inf)
    last = np.select(cases, [np.maximum(one, two), np.full_like(t, np.inf), t, np.full_like(t, np.inf)], -np.inf)
    return first, last
