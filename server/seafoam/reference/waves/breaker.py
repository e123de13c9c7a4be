"""Section 17: a plunging crest at one time around one origin: where rays meet it, and what shows of it.

Places are (x, y, s): along the crest's travel from its first vertical face, up, and along the crest, in its heights.
"""

import math
from fractions import Fraction
from functools import partial

import numpy as np

from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves import plunging as of
from seafoam.reference.light.light import Air, Floor
from seafoam.reference.noise import patches, perlin
from seafoam.reference.types import Floats, Footprints, Indices, Pair, Vec2, dot, smoothstep, unit
from seafoam.scene import Breaker, BreakerSaturation, Water

STEPS, HALVINGS = 128, 24  # of a ray's way through the crest's box, and of one of these
LEAST, STEP = 1e-3, 2e-3  # least divisor, and step of the differences for normals
TOP, FACE, UNDER, LUMPS, WHOLE, ROUND, CAP = range(7)
PATCHES = tuple((0.35**i * of.CELL, True) for i in range(3))
JET = 1.0 - of.VERTICAL  # thickness where it leaves the crest, which is thicker there by the next
JOINT = of.LENGTH * math.sqrt(1.0 - math.sqrt(of.VERTICAL)) - JET


class Section:
    """The crest's sections at places (n, 3); all numbers are (n,), in the crest's heights, x and y in the section's."""

    def __init__(self, front: float, form: of.Overturning, place: Floats) -> None:
        x, y, s = place.T
        ahead, self.land = s - front, np.maximum(front - s, 0.0) / form.landing
        taper, left = of.TAPER * form.length, 1.0 - smoothstep(4.0, of.TAIL, self.land)
        left *= smoothstep(0.0, taper, s) * smoothstep(0.0, taper, form.length - s)
        shoulder, fallen = smoothstep(0.5, of.SHOULDER, ahead), smoothstep(1.6, 4.0, self.land)
        self.high = np.maximum(left * (1.0 - shoulder) * (1.0 - 0.55 * fallen), LEAST)
        self.lean, thrown = smoothstep(0.0, of.LEANING, ahead), left * smoothstep(0.9, 2.2, self.land)
        even, g = np.minimum(self.land, 1.0), of.GENTLE
        self.phase = (np.sqrt(even * even + g * g) - g) / (math.sqrt(1.0 + g * g) - g)
        self.tip, self.behind = of.THROW * self.phase, -of.BORE * self.phase
        self.x, self.y = x / self.high, y / self.high
        self.left = (self.tip - self.x) / np.maximum(self.tip - self.behind, LEAST)  # way to the tip in jet's widths
        self.jet = self.top(self.behind) - of.VERTICAL
        # What the jet throws up where it has landed grows wide and covers what is left of the crest.
        past, wide = np.clip(self.land - 1.0, 0.0, 3.0), np.clip(self.land - 0.9, 0.0, 4.0)
        v, w = (x - 1.25 + 0.3 * past) / (0.6 + 0.5 * past), (x - 0.9) / (0.5 + 0.65 * wide)
        self.apron = thrown * np.maximum(1.0 - w * w, 0.0)
        up, self.lumps = 0.7 - 0.35 * smoothstep(1.5, 2.8, self.land), of.APRON * smoothstep(0.0, 0.2, self.apron)
        lumps = up * thrown * np.maximum(1.0 - v * v, 0.0)
        rows = np.flatnonzero((lumps > 0.0) & (y <= 1.3 * lumps + self.lumps))
        at = np.stack((s, x + 0.6 * front), axis=-1)[rows] / of.LUMP
        noise = np.sum([0.45**i * np.abs(perlin(2.3**i * at, of.SEED + i)[0]) for i in range(3)], axis=0)
        lumps[rows] *= 1.3 - 0.8 * np.exp(-4.0 * noise)
        self.lumps += lumps

    def top(self, x: Floats) -> Floats:
        """Height of the back, and before a crest that has begun to overturn of the jet's top."""
        back = np.maximum(1.0 - (np.minimum(x, 0.0) / of.LENGTH) ** 2, 0.0) ** 2
        return np.asarray(back - (1.0 - of.FOREMOST) * np.where(self.land > 0.0, np.clip(x, 0.0, 1.2), 0.0) ** 2)

    def gaps(self) -> Floats:
        """Ways out of what is under the top, behind the face, in the jet, thrown up, and of the whole; and what is 0 on
        the jet's underside, and on a leaning face near the crest, and nowhere steep; (7, n)."""
        # The face is an ellipse's, goes straight up over its vertical place, and ahead where it leans.
        z = np.clip(self.y, 0.0, of.VERTICAL) - of.HALF_HEIGHT
        root = np.sqrt(np.maximum(of.XX * of.LONG**2 - (of.ASPECT * z) ** 2, 0.0))
        lean = of.LEAN * np.sqrt(1.0 - np.sqrt(np.clip(self.y, 0.0, 1.0)))
        face = self.behind + of.HALF_WIDTH - (of.XZ * z + root) / of.XX + self.lean * lean
        under = self.top(self.x) - self.jet * (1.0 - np.sqrt(1.0 - np.clip(self.left, 0.0, 1.0) ** 2)) - self.y
        top, front = self.high * (self.y - self.top(self.x)), self.high * (self.x - face)
        jet, lumps = self.high * np.maximum(under, self.x - self.tip), self.high * self.y - self.lumps
        down = 1.0 - (self.top(self.x) - self.y) / self.jet
        fall = np.maximum(1.0 - (self.x / np.maximum(of.LEAN * self.lean, LEAST)) ** 2, 0.0)
        whole = np.minimum(np.maximum(top, np.minimum(front, jet)), lumps)
        return np.stack((top, front, jet, lumps, whole, 1.0 - self.left**2 - down**2, self.y - fall**2))

    def saturation(self, part: Indices, left: Floats) -> Floats:
        """Foam: feathers at the crest, white at the lip, streaks up the face, all white where the jet has landed."""
        landed, steep = 0.9 * smoothstep(0.7, 1.5, self.land), 1.0 - self.lean
        lip = smoothstep(0.45, 0.95, 1.0 - left) * smoothstep(0.0, 0.4, self.phase)
        streaks = np.maximum(0.3 * smoothstep(0.1, 0.9, self.y) * steep**2 * (0.4 + 0.6 * self.phase), landed)
        top = np.maximum(0.3 * smoothstep(-0.6, 0.0, self.x) * steep**3, smoothstep(-3.5, -0.5, self.x) * landed)
        thrown = np.maximum(smoothstep(0.0, 0.04, self.high * self.y - of.APRON), 0.93 * self.apron)
        return np.choose(part, (np.maximum(top, lip), streaks, np.maximum(streaks, lip), thrown))


