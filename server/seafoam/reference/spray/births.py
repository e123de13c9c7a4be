"""Section 13: the drops of a scene's spray that are in the air at a time, as they were at birth.

Births are no independent form: they repeat ``shaders/spray`` hash by hash, so that a frame has the same drops as the
picture that it judges, in float64. What judges births are their statistics and the float64 surface on which they start
(``tests/gpu/reference/test_spray.py``).
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.spray import EPOCHS
from seafoam.reference.noise import Words, chained, number, pcg
from seafoam.reference.shore.maps import SWASH, rhythm
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats, Rows
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray

SHEET, MIST, DRIFT, COLUMN = 0.0, 1.0, 2.0, 3.0
"""Kinds of drops."""
JETS = 48
DELAY = 1.5
"""Longest time from a crest to a drop at rocks, s."""
SPOT, JET = 6.0, 1.5
"""Sides of the squares of coast that emit drops at the same time, and in the same way, m."""


@dataclass(frozen=True, eq=False)
class Drops(Rows):
    """Drops in the air, x and z of births relative to the camera; (n,) or (n, 3) each."""

    birth: Floats
    velocity: Floats
    age: Floats
    life: Floats
    radius: Floats
    strength: Floats
    kind: Floats
    word: Words


def joined(parts: list[Drops]) -> Drops:
    """All drops of the parts, in order."""
    return Drops(*map(np.concatenate, zip(*(vars(part).values() for part in parts), strict=True)))


def cycles(time: float, period: float) -> tuple[int, float]:
    """Number of whole periods since time 0, and the fraction of the current one."""
    passed = Fraction(time) / Fraction(period)
    whole = math.floor(passed)
    return whole, float(passed - whole)


def from_bursts(spray: Spray, time: float, origin: tuple[float, float]) -> Drops:
    """Drops of blasts under the water, by index, with a strength of 0 where there is none."""
    index = np.arange(DROPS)
    which = index % len(spray.bursts)
    since = []
    for burst in spray.bursts:
        passed = Fraction(time) - Fraction(burst.birth)
        since.append(float(passed % Fraction(burst.every)) if burst.every else min(max(float(passed), -1.0), 1000.0))
    age = np.array(since)[which]
    tall, wide = (np.array([getattr(burst, name) for burst in spray.bursts])[which] for name in ("height", "radius"))
    middle = np.array([burst.place for burst in spray.bursts])[which] - origin
    word = pcg(pcg(index.astype(np.uint64)))
    fastest = np.sqrt(2.4 * GRAVITY * tall)
    jet = pcg(np.floor(number(word, 1) * JETS).astype(np.uint64) ^ (which.astype(np.uint64) << np.uint64(8)))
    heading, disc = (_unit(2.0 * math.pi * turn) for turn in (number(jet, 0), number(word, 2)))
    disc = np.sqrt(number(word, 3))[:, None] * disc
    rim = disc + np.array([1e-4, 0.0])
    rim /= np.hypot(rim[:, 0], rim[:, 1])[:, None]
    share, late, tilt, own = number(word, 4), number(word, 7), number(jet, 1), number(jet, 3)
    column = np.sqrt(tilt)[:, None] * heading + 0.25 * disc
    fast = fastest * (1.0 - 0.45 * tilt) * (0.6 + 0.4 * number(jet, 2)) * np.sqrt(0.02 + 0.98 * share)
    leaning = (0.04 + 0.3 * tilt * tilt * own)[:, None] * heading + 0.04 * column
    # Column, crown and surge.
    family = np.digitize(number(word, 0), (0.62, 0.76))

    def pick(*values: Floats) -> Floats:
        """The value of each drop's family."""
        return np.stack(values)[family, index]

    flat = pick(
        fast[:, None] * leaning,
        (fastest * (0.1 + 0.22 * share * own))[:, None] * rim,
        (fastest * (0.25 + 0.35 * share))[:, None] * rim,
    )
    upward = pick(fast, fastest * (0.2 + 0.2 * share), 0.1 * fastest * (0.3 + share))
    age = age - pick(0.5 * tilt * late, 0.2 * late, (0.09 + 0.07 * late) * fastest)
    place = middle + wide[:, None] * pick(0.8 * column, rim, rim)
    life = 0.25 * fastest + 2.0
    alive = (age >= 0.0) & (age < life)
    return Drops(
        birth=np.insert(place, 1, -0.3, axis=1),
        velocity=np.insert(flat, 1, upward, axis=1),
        age=age,
        life=life,
        radius=tall * np.where(family == 0, 0.02 + 0.035 * (1.0 - share), 0.025) * spray.size * 25.0,
        strength=np.where(alive, np.array([0.35, 0.3, 0.22])[family], 0.0),
        kind=np.array([COLUMN, COLUMN, MIST])[family],
        word=word,
    )


