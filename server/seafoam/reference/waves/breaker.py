"""Section 17: a plunging crest at one time around one origin: where rays meet it, its normals, what shows of it.

Places are (x, y, s): along the crest's travel from its first vertical face, up, and along the crest, in its heights.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves import plunging as of
from seafoam.reference.light.light import Air, Floor
from seafoam.reference.noise import perlin
from seafoam.reference.types import Floats, Indices, Pair, Rows, Vec2, dot, smoothstep, unit
from seafoam.scene import Breaker, Water

STEPS, HALVINGS = 128, 24
"""Intervals of a ray's way through the crest's box, and of the bisection in one of them."""
LEAST, STEP = 1e-3, 2e-3  # least divisor, and step of the differences for normals
TOP, FACE, UNDER, LUMPS, WHOLE = range(5)
JET = 1.0 - of.VERTICAL  # thickness where it leaves the crest
JOINT = of.LENGTH * math.sqrt(1.0 - math.sqrt(of.VERTICAL)) - JET
"""By how much the crest is thicker there."""


@dataclass
class CrestHit(Rows):
    """Where r rays meet the crest: distance (r,) m, place and normal (r, 3) along its axes, and which part of it."""

    t: Floats
    place: Floats
    normal: Floats
    part: Floats


class Section:
    """The crest's sections at places (n, 3); all numbers are (n,), in the crest's heights, x and y in the section's."""

    def __init__(self, front: float, form: of.Overturning, place: Floats) -> None:
        x, y, s = place.T
        ahead, self.land = s - front, np.maximum(front - s, 0.0) / form.landing
        taper = of.TAPER * form.length
        left = smoothstep(0.0, taper, s) * smoothstep(0.0, taper, form.length - s)
        left *= 1.0 - smoothstep(4.0, of.TAIL, self.land)
        shoulder, fallen = smoothstep(0.5, of.SHOULDER, ahead), smoothstep(1.6, 4.0, self.land)
        self.high = np.maximum(left * (1.0 - shoulder) * (1.0 - 0.55 * fallen), LEAST)
        self.lean, self.thrown = smoothstep(0.0, of.LEANING, ahead), left * smoothstep(0.9, 2.2, self.land)
        even, g = np.minimum(self.land, 1.0), of.GENTLE
        self.phase = (np.sqrt(even * even + g * g) - g) / (math.sqrt(1.0 + g * g) - g)
        self.tip, self.behind = of.THROW * self.phase, -of.BORE * self.phase
        self.x, self.y = x / self.high, y / self.high
        self.left = (self.tip - self.x) / np.maximum(self.tip - self.behind, LEAST)
        """Way to the jet's tip in shares of its width."""
        self.jet = self.top(self.behind) - of.VERTICAL
        # What the jet throws up where it has landed grows wide and covers what is left of the crest.
        past, wide = np.clip(self.land - 1.0, 0.0, 3.0), np.clip(self.land - 0.9, 0.0, 4.0)
        v, w = (x - 1.25 + 0.3 * past) / (0.6 + 0.5 * past), (x - 1.1) / (0.5 + 0.75 * wide)
        self.apron = self.thrown * np.maximum(1.0 - w * w, 0.0)
        self.lumps = of.APRON * smoothstep(0.0, 0.2, self.apron)
        most = 0.4 * self.thrown * np.maximum(1.0 - v * v, 0.0)
        rows = np.flatnonzero((most > 0.0) & (y <= 2.0 * most + self.lumps))
        at = np.stack((s, x + 0.6 * front), axis=-1)[rows] / of.LUMP
        noise = np.abs(perlin(at, of.SEED)[0]) + 0.45 * np.abs(perlin(2.3 * at, of.SEED + 1)[0])
        most[rows] *= np.minimum(0.7 + 1.2 * noise, 2.0)
        self.lumps += most

    def top(self, x: Floats) -> Floats:
        """Height of the back, and before a crest that has begun to overturn of the jet's top."""
        back = np.maximum(1.0 - (np.minimum(x, 0.0) / of.LENGTH) ** 2, 0.0) ** 2
        return np.asarray(back - (1.0 - of.FOREMOST) * np.where(self.land > 0.0, np.maximum(x, 0.0), 0.0) ** 2)

    @property
    def face(self) -> Floats:
        """x of the face: of the ellipse, straight up over its vertical place, and ahead where it leans."""
        z = np.clip(self.y, 0.0, of.VERTICAL) - of.HALF_HEIGHT
        root = np.sqrt(np.maximum(of.XX * of.LONG**2 - (of.ASPECT * z) ** 2, 0.0))
        lean = of.LEAN * np.sqrt(1.0 - np.sqrt(np.clip(self.y, 0.0, 1.0)))
        return self.behind + of.HALF_WIDTH - (of.XZ * z + root) / of.XX + self.lean * lean

    @property
    def gaps(self) -> Floats:
        """Ways out of what is under the top, behind the face, in the jet, thrown up, and of the whole; (5, n)."""
        top, face = self.high * (self.y - self.top(self.x)), self.high * (self.x - self.face)
        under = self.top(self.x) - self.jet * (1.0 - np.sqrt(1.0 - np.clip(self.left, 0.0, 1.0) ** 2)) - self.y
        jet, thrown = self.high * np.maximum(under, self.x - self.tip), self.high * self.y - self.lumps
        return np.stack((top, face, jet, thrown, np.minimum(np.maximum(top, np.minimum(face, jet)), thrown)))

    @property
    def forms(self) -> Floats:
        """What is 0 on each part, (4, n): gaps, but for the jet's underside a form that is nowhere steep."""
        gaps, down = self.gaps, 1.0 - (self.top(self.x) - self.y) / self.jet
        return np.stack((gaps[TOP], gaps[FACE], 1.0 - self.left**2 - down**2, gaps[LUMPS]))

    def chosen(self, part: Floats, *of_each: Floats | float) -> Floats:
        """What is of each place's part: top, face, underside, or thrown up; (n,)."""
        return np.choose(part.astype(np.intp), [np.broadcast_to(each, part.shape) for each in of_each])


