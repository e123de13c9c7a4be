"""Section 13: drops that surf throws up from rocks."""

from __future__ import annotations

import math

import numpy as np

from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.spray import EPOCHS
from seafoam.reference.noise import chained, number, pcg
from seafoam.reference.shore.maps import MASK, SWASH
from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray.drop import MIST, SHEET, Drops, cycles
from seafoam.reference.types import Floats, smoothstep
from seafoam.reference.waves.parametric import reduced, wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS

DELAY = 1.5
SPOT = 6.0
JET = 1.5
"""Sides of the squares of coast that emit drops at the same time and in the same way, m."""


def on_rocks(scene: Scene) -> bool:
    """Whether there are rocks for surf to break on."""
    shore, spray = scene.shore, scene.spray
    return shore is not None and spray is not None and shore.surf.height > 0.0 and len(rocks(shore, spray.steep)) > 0


def from_rocks(scene: Scene, coast: Coast, time: float, origin: tuple[float, float]) -> Drops:
    """Drops that the surf of a coast throws up, by index, with a strength of 0 where there is none."""
    spray = scene.spray
    assert spray is not None
    places = rocks(coast.shore, spray.steep)
    index = np.arange(DROPS, dtype=np.uint64)
    own = pcg(index)
    rock = places[np.arange(DROPS) % len(places)]
    out = rock[:, 2:]
    along = np.stack((-out[:, 1], out[:, 0]), axis=-1)
    q = rock[:, :2] + 2.0 * (number(own, 0) - 0.5)[:, None] * along
    field = coast.field.value(q[:, 0], q[:, 1])
    period = coast.shore.surf.period
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
    level = lean[:, None] * out + aside[:, None] * along
    velocity = fast[:, None] * np.stack((level[:, 0], 0.8 + 0.2 * number(word, 3), level[:, 1]), axis=-1)
    place = q - np.array(coast.offset)
    height = surf_then(coast, q, field, age, time) + field[:, 3] * _swell_then(scene, time, origin, place, age)
    birth = np.stack((place[:, 0], height, place[:, 1]), axis=-1)
    mist = number(word, 5) < spray.mist
    # They vanish before the next crest arrives.
    life = np.full(DROPS, min(spray.life, period - DELAY))
    alive = (age >= 0.0) & (age < life) & (start > spray.threshold)
    return Drops(
        birth=birth,
        velocity=velocity,
        age=age,
        life=life,
        radius=np.full(DROPS, 4.5 * spray.size),
        strength=np.where(alive, np.where(mist, 0.3, 0.8), 0.0),
        kind=np.where(mist, MIST, SHEET),
        word=word,
    )


def surf_then(coast: Coast, q: Floats, field: Floats, age: Floats, time: float) -> Floats:
    """Height of the surf ages (n,) ago at places (n, 2) of the square, where its map says ``field`` (n, 4); m."""
    surf = coast.shore.surf

    def rhythm(before: Floats) -> Floats:
        total = np.zeros(len(q))
        for i, (wavelength, heading, period) in enumerate(MASK):
            k = 2.0 * math.pi / wavelength
            phase = reduced((2.0 * math.pi / period, time), plus=1.7 * i) - 2.0 * math.pi / period * before
            total += np.sin(phase + k * (math.cos(heading) * q[:, 0] + math.sin(heading) * q[:, 1]))
        return 1.0 - surf.variation * smoothstep(-0.8, 0.8, 0.5 * total)

    turn = coast.turn(field[:, 0]) + age / surf.period
    profile = coast.profiles(turn - np.floor(turn), field[:, 2])[0]
    ratio = rhythm(age) / np.maximum(rhythm(np.zeros_like(age)), 1e-3)
    return np.maximum(field[:, 1] * ratio, 0.0) * profile


def _swell_then(scene: Scene, time: float, origin: tuple[float, float], place: Floats, age: Floats) -> Floats:
    """Height of single waves and rings ages (n,) ago at places (n, 2) from the camera, m."""
    total = np.zeros_like(age)
    if scene.waves:
        total += wave_set(scene, time, origin).height_before(place[:, 0], place[:, 1], age)
    for i in range(len(age) if scene.rings else 0):
        then = ring_set(scene, time - float(age[i]), origin)
        total[i] += then.height(place[i : i + 1, 0], place[i : i + 1, 1])[0]
    return total