class PlungingCrest:
    """A crest at a time (s) around an origin (x, z), m: the last that began, or an ``earlier`` one."""

    def __init__(self, crest: Breaker, time: float, origin: Vec2, earlier: int = 0) -> None:
        self.height, self.form = crest.height, of.overturning(crest)
        moved = Fraction(self.form.rate) * (Fraction(time) - Fraction(crest.start)) + Fraction(of.SHOULDER)
        self.front = float(moved % Fraction(self.form.period)) + earlier * self.form.period - of.SHOULDER
        c, s, side = math.cos(crest.heading), math.sin(crest.heading), 1.0 if crest.peels == "right" else -1.0
        self.axes = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-side * s, 0.0, side * c]])
        self.origin = np.array([origin[0] - crest.place[0], 0.0, origin[1] - crest.place[1]])
        self.advanced = np.array([self.form.advance * self.front, 0.0, 0.0])
        self.section = partial(Section, self.front, self.form)

    def trace(self, o: Floats, d: Floats) -> tuple[Floats, Indices]:
        """How far, m, rays (r, 3) from o (3,) enter the crest, infinite: nowhere, and which part of it they meet."""
        o, d = self.local(o), d @ self.axes.T
        low = np.array([-of.LENGTH, of.LOWEST, max(0.0, self.front - of.TAIL * self.form.landing)])
        high = np.array([of.FRONT, 1.0, min(self.form.length, self.front + of.SHOULDER)])
        slant = np.where(np.abs(d) < 1e-9, 1e-9, d)
        ends = np.sort(np.stack(((low - o) / slant, (high - o) / slant)), axis=0)
        near, far = np.maximum(ends[0].max(axis=1), 0.0), ends[1].min(axis=1)
        # From in the crest nothing of it is seen.
        top, front, jet = self.section(o[None]).gaps()[:LUMPS, 0]
        rows = np.flatnonzero((near < far) & (low[2] < high[2]) & (max(top, min(front, jet)) >= 0.0))
        step, before, entered = (far - near) / STEPS, np.zeros((ROUND, rows.size)), []
        for i in range(STEPS + 1):
            gaps = self.section(o + (near + i * step)[rows, None] * d[rows]).gaps()[:ROUND]
            kind, own = np.nonzero((before > 0.0) & (gaps < 0.0))
            entered.append(np.stack((kind, rows[own], np.full_like(own, i))))
            before = gaps
        kind, rows, last = np.concatenate(entered, axis=1)
        at, met, part = self._entry(o, d[rows], kind, (near[rows] + (last - 1) * step[rows], step[rows]))
        t, which = np.full(d.shape[0], np.inf), np.zeros(d.shape[0], np.intp)
        order = np.flatnonzero(met)[np.argsort(-at[met])]  # the nearest of a ray is written last
        t[rows[order]], which[rows[order]] = at[order] * self.height, part[order]
        return t, which

    def _entry(self, o: Floats, d: Floats, kind: Indices, span: Pair) -> tuple[Floats, Floats, Indices]:
        """Where rays enter the whole, or the jet alone by its top or from under it, in intervals from and by ``span``
        at whose ends they are out and in; whether that counts; and which part they meet."""
        low, high, every = span[0], span[0] + span[1], np.arange(kind.size)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            out = self.section(o + middle[:, None] * d).gaps()[kind, every] > 0.0
            low, high = np.where(out, middle, low), np.where(out, high, middle)
        at = self.section(o + high[:, None] * d)
        top, face, under, lumps = at.gaps()[:WHOLE]
        crest = np.where(top >= np.minimum(face, under), TOP, np.where(face <= under, FACE, UNDER))
        whole = np.where(lumps <= np.maximum(top, np.minimum(face, under)), LUMPS, crest)
        jet = ((kind == TOP) & (at.x <= at.tip)) | ((kind == UNDER) & (top < 0.0) & (face > 0.0))
        return high, jet | (kind == WHOLE), np.where(kind == WHOLE, whole, kind)

    def left(self, source: BreakerSaturation, x: Floats, z: Floats, at: Footprints | None, *, even: bool) -> Floats:
        """f of the foam that crests leave at (x, z), m from the origin, in patches over footprints, or even; (r,)."""
        form, (m, _, s) = self.form, (self.local(np.stack((x, 0.0 * x, z), axis=-1)) + self.advanced).T
        front = (m - of.FOOT) / form.advance
        land, taper = (front - s) / form.landing, of.TAPER * form.length
        ran = smoothstep(0.0, taper, s) * smoothstep(0.0, taper, form.length - s)
        torn = 0.5 if even else patches(m, s, PATCHES, at, self.height)
        ran *= smoothstep(0.9, 1.6, land + 0.5 * torn - 0.25) * (1.0 - smoothstep(4.0, of.TAIL, land))
        age = np.mod(self.front - front, form.period) / form.rate  # since a crest passed here, s
        return np.asarray(source.amount * ran * np.exp(-np.minimum(age / source.life, 80.0)) * (0.3 + 0.9 * torn))

    def local(self, place: Floats) -> Floats:
        """Places (r, 3), m from the origin, along the crest's axes."""
        return np.asarray((place + self.origin) @ self.axes.T / self.height - self.advanced, np.float64)