@dataclass(frozen=True, eq=False)
class CrestLook:
    """What shows of the crest at r places. Water moves through it along its travel: up the face, and level on top."""

    axes: Floats
    height: float
    normal: Floats  # (r, 3) unit vectors
    along: Floats  # (r, 3) unit vectors, along the surface and against the water's way
    level: Pair  # (x, z), m from the origin, on level water from where the water has come
    streaks: Pair  # the same, drawn out for foam
    drawn: Floats  # their scale
    saturation: Floats
    thickness: Floats  # of water that light passes, m
    sheet: Floats  # 1 in the jet, through which light passes whichever way it goes
    mirror: Floats  # share of the sky that the place sees

    def on(self, moved: Floats, drawn: Floats | float) -> Floats:
        """Vectors (r, 3) on the surface as those of ``level``, ``drawn`` along the water's way; (r, 2)."""
        along, aside = drawn * dot(moved, self.along), moved @ self.axes[2]
        return (along[:, None] * self.axes[0] + aside[:, None] * self.axes[2])[:, [0, 2]]

    def off(self, slope: Floats) -> Floats:
        """Slopes (2, r) of level water as vectors on the surface; (r, 3)."""
        along, aside = self.axes[[0, 2]][:, [0, 2]] @ slope
        return along[:, None] * self.along + aside[:, None] * self.axes[2]

    def through(self, air: Air, body: Water, d: Floats) -> Floor:
        """What is seen through the crest along rays d (r, 3): sky, and the sun's light that it scatters ahead."""
        c = np.maximum(-dot(d, self.normal), 0.0)
        inner = np.sqrt(1.0 - (1.0 - c * c) / WATER_INDEX**2)
        behind = d / WATER_INDEX + (c / WATER_INDEX - inner)[:, None] * self.normal
        # What goes down meets deep water, not the crest's back.
        passes = self.sheet + (1.0 - self.sheet) * smoothstep(-0.45, -0.05, behind[:, 1])
        behind[:, 1] = np.abs(behind[:, 1]) + of.RAISED
        ahead = np.maximum(d @ air.sun, 0.0) ** 4 * body.translucency / math.pi
        seen = 0.9 * air.sky(unit(behind)) + ahead[:, None] * air.sun_irradiance
        clouded = of.CLOUDED / self.height
        return lambda extinction, deep, _: (
            deep + (seen - deep) * passes[:, None] * np.exp(-(extinction + clouded) * self.thickness[:, None])
        )


