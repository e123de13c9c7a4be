"""Section 13: drops of blasts under the water."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from seafoam.ocean.constants import GRAVITY
from seafoam.reference.noise import number, pcg
from seafoam.reference.spray.drop import COLUMN, MIST, Drops
from seafoam.reference.types import Floats
from seafoam.scene.spray import Spray

JETS = 48


def from_bursts(spray: Spray, time: float, origin: tuple[float, float], count: int) -> Drops:
    """Drops of blasts, by index, with a strength of 0 where there is none."""
    bursts = spray.bursts
    index = np.arange(count)
    which = index % len(bursts)
    since = []
    for burst in bursts:
        passed = Fraction(time) - Fraction(burst.birth)
        since.append(float(passed % Fraction(burst.every)) if burst.every else min(max(float(passed), -1.0), 1000.0))
    age = np.array(since)[which]
    tall = np.array([burst.height for burst in bursts])[which]
    wide = np.array([burst.radius for burst in bursts])[which]
    middle = np.array([[a - b for a, b in zip(burst.place, origin, strict=True)] for burst in bursts])[which]
    word = pcg(pcg(index.astype(np.uint64)))
    fastest = np.sqrt(2.4 * GRAVITY * tall)
    jet = pcg(np.floor(number(word, 1) * JETS).astype(np.uint64) ^ (which.astype(np.uint64) << np.uint64(8)))
    heading, disc = (_unit(2.0 * math.pi * turn) for turn in (number(jet, 0), number(word, 2)))
    disc = np.sqrt(number(word, 3))[:, None] * disc
    rim = disc + np.array([1e-4, 0.0])
    rim /= np.hypot(rim[:, 0], rim[:, 1])[:, None]
    part, share_, late, tilt = number(word, 0), number(word, 4), number(word, 7), number(jet, 1)
    own = number(jet, 3)
    column = np.sqrt(tilt)[:, None] * heading + 0.25 * disc
    fast = fastest * (1.0 - 0.45 * tilt) * (0.6 + 0.4 * number(jet, 2)) * np.sqrt(0.02 + 0.98 * share_)
    leaning = (0.04 + 0.3 * tilt * tilt * own)[:, None] * heading + 0.04 * column
    choose = [part < 0.62, part < 0.76]

    def pick(*values: Floats) -> Floats:
        conditions = [c.reshape(c.shape + (1,) * (values[0].ndim - 1)) for c in choose]
        return np.asarray(np.select(conditions, values[:2], values[2]), np.float64)

    one = np.ones(count)
    flat = pick(
        fast[:, None] * leaning,
        (fastest * (0.1 + 0.22 * share_ * own))[:, None] * rim,
        (fastest * (0.25 + 0.35 * share_))[:, None] * rim,
    )
    upward = pick(fast, fastest * (0.2 + 0.2 * share_), 0.1 * fastest * (0.3 + share_))
    age = age - pick(0.5 * tilt * late, 0.2 * late, (0.09 + 0.07 * late) * fastest)
    place = middle + wide[:, None] * pick(0.8 * column, rim, rim)
    life = 0.25 * fastest + 2.0
    alive = (age >= 0.0) & (age < life)
    return Drops(
        birth=np.stack((place[:, 0], np.full(count, -0.3), place[:, 1]), axis=-1),
        velocity=np.stack((flat[:, 0], upward, flat[:, 1]), axis=-1),
        age=age,
        life=life,
        radius=tall * pick(0.02 + 0.035 * (1.0 - share_), 0.025 * one, 0.025 * one) * spray.size * 25.0,
        strength=np.where(alive, pick(0.35 * one, 0.3 * one, 0.22 * one), 0.0),
        kind=pick(COLUMN * one, COLUMN * one, MIST * one),
        word=word,
    )


def _unit(angle: Floats) -> Floats:
    return np.stack((np.cos(angle), np.sin(angle)), axis=-1)
