"""Section 17: a plunging crest at one time around one origin: where rays meet it, its normals, what shows of it.

Places are (x, y, s): along the crest's travel from its first vertical face, up, and along the crest, in its heights.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves.plunging import (
    ASPECT,
    BORE,
    FOREMOST,
    FRONT,
    HALF_HEIGHT,
    HALF_WIDTH,
    LEAN,
    LEANING,
    LENGTH,
    LONG,
    SHOULDER,
    TAIL,
    TAPER,
    THROW,
    VERTICAL,
    XX,
    XZ,
    overturning,
)
from seafoam.reference.light.light import Air, Floor
from seafoam.reference.noise import fractal
from seafoam.reference.types import Floats, Pair, Rows, Vec2, dot, smoothstep, unit
from seafoam.scene import Breaker, Water

STEPS, HALVINGS = 256, 30
"""Intervals of a ray's way through the crest's box, and of the bisection in one of them."""
LOWEST = 2e-4
LEAST = 1e-3  # of a height that divides
STEP = 2e-3  # of differences for normals
LUMPS_SEED = 1983
LUMP = 0.45  # size of the first lumps of what is thrown up
RAISED = 0.15
STREAK = 0.35  # along the water's way, foam is drawn out by the inverse
JOINT = LENGTH * math.sqrt(1.0 - math.sqrt(VERTICAL)) - (1.0 - VERTICAL)
"""What makes the jet as thick where it leaves the crest as the crest is there."""
TOP, FACE, UNDER, LUMPS = range(4)


@dataclass(frozen=True)
class Stage:
    """How far the crest has broken at places along it; (n,) each."""

    high: Floats  # height
    lean: Floats  # share of the unbroken face's lean
    land: Floats  # way behind the first vertical face, in ways until the jet lands; at least 0
    lumps: Floats  # height of what is thrown up

    @property
    def behind(self) -> Floats:
        return -BORE * self.phase

    @property
    def phase(self) -> Floats:
        return np.minimum(self.land, 1.0)

    @property
    def tip(self) -> Floats:
        return THROW * self.phase


@dataclass
class CrestHit(Rows):
    """Where r rays meet the crest: distance (r,) m, place and normal (r, 3) along its axes, and which part of it."""

    t: Floats
    place: Floats
    normal: Floats
    part: Floats


@dataclass(frozen=True, eq=False)
class CrestLook:
    """What shows of the crest at r places. Water moves through it along its travel: up the face, and level on top."""

    axes: Floats
    normal: Floats  # (r, 3) unit vectors
    along: Floats  # (r, 3) unit vectors, along the surface and against the water's way
    level: Pair  # (x, z), m from the origin, on level water from where the water has come
    streaks: Pair  # the same, drawn out for foam
    saturation: Floats
    thickness: Floats  # of water that light passes, m
    mirror: Floats  # share of the sky that the place sees

    def on(self, moved: Floats, drawn: float) -> Floats:
        """Vectors (r, 3) on the surface as those of ``level``, ``drawn`` along the water's way; (r, 2)."""
        level = drawn * dot(moved, self.along)[:, None] * self.axes[0] + (moved @ self.axes[2])[:, None] * self.axes[2]
        return level[:, [0, 2]]

    def off(self, slope: Floats) -> Floats:
        """Slopes (2, r) of level water as vectors on the surface; (r, 3)."""
        along, aside = self.axes[[0, 2]][:, [0, 2]] @ slope
        return along[:, None] * self.along + aside[:, None] * self.axes[2]

    def through(self, air: Air, body: Water, d: Floats) -> Floor:
        """What is seen through the crest along rays d (r, 3): sky, and the sun's light that it scatters ahead."""
        behind = refracted(d, self.normal)
        behind[:, 1] = np.abs(behind[:, 1]) + RAISED
        ahead = np.maximum(d @ air.sun, 0.0) ** 4 * body.translucency / math.pi
        seen = 0.9 * air.sky(unit(behind)) + ahead[:, None] * air.sun_irradiance

        def light(extinction: Floats, deep: Floats, down: Floats) -> Floats:
            return deep + (seen - deep) * np.exp(-extinction * self.thickness[:, None])

        return light