class PlungingCrest:
    """The crest of a scene at a time (s) around an origin (x, z), m."""

    def __init__(self, crest: Breaker, time: float, origin: Vec2) -> None:
        self.height, self.form = crest.height, of.overturning(crest)
        moved = Fraction(self.form.rate) * (Fraction(time) - Fraction(crest.start)) + Fraction(of.SHOULDER)
        self.front = float(moved % Fraction(self.form.period)) - of.SHOULDER
        c, s, side = math.cos(crest.heading), math.sin(crest.heading), 1.0 if crest.peels == "right" else -1.0
        self.axes = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-side * s, 0.0, side * c]])
        self.origin = np.array([origin[0] - crest.place[0], 0.0, origin[1] - crest.place[1]])
        self.advanced = np.array([self.form.advance * self.front, 0.0, 0.0])

    def section(self, place: Floats) -> Section:
        return Section(self.front, self.form, place)

    def trace(self, o: Floats, d: Floats) -> CrestHit:
        """First hits of rays (r, 3) from o (3,) along unit vectors d; t is infinite where there is none."""
        o, way = (o + self.origin) @ self.axes.T / self.height - self.advanced, d @ self.axes.T
        low = np.array([-of.LENGTH, of.LOWEST, max(0.0, self.front - of.TAIL * self.form.landing)])
        high = np.array([of.FRONT, 1.0, min(self.form.length, self.front + of.SHOULDER)])
        slant = np.where(np.abs(way) < 1e-9, 1e-9, way)
        ends = np.sort(np.stack(((low - o) / slant, (high - o) / slant)), axis=0)
        near, far = np.maximum(ends[0].max(axis=1), 0.0), ends[1].min(axis=1)
        t, part = np.full(d.shape[0], np.inf), np.zeros(d.shape[0])
        rows = np.flatnonzero((near < far) & (low[2] < high[2]))
        places = (o + (near + (far - near) * (i / STEPS))[rows, None] * way[rows] for i in range(STEPS + 1))
        before, entered = np.zeros((5, rows.size)), []
        for i, gaps in enumerate(self.section(place).gaps for place in places):
            kind, own = np.nonzero((before > 0.0) & (gaps < 0.0))
            entered.append(np.stack((kind, rows[own], np.full_like(own, i))))
            before = gaps
        kind, rows, i = np.concatenate(entered, axis=1)
        step = (far - near)[rows] / STEPS
        self._enter(o, way, (kind, rows), (near[rows] + (i - 1) * step, near[rows] + i * step), (t, part))
        hit = np.isfinite(t)
        place, normal = np.zeros_like(d), np.zeros_like(d)
        place[hit] = o + t[hit, None] * way[hit]
        normal[hit] = self._normal(place[hit], part[hit])
        return CrestHit(t * self.height, place, normal, part)

    def _enter(self, o: Floats, way: Floats, of_rays: tuple[Indices, Indices], span: Pair, found: Pair) -> None:
        """Write where rays first enter the crest in one of the intervals at whose ends they are out and in, and which part.

        ``of_rays``: what is entered, and by which rays: the whole, or between two places in the air the jet alone, by
        its top or from under it.
        """
        (kind, rows), (low, high), every = of_rays, span, np.arange(span[0].size)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            out = self.section(o + middle[:, None] * way[rows]).gaps[kind, every] > 0.0
            low, high = np.where(out, middle, low), np.where(out, high, middle)
        at = self.section(o + high[:, None] * way[rows])
        gaps = at.gaps
        beside = np.minimum(gaps[FACE], gaps[UNDER])
        crest = np.where(gaps[TOP] >= beside, TOP, np.where(gaps[FACE] <= gaps[UNDER], FACE, UNDER))
        whole = np.where(gaps[LUMPS] <= np.maximum(gaps[TOP], beside), LUMPS, crest)
        jet = ((kind == TOP) & (at.x <= at.tip)) | ((kind == UNDER) & (gaps[TOP] < 0.0) & (gaps[FACE] > 0.0))
        # The nearest of a ray is written last.
        order = np.argsort(-high)
        order = order[(jet | (kind == WHOLE))[order]]
        for values, own in zip(found, (high, np.where(kind == WHOLE, whole, kind)), strict=True):
            values[rows[order]] = own[order]

    def _normal(self, place: Floats, part: Floats) -> Floats:
        """Unit normals (r, 3) along the crest's axes, by central differences."""
        own = part.astype(np.intp), np.arange(part.size)
        sides = [[self.section(place + by).forms[own] for by in (step, -step)] for step in STEP * np.eye(3)]
        return unit(np.stack([plus - minus for plus, minus in sides], axis=-1))

    def look(self, hit: CrestHit) -> CrestLook:
        """What shows at hits."""
        at, part, n = self.section(hit.place), hit.part, hit.normal
        left, up = np.clip(at.left, 0.0, 1.0), np.clip(at.y, 0.0, 1.0)
        back, round_ = of.LENGTH * np.sqrt(1.0 - np.sqrt(up)), np.sqrt(1.0 - left * left)
        thick = at.jet * (1.0 - round_) + JOINT * left**6 + np.maximum(at.behind - at.x, 0.0)
        under = back + (thick - back) * smoothstep(0.0, 0.4, at.phase)
        # The way of the water: level before the face, then up the face and along the roof; level on top.
        toe = at.behind + of.HALF_WIDTH + of.XZ / of.XX * of.HALF_HEIGHT + of.LEAN * at.lean
        risen = toe - 0.6 * (toe - at.x) - 0.9 * at.y
        roof = toe - 0.6 * (toe - at.behind) - 0.9 * (of.VERTICAL + JET * round_) + at.behind - at.x
        m = self.advanced[0] + at.high * at.chosen(part, at.x, risen, roof, at.x)
        drawn = at.chosen(part, of.STREAK, of.STREAK, of.STREAK, 1.0)
        level, streaks = (
            (np.stack((by * m, 0.0 * m, hit.place[:, 2]), axis=-1) @ self.axes * self.height - self.origin).T
            for by in (1.0, drawn)
        )
        shade = 1.0 - 0.6 * np.clip(at.tip - at.x, 0.0, 1.0) * smoothstep(0.0, 0.3, at.y)
        return CrestLook(
            self.axes,
            self.height,
            n @ self.axes,
            unit(np.stack((n[:, 1], -n[:, 0], 0.0 * m), axis=-1)) @ self.axes,
            (level[0], level[2]),
            (streaks[0], streaks[2]),
            drawn,
            self._saturation(at, part, left, hit.place[:, 1]),
            at.chosen(part, thick, np.maximum(at.x + back, 0.0), under, 9.0) * at.high * self.height,
            at.chosen(part, smoothstep(0.0, 0.3, at.x), 0.0, 1.0, 0.0),
            at.chosen(part, 1.0, shade, shade, 1.0),
        )

    def _saturation(self, at: Section, part: Floats, left: Floats, y: Floats) -> Floats:
        """Foam: feathers at the crest, white at the lip, streaks up the face, all white where the jet has landed."""
        landed = smoothstep(0.7, 1.5, at.land)
        lip = smoothstep(0.45, 0.95, 1.0 - left) * smoothstep(0.0, 0.4, at.phase)
        feather = smoothstep(-0.6, 0.0, at.x) * (1.0 - at.lean) ** 3
        streaks = 0.3 * smoothstep(0.1, 0.9, at.y) * (1.0 - at.lean) ** 2 * (0.4 + 0.6 * at.phase)
        return at.chosen(
            part,
            np.maximum(np.maximum(0.3 * feather, lip), smoothstep(-3.5, -0.5, at.x) * landed),
            np.maximum(streaks, landed),
            np.maximum(np.maximum(lip, streaks), landed),
            np.maximum(smoothstep(0.0, 0.12, y - of.APRON), 0.9 * at.apron),
        )
