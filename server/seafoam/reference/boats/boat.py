"""Section 15: boats in float64: how they float, their intersections with rays, and their light.

A solid is the set that satisfies several convex inequalities q(x) = xᵀMx + 2l·x + c ≤ 0; a hull is such a solid minus
another above its sheer. A ray is inside a convex solid on one interval of its length.
"""

import math
from dataclasses import dataclass

import numpy as np

from seafoam.reference.boats import floating
from seafoam.reference.boats.floating import FORMS, Height, Inequality, house, plane
from seafoam.reference.light.light import Air, fresnel, sky_light
from seafoam.reference.types import Floats, Pair, Rows, Sunlight, Vec2, Vec3, dot, smoothstep, unit
from seafoam.scene import Boat, Scene

BOUNCED, THROUGH_SAIL, UNDER_SAIL = 0.1, 0.4, 0.25
"""Share of the light that arrives from below, and of the sun's that passes a sail and that its shadow has."""
HULL, DECK, HOUSE, SPAR, SAIL = range(5)


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
            return lambda x, z: np.maximum(height(x, z), ground(x, z) + floating.DRAUGHT * boat.length)

        courses = [(boat, floating.course_of(boat, time, origin)) for boat in scene.boats]
        self.poses = [floating.float_on(boat, course, support(boat)) for boat, course in courses]

    def trace(self, o: Floats, d: Floats, least: float = 0.0) -> Hit:
        """First hits of rays o + t d, o and d (r, 3), with t ≥ ``least`` m; t is infinite where there is none."""
        count = d.shape[0]
        nearest = Hit(
            np.full(count, np.inf), np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count), np.full(count, -1.0)
        )
        for number, pose in enumerate(self.poses):
            size = pose.boat.length
            middle = o + 0.0 * d - (pose.place + 0.4 * size * pose.up)
            along = -dot(middle, d)
            close = np.flatnonzero((dot(middle, middle) - along * along) <= (0.9 * size) ** 2)
            if close.size == 0:
                continue
            start = (np.broadcast_to(o, d.shape)[close] - pose.place) + along[close, None] * d[close]
            local, direction = pose.inward(start) / size, pose.inward(d[close])
            shift = along[close]
            traced = _Boat(local, direction, (least - shift) / size, pose.boat)
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
        """Radiance toward where rays come from, before haze; (r, 3), for rays that hit.

        ``open_sun``: what land and clouds leave.
        """
        result = np.zeros_like(d)
        for number, pose in enumerate(self.poses):
            rows = np.flatnonzero(hit.boat == number)
            if rows.size == 0:
                continue
            n, part = hit.normal[rows], hit.part[rows]
            albedo, gloss = floating.paint(pose, hit.place[rows], pose.inward(n), part)
            facing = dot(n, air.sun)
            share = np.maximum(facing, 0.0)
            sail = part == SAIL
            share[sail] += THROUGH_SAIL * np.maximum(-facing[sail], 0.0)
            lit = np.flatnonzero(share > 0.0)
            if lit.size:
                side = np.where(facing[lit] < 0.0, -1.0, 1.0)
                from_here = np.broadcast_to(o, d.shape)[rows][lit] + hit.t[rows][lit, None] * d[rows][lit]
                from_here = from_here + 3e-3 * pose.boat.length * side[:, None] * n[lit]
                share[lit] *= self.sunlight(from_here, air.sun)
                none = np.zeros((lit.size, 2))
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

    def _hull(self, form: floating.Form) -> None:
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