class PlungingCrest:
    """The crest of a scene at a time (s) around an origin (x, z), m."""

    def __init__(self, crest: Breaker, time: float, origin: Vec2) -> None:
        self.height, self.form = crest.height, overturning(crest)
        moved = Fraction(self.form.rate) * (Fraction(time) - Fraction(crest.start)) + Fraction(SHOULDER)
        self.front = float(moved % Fraction(self.form.period)) - SHOULDER
        c, s = math.cos(crest.heading), math.sin(crest.heading)
        side = 1.0 if crest.peels == "right" else -1.0
        self.axes = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-side * s, 0.0, side * c]])
        self.origin = np.array([origin[0] - crest.place[0], 0.0, origin[1] - crest.place[1]])
        self.advanced = np.array([self.form.advance * self.front, 0.0, 0.0])

    def local(self, place: Floats) -> Floats:
        """Places (r, 3), m from the origin, along the crest's axes; (r, 3)."""
        return (place + self.origin) @ self.axes.T / self.height - self.advanced

    def stage(self, s: Floats) -> Stage:
        ahead, land = s - self.front, np.maximum(self.front - s, 0.0) / self.form.landing
        taper = TAPER * self.form.length
        ends = smoothstep(0.0, taper, s) * smoothstep(0.0, taper, self.form.length - s)
        left = ends * (1.0 - smoothstep(4.0, TAIL, land))
        high = left * (1.0 - smoothstep(0.5, SHOULDER, ahead)) * (1.0 - 0.55 * smoothstep(1.6, 4.0, land))
        return Stage(high, smoothstep(0.0, LEANING, ahead), land, left * smoothstep(0.9, 2.2, land))

    def gaps(self, place: Floats) -> Floats:
        """Ways out of what is under the top, behind the face, in the jet, and thrown up, at places (n, 3); (n, 4)."""
        x, y, s = place.T
        stage = self.stage(s)
        high = np.maximum(stage.high, LEAST)
        at, up = x / high, y / high
        top = up - _top(stage, at)
        jet = np.maximum(_top(stage, at) - _thick(stage, at)[0] - up, at - stage.tip)
        return np.stack((high * top, high * (at - _face(stage, up)), high * jet, y - self._lumps(stage, x, s)), axis=-1)

    def trace(self, o: Floats, d: Floats) -> CrestHit:
        """First hits of rays (r, 3) from o along unit vectors d; t is infinite where there is none."""
        start, way = self.local(np.broadcast_to(o, d.shape)), d @ self.axes.T
        near, far = self._span(start, way)
        t, part = np.full(d.shape[0], np.inf), np.zeros(d.shape[0])
        rows = np.flatnonzero(near < far)
        before, gaps = near[rows], self.gaps(start[rows] + near[rows, None] * way[rows])
        for i in range(1, STEPS + 1):
            after = near[rows] + (far - near)[rows] * (i / STEPS)
            there = self.gaps(start[rows] + after[:, None] * way[rows])
            found, which = self._crossing(start[rows], way[rows], (before, after), (gaps, there))
            met = np.isfinite(found)
            t[rows[met]], part[rows[met]] = found[met], which[met]
            rows, before, gaps = rows[~met], after[~met], there[~met]
        hit = np.isfinite(t)
        place, normal = np.zeros_like(d), np.zeros_like(d)
        place[hit] = start[hit] + t[hit, None] * way[hit]
        normal[hit] = self._normal(place[hit], part[hit])
        return CrestHit(t * self.height, place, normal, part)

    def look(self, hit: CrestHit) -> CrestLook:
        """What shows at hits."""
        x, y, s = hit.place.T
        stage, part = self.stage(s), hit.part
        high = np.maximum(stage.high, LEAST)
        at, up = x / high, y / high
        jet, left = _thick(stage, at)
        back = LENGTH * np.sqrt(1.0 - np.sqrt(np.clip(up, 0.0, 1.0)))
        thick = jet + JOINT * left**6 + np.maximum(stage.behind - at, 0.0)
        thick = np.where(part == FACE, np.maximum(at + back, 0.0), np.where(part == LUMPS, 9.0, thick))
        # The way of the water: level before the face, then up the face and along the roof; level on top.
        toe = stage.behind + HALF_WIDTH + XZ / XX * HALF_HEIGHT + LEAN * stage.lean
        risen = toe - 0.6 * (toe - at) - 0.9 * up
        roof = toe - 0.6 * (toe - stage.behind) - 0.9 * VERTICAL + stage.behind - at
        m = self.advanced[0] + high * np.where(part == FACE, risen, np.where(part == UNDER, roof, at))
        lines = self._saturation(stage, part, at, up, left)
        shade = np.where(part == FACE, 1.0 - 0.6 * np.clip(stage.tip - at, 0.0, 1.0) * smoothstep(0.0, 0.3, up), 1.0)
        n = hit.normal
        across = unit(np.stack((n[:, 1], -n[:, 0], 0.0 * s), axis=-1))
        level, streaks = (
            (np.stack((by * m, 0.0 * s, s), axis=-1) @ self.axes * self.height - self.origin).T[[0, 2]]
            for by in (1.0, STREAK)
        )
        return CrestLook(
            self.axes,
            n @ self.axes,
            across @ self.axes,
            (level[0], level[1]),
            (streaks[0], streaks[1]),
            lines,
            thick * high * self.height,
            shade,
        )

    def _span(self, o: Floats, d: Floats) -> tuple[Floats, Floats]:
        """Where rays are in the box of all that there is."""
        behind = max(0.0, self.front - TAIL * self.form.landing)
        low = np.array([-LENGTH, LOWEST, behind])
        high = np.array([FRONT, 1.0, min(self.form.length, self.front + SHOULDER)])
        way = np.where(np.abs(d) < 1e-9, 1e-9, d)
        ends = np.sort(np.stack(((low - o) / way, (high - o) / way)), axis=0)
        far = ends[1].min(axis=1) if low[2] < high[2] else np.full(d.shape[0], -np.inf)
        return np.maximum(ends[0].max(axis=1), 0.0), far

    def _crossing(
        self, o: Floats, d: Floats, span: tuple[Floats, Floats], gaps: tuple[Floats, Floats]
    ) -> tuple[Floats, Floats]:
        """Where rays enter the water in intervals at whose ends they have these gaps, infinite if nowhere, and which part.

        Entered is the whole, or between two places in the air the jet alone, by its top or from under it.
        """
        best, part = np.full(o.shape[0], np.inf), np.zeros(o.shape[0])
        for kind in (TOP, UNDER, None):
            out = [_of(side, kind) for side in gaps]
            rows = np.flatnonzero((out[0] > 0.0) & (out[1] < 0.0))
            low, high = span[0][rows], span[1][rows]
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                outside = _of(self.gaps(o[rows] + middle[:, None] * d[rows]), kind) > 0.0
                low, high = np.where(outside, middle, low), np.where(outside, high, middle)
            at = o[rows] + high[:, None] * d[rows]
            there, stage = self.gaps(at), self.stage(at[:, 2])
            if kind == TOP:
                valid = at[:, 0] <= stage.tip * np.maximum(stage.high, LEAST)
            else:
                valid = np.full(rows.size, True) if kind is None else (there[:, TOP] < 0.0) & (there[:, FACE] > 0.0)
            nearer = valid & (high < best[rows])
            best[rows[nearer]] = high[nearer]
            part[rows[nearer]] = (_part(there) if kind is None else np.full(rows.size, float(kind)))[nearer]
        return best, part

    def _normal(self, place: Floats, part: Floats) -> Floats:
        """Unit normals (r, 3) along the crest's axes, by central differences."""
        rows = np.arange(place.shape[0]), part.astype(np.intp)
        return unit(
            np.stack([self.gaps(place + by)[rows] - self.gaps(place - by)[rows] for by in STEP * np.eye(3)], axis=-1)
        )

    def _lumps(self, stage: Stage, x: Floats, s: Floats) -> Floats:
        """Height of what the jet throws up where it has landed, which grows wide and covers what is left of the crest."""
        past = np.clip(stage.land - 1.0, 0.0, 3.0)
        v = (x - 1.25 + 0.3 * past) / (0.6 + 0.5 * past)
        noise = np.zeros_like(x)
        rows = np.flatnonzero((np.abs(v) < 1.0) & (stage.lumps > 0.0))
        place = np.stack((s[rows], x[rows] + 0.6 * self.front), axis=-1) / LUMP
        noise[rows] = fractal(place, np.zeros(rows.size), 3, LUMPS_SEED)
        bump = np.maximum(1.0 - v * v, 0.0)
        result: Floats = 0.5 * stage.lumps * bump * (1.0 + 0.45 * np.clip(noise, -1.5, 1.5))
        return result

    def _saturation(self, stage: Stage, part: Floats, at: Floats, up: Floats, left: Floats) -> Floats:
        """Foam: feathers at the crest, white at the lip, streaks up the face, all white where the jet has landed."""
        landed = smoothstep(0.9, 1.8, stage.land)
        lip = smoothstep(0.45, 0.95, 1.0 - left) * smoothstep(0.0, 0.4, stage.phase)
        feather = smoothstep(-0.6, 0.0, at) * (1.0 - stage.lean) ** 3
        streaks = 0.3 * smoothstep(0.1, 0.9, up) * (1.0 - stage.lean) ** 2 * (0.4 + 0.6 * stage.phase)
        top = np.maximum(0.3 * feather, lip)
        clear = np.where(part == TOP, top, np.where(part == FACE, streaks, np.maximum(lip, 0.3 * stage.phase)))
        white = smoothstep(-3.5, -0.5, at) * landed
        return np.where(part == LUMPS, 1.0, np.maximum(clear, np.where(part == TOP, white, landed)))