class CrestLook:
    """What shows of a crest at places (r, 3), m from the origin, of these parts (r,). Water moves through it along its
    travel, up the face and level on top: ``along`` (r, 3) lies on the surface against its way, ``level`` (3, r), m from
    the origin, is on level water from where it has come, ``streaks`` the same, ``drawn`` (r,) out for foam."""

    def __init__(self, crest: "PlungingCrest", place: Floats, part: Indices) -> None:
        self.axes, height, place = crest.axes, crest.height, crest.local(place)
        at, s = crest.section(place), place[:, 2]
        own = np.where((part == FACE) & (at.y > 0.9) & (at.lean > 0.02), CAP, np.where(part == UNDER, ROUND, part))
        ends = [[crest.section(place + by).gaps() for by in (step, -step)] for step in STEP * np.eye(3)]
        n = unit(np.stack([(out - into)[own, np.arange(part.size)] for out, into in ends], axis=-1))
        left, up, none = np.clip(at.left, 0.0, 1.0), np.clip(at.y, 0.0, 1.0), 0.0 * s
        self.normal = n @ self.axes
        self.along = unit(np.stack((n[:, 1], -n[:, 0], none), axis=-1)) @ self.axes
        # The way of the water: level before the face, then up the face and along the roof; level on top.
        bent, foot = np.sqrt(1.0 - left * left), of.HALF_WIDTH + of.XZ / of.XX * of.HALF_HEIGHT
        toe = at.behind + foot + of.LEAN * at.lean
        risen = toe - 0.6 * (toe - at.x) - 0.9 * at.y
        roof = toe - 0.6 * (toe - at.behind) - 0.9 * (of.VERTICAL + JET * bent) + at.behind - at.x
        m = crest.advanced[0] + at.high * np.choose(part, (at.x, risen, roof, at.x))
        self.drawn, self.soft = np.where(part == LUMPS, 1.0, of.STREAK), np.outer(part == LUMPS, (0.0, of.SOFT, 0.0))
        self.level, self.streaks = (
            (np.stack((by * m, none, s), axis=-1) @ self.axes * height - crest.origin).T for by in (1.0, self.drawn)
        )
        self.saturation = at.saturation(part, left)
        # Of water that light passes, and of what holds it back; and its share whichever way it goes.
        back = of.LENGTH * np.sqrt(1.0 - np.sqrt(up))
        thick = at.jet * (1.0 - bent) + JOINT * left**6 + np.maximum(at.behind - at.x, 0.0)
        under = back + (thick - back) * smoothstep(0.0, 0.4, at.phase)
        every = np.choose(part, (thick, np.maximum(at.x + back, 0.0), under, 9.0))
        self.thickness, self.clouded = every * at.high * height, of.CLOUDED / height
        self.passes = np.choose(part, (smoothstep(0.0, 0.3, at.x), none, 1.0 + none, none))
        shade = 1.0 - 0.6 * np.clip(at.tip - at.x, 0.0, 1.0) * smoothstep(0.0, 0.3, at.y)
        self.mirror = np.choose(part, (1.0, shade, shade, 1.0))

    def on(self, moved: Floats, drawn: Floats | float) -> Floats:
        """Vectors (r, 3) on the surface as those of ``level``, ``drawn`` along the water's way; (r, 2)."""
        along, aside = drawn * dot(moved, self.along), moved @ self.axes[2]
        level: Floats = along[:, None] * self.axes[0] + aside[:, None] * self.axes[2]
        return level[:, [0, 2]]

    def off(self, slope: Floats) -> Floats:
        """Slopes (2, r) of level water as vectors on the surface; (r, 3)."""
        along, aside = self.axes[[0, 2]][:, [0, 2]] @ slope
        return np.asarray(along[:, None] * self.along + aside[:, None] * self.axes[2])

    def mirrored(self, d: Floats) -> Floats:
        """Share (r, 1) of the sky that is mirrored along rays d (r, 3): under the horizon it is water."""
        up = d[:, 1] - 2.0 * dot(d, self.normal) * self.normal[:, 1]
        return np.asarray(self.mirror * (0.3 + 0.7 * smoothstep(-0.4, 0.0, up)))[:, None]

    def through(self, air: Air, body: Water, d: Floats) -> Floor:
        """What is seen through the crest along rays d (r, 3): sky, and the sun's light that it scatters ahead."""
        c = np.maximum(-dot(d, self.normal), 0.0)
        inner = np.sqrt(1.0 - (1.0 - c * c) / WATER_INDEX**2)
        behind = d / WATER_INDEX + (c / WATER_INDEX - inner)[:, None] * self.normal
        # What goes down meets deep water, not the crest's back.
        passes = self.passes + (1.0 - self.passes) * smoothstep(-0.45, -0.05, behind[:, 1])
        behind[:, 1] = np.hypot(behind[:, 1], of.RAISED)
        ahead = np.maximum(d @ air.sun, 0.0) ** 4 * body.translucency / math.pi
        seen, thick = 0.9 * air.sky(unit(behind)) + ahead[:, None] * air.sun_irradiance, self.thickness[:, None]
        return lambda taken, deep, _: deep + (seen - deep) * passes[:, None] * np.exp(-(taken + self.clouded) * thick)