def _unit(angle: Floats) -> Floats:
    return np.stack((np.cos(angle), np.sin(angle)), axis=-1)


def on_rocks(scene: Scene) -> bool:
    """Whether there are rocks for surf to break on."""
    shore, spray = scene.shore, scene.spray
    return shore is not None and spray is not None and shore.surf.height > 0.0 and len(rocks(shore, spray.steep)) > 0


def from_rocks(scene: Scene, coast: Coast, time: float, origin: tuple[float, float]) -> Drops:
    """Drops that surf throws up from rocks, by index, with a strength of 0 where there is none."""
    spray, period = scene.spray, coast.shore.surf.period
    assert spray is not None
    places = rocks(coast.shore, spray.steep)
    own = pcg(np.arange(DROPS, dtype=np.uint64))
    rock = places[np.arange(DROPS) % len(places)]
    out = rock[:, 2:]
    along = np.stack((-out[:, 1], out[:, 0]), axis=-1)
    q = rock[:, :2] + 2.0 * (number(own, 0) - 0.5)[:, None] * along
    field = coast.field.value(q[:, 0], q[:, 1])
    whole, left = cycles(time, period)
    turn = -left - field[:, 0]
    wave = np.floor(turn).astype(np.int64) - whole
    counted = (wave % EPOCHS).astype(np.uint64)
    word = pcg(own ^ counted)
    burst = chained(0, *np.floor(q / SPOT).T, counted)
    delay = DELAY * (0.7 * number(burst, 0) + 0.3 * number(word, 1))
    age = (1.0 - (turn - np.floor(turn))) * period - delay
    strong = 0.3 + 0.7 * number(burst, 1)
    start = spray.speed * np.sqrt(GRAVITY * np.maximum(field[:, 1], 0.0) / SWASH) * strong
    thrown = chained(0, *np.floor(q / JET).T, counted)
    fast = start * (0.4 + 0.6 * number(thrown, 0)) * (0.25 + 0.75 * number(word, 2))
    lean = 0.3 * number(thrown, 1) + 0.2 * number(word, 4) - 0.05
    aside = 0.7 * number(thrown, 2) + 0.3 * number(word, 7) - 0.5
    way = np.insert(lean[:, None] * out + aside[:, None] * along, 1, 0.8 + 0.2 * number(word, 3), axis=1)
    place = q - np.array(coast.offset)
    height = surf_then(coast, q, field, age, time) + field[:, 3] * _swell_then(scene, time, origin, place, age)
    mist = number(word, 5) < spray.mist
    # They vanish before the next crest arrives.
    life = np.full(DROPS, min(spray.life, period - DELAY))
    alive = (age >= 0.0) & (age < life) & (start > spray.threshold)
    return Drops(
        birth=np.insert(place, 1, height, axis=1),
        velocity=fast[:, None] * way,
        age=age,
        life=life,
        radius=np.full(DROPS, 4.5 * spray.size),
        strength=np.where(alive, np.where(mist, 0.3, 0.8), 0.0),
        kind=np.where(mist, MIST, SHEET),
        word=word,
    )


def surf_then(coast: Coast, q: Floats, field: Floats, age: Floats, time: float) -> Floats:
    """Height of the surf ages (n,) ago at places (n, 2) of the square, where its map says ``field`` (n, 4); m."""
    surf, (x, z) = coast.shore.surf, q.T
    turn = coast.turn(field[:, 0]) + age / surf.period
    profile = coast.profiles(turn - np.floor(turn), field[:, 2])[0]
    ratio = rhythm(surf, time, x, z, age) / np.maximum(rhythm(surf, time, x, z), 1e-3)
    return np.maximum(field[:, 1] * ratio, 0.0) * profile


def _swell_then(scene: Scene, time: float, origin: tuple[float, float], place: Floats, age: Floats) -> Floats:
    """Height of single waves and rings ages (n,) ago at places (n, 2) from the camera, m."""
    total = np.zeros_like(age)
    if scene.waves:
        total += wave_set(scene, time, origin).height_before(place[:, 0], place[:, 1], age)
    for i in range(len(age) if scene.rings else 0):
        total[i] += ring_set(scene, time - float(age[i]), origin).height(*place[i, :, None])[0]
    return total