def refracted(d: Floats, n: Floats) -> Floats:
    """Directions (r, 3) in the water of rays d that meet a surface of normals n; unit vectors."""
    c = np.maximum(-dot(d, n), 0.0)
    inner = np.sqrt(1.0 - (1.0 - c * c) / WATER_INDEX**2)
    return d / WATER_INDEX + (c / WATER_INDEX - inner)[:, None] * n


def _of(gaps: Floats, kind: int | None) -> Floats:
    """Gaps (n, 4) of a part, or of the whole; (n,)."""
    if kind is not None:
        return gaps[:, kind]
    return np.minimum(np.maximum(gaps[:, TOP], np.minimum(gaps[:, FACE], gaps[:, UNDER])), gaps[:, LUMPS])


def _part(gaps: Floats) -> Floats:
    """Which part gives the whole its gap; (n,)."""
    side = np.where(gaps[:, FACE] <= gaps[:, UNDER], FACE, UNDER)
    beside = np.minimum(gaps[:, FACE], gaps[:, UNDER])
    crest = np.where(gaps[:, TOP] >= beside, TOP, side)
    whole = np.maximum(gaps[:, TOP], beside)
    return np.where(gaps[:, LUMPS] <= whole, LUMPS, crest).astype(np.float64)


def _top(stage: Stage, at: Floats) -> Floats:
    """Height of the back, and before a crest that has begun to overturn of the jet's top."""
    back = np.maximum(1.0 - (np.minimum(at, 0.0) / LENGTH) ** 2, 0.0) ** 2
    return np.asarray(back - (1.0 - FOREMOST) * np.where(stage.land > 0.0, np.maximum(at, 0.0), 0.0) ** 2, np.float64)


def _face(stage: Stage, up: Floats) -> Floats:
    """x of the face: of the ellipse, straight up over its vertical place, and ahead where it leans."""
    z = np.clip(up, 0.0, VERTICAL) - HALF_HEIGHT
    root = np.sqrt(np.maximum(XX * LONG**2 - (ASPECT * z) ** 2, 0.0))
    lean = LEAN * np.sqrt(1.0 - np.sqrt(np.clip(up, 0.0, 1.0)))
    return stage.behind + HALF_WIDTH - (XZ * z + root) / XX + stage.lean * lean


def _thick(stage: Stage, at: Floats) -> tuple[Floats, Floats]:
    """Thickness of the jet, and the way left to its tip in shares of its width; (n,) each."""
    width = np.maximum(stage.tip - stage.behind, LEAST)
    left = np.clip((stage.tip - at) / width, 0.0, 1.0)
    return (_top(stage, stage.behind) - VERTICAL) * (1.0 - np.sqrt(1.0 - left * left)), left
