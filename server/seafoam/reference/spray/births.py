"""Section 13: the drops of a scene's spray that are in the air at a time, as they were at birth.

Births are no independent form: they repeat ``shaders/spray`` hash by hash, so that a frame has the same drops as the
picture that it judges, in float64. What judges births are their statistics and the float64 surface on which they start
(``tests/gpu/reference/test_spray.py``).
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam import spray as shared
from seafoam.ocean.foam.spray import BATCHES, CELLS, CLUSTER, EPOCHS, LEVELS, MOMENT, SEA_TEXELS
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.reference.noise import Words, chained, number, pcg
from seafoam.reference.shore.maps import SWASH, rhythm
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats, Relief, Rows, Vec2, dot, smoothstep
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import coefficients, grids, sea_surface
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray

SHEET, MIST, DRIFT, COLUMN = 0.0, 1.0, 2.0, 3.0  # kinds of drops
JETS = 48
DELAY = 1.5  # longest time from a crest to a drop at rocks, s
SPOT, JET = 6.0, 1.5  # sides of the squares of coast that emit drops at the same time, and in the same way, m
CREST_SLOPE2 = 0.02  # least squared slope of a wave by which the speed of its front is divided
Breaking = tuple[Floats, Floats, Floats, Floats]
"""How hard water breaks (...), where it is (..., 2), and the velocity (..., 3) and strength (...) of the front."""


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


def drops(scene: Scene, time: float, origin: Vec2, ahead: Floats, coast: Coast | None) -> Drops | None:
    """The drops of a scene's spray in the air; None where nothing can throw any.

    ``ahead``: (2,) x and z of the ray through the picture's centre.
    """
    spray = scene.spray
    assert spray is not None
    sources = [from_bursts(spray, time, origin)] if spray.bursts else []
    still = sum(wave.amplitude for wave in scene.waves) == 0.0 and _limits(scene) is None
    if coast is not None and on_rocks(scene):
        sources.append(from_rocks(scene, coast, time, origin))
    elif coast.shore.surf.height > 0.0 if coast is not None else not still:
        # A batch is born at the start of each interval; drop i is of batch i modulo their number.
        step = spray.life / BATCHES
        whole, left = cycles(time, step)
        waters = [_Waters(scene, spray, time, (left + batch) * step, origin, coast) for batch in range(BATCHES)]
        parts = joined([_batch(one, ahead, batch, whole - batch) for batch, one in enumerate(waters)])
        sources.append(parts.subset(np.arange(DROPS).reshape(BATCHES, -1).T.ravel()))
    if not sources:
        return None
    # Of two sources each has half of the drops.
    both = joined([drops.subset(np.arange(DROPS // len(sources))) for drops in sources])
    return both.subset(both.strength > 0.0)


def cycles(time: float, period: float) -> tuple[int, float]:
    """Number of whole periods since time 0, and the fraction of the current one."""
    whole, left = divmod(Fraction(time) / Fraction(period), 1)
    return int(whole), float(left)


def from_bursts(spray: Spray, time: float, origin: Vec2) -> Drops:
    """Drops of blasts under the water, by index, with a strength of 0 where there is none."""
    index = np.arange(DROPS)
    which = index % len(spray.bursts)
    ages = [
        float((Fraction(time) - Fraction(burst.birth)) % Fraction(burst.every))
        if burst.every
        else min(max(time - burst.birth, -1.0), 1000.0)
        for burst in spray.bursts
    ]
    of_bursts = [(*burst.place, burst.height, burst.radius, age) for burst, age in zip(spray.bursts, ages, strict=True)]
    x, z, tall, wide, age = np.array(of_bursts)[which].T
    word = pcg(pcg(index.astype(np.uint64)))
    fastest = np.sqrt(2.4 * GRAVITY * tall)
    jet = pcg(np.floor(number(word, 1) * JETS).astype(np.uint64) ^ (which.astype(np.uint64) << np.uint64(8)))
    turns = 2.0 * math.pi * np.stack((number(jet, 0), number(word, 2)))
    heading, disc = np.stack((np.cos(turns), np.sin(turns)), axis=-1)
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
        return np.stack(values)[family, index]

    flat = pick(
        fast[:, None] * leaning,
        (fastest * (0.1 + 0.22 * share * own))[:, None] * rim,
        (fastest * (0.25 + 0.35 * share))[:, None] * rim,
    )
    upward = pick(fast, fastest * (0.2 + 0.2 * share), 0.1 * fastest * (0.3 + share))
    age = age - pick(0.5 * tilt * late, 0.2 * late, (0.09 + 0.07 * late) * fastest)
    place = np.stack((x, z), axis=-1) - origin + wide[:, None] * pick(0.8 * column, rim, rim)
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


def on_rocks(scene: Scene) -> bool:
    shore, spray = scene.shore, scene.spray
    return shore is not None and spray is not None and shore.surf.height > 0.0 and len(rocks(shore, spray.steep)) > 0


def from_rocks(scene: Scene, coast: Coast, time: float, origin: Vec2) -> Drops:
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
    counted = ((np.floor(turn).astype(np.int64) - whole) % EPOCHS).astype(np.uint64)
    word = pcg(own ^ counted)
    burst, thrown = (chained(0, *np.floor(q / side).T, counted) for side in (SPOT, JET))
    delay = DELAY * (0.7 * number(burst, 0) + 0.3 * number(word, 1))
    age = (1.0 - (turn - np.floor(turn))) * period - delay
    strong = 0.3 + 0.7 * number(burst, 1)
    start = spray.speed * np.sqrt(GRAVITY * np.maximum(field[:, 1], 0.0) / SWASH) * strong
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


def _swell_then(scene: Scene, time: float, origin: Vec2, place: Floats, age: Floats) -> Floats:
    """Height of single waves and rings ages (n,) ago at places (n, 2) from the camera, m."""
    total = np.zeros_like(age)
    if scene.waves:
        total += wave_set(scene, time, origin).height(place[:, 0], place[:, 1], age)
    for i in range(len(age) if scene.rings else 0):
        total[i] += ring_set(scene, time - float(age[i]), origin).height(*place[i, :, None])[0]
    return total


def _limits(scene: Scene) -> Vec2 | None:
    """Divergence of the sea below which it throws drops, and the width of the change; None: it throws none."""
    if scene.sea is None or scene.spray is None:
        return None
    return shared.fold_limits(scene.sea, scene.spray, scene.water.depth)


@dataclass(frozen=True, eq=False)
class _Waters:
    """The open water at one birth, or the surf of a beach."""

    scene: Scene
    spray: Spray
    now: float
    age: float  # how long before ``now`` the birth was, s
    origin: Vec2
    coast: Coast | None  # the shore now

    @property
    def time(self) -> float:
        """Of the birth, s."""
        return self.now - self.age

    @cached_property
    def tiles(self) -> list[tuple[Floats, Floats, Floats, float, float]]:
        """Of each raised tile of the sea coefficients of displacement (m) and divergence, side (m), choppiness."""
        sea, result = self.scene.sea, []
        assert sea is not None
        for each in cascades(sea, self.scene.water.depth)[:RAISED]:
            field = grids(each, self.time, SEA_TEXELS)
            chop = each.choppiness(sea.choppiness)
            d_x, d_z, folds = (coefficients(part) for part in (field.d_x, field.d_z, chop * (field.xx + field.zz)))
            result.append((d_x, d_z, folds, each.size, chop))
        return result

    def breaks(self, p: Floats) -> Breaking:
        """How the water breaks that rests at p (..., 2), m from the origin."""
        if self.coast is not None:
            return self._surf(self.coast, p)
        folds, p, onward, strong = self._sea(p)
        if not self.scene.waves:
            return folds, p, onward, strong
        waves = wave_set(self.scene, self.time, self.origin)
        x, z = p.reshape(-1, 2).T
        rise = waves.rise(x, z).reshape(folds.shape)
        slope = waves.gradient(x, z).T.reshape(*folds.shape, 2)
        steep = self._steep(rise)
        level = -slope * (rise / np.maximum(dot(slope, slope), CREST_SLOPE2))[..., None]
        front = steep > folds
        onward = np.where(front[..., None], np.insert(level, 1, rise, axis=-1), onward)
        return np.maximum(folds, steep), p, onward, np.where(front, 1.0, strong)

    def _sea(self, p: Floats) -> Breaking:
        sea, limits, total = self.scene.sea, _limits(self.scene), np.zeros(p.shape[:-1])
        onward = np.zeros((*total.shape, 3))
        if sea is None:
            return total, p, onward, total
        if limits is not None:
            for i, (d_x, d_z, folds, size, chop) in enumerate(self.tiles):
                at = (p + np.fmod(self.origin, size)) / size * SEA_TEXELS
                column, row = np.moveaxis(np.floor(at + 0.5).astype(np.int64) % SEA_TEXELS, -1, 0)
                total = total + folds[row, column]
                if i == 0:
                    p = p + chop * np.stack((d_x[row, column], d_z[row, column]), axis=-1)
            total = (limits[0] - total) / limits[1]
        crest, strength = shared.crest_velocity(sea), shared.crest_strength(sea)
        onward[..., ::2] = crest
        onward[..., 1] = (0.2 + 0.3 * np.clip(total, 0.0, 1.0)) * (math.hypot(*crest) * strength)
        return total, p, onward, np.full(total.shape, strength)

    def _surf(self, coast: Coast, p: Floats) -> Breaking:
        shape, period = p.shape[:-1], coast.shore.surf.period
        q = p.reshape(-1, 2) + np.array(coast.offset)
        field, change = coast.field.all(q[:, 0], q[:, 1])
        # The birth's time is rounded, and so is its age from it.
        age = self.now - self.time
        ends = [surf_then(coast, q, field, np.full(len(q), age + side * MOMENT), self.now) for side in (-1.0, 1.0)]
        rise = (ends[0] - ends[1]) / (2.0 * MOMENT)
        slope = change[..., 0].T
        level = -slope / (np.maximum(dot(slope, slope), 1e-4) * period)[:, None]
        outside = (np.abs(q) > 0.5 * coast.shore.size).any(axis=-1) | (field[:, 1] <= 0.0)
        steep = np.where(outside, 0.0, self._steep(rise))
        onward = np.insert(level, 1, rise, axis=-1)
        return steep.reshape(shape), p, onward.reshape(*shape, 3), np.ones(shape)

    def _steep(self, rise: Floats) -> Floats:
        """How hard water breaks that rises at speeds in m/s."""
        return 2.0 * (rise / max(self.spray.threshold, 0.1) - 1.0)

    def height(self, x: Floats, z: Floats) -> Floats:
        """Height of the surface, m."""
        # What foam needs of the sea's past is not needed here.
        at = self.scene.model_copy(update={"foam": None}), self.time, self.origin
        parts = wave_set(*at), ring_set(*at), sea_surface(*at)
        relief = Relief(part for part in parts if part is not None)
        if self.coast is None:
            return relief.height(x, z)
        return Coast(self.coast.shore, self.time, self.origin, relief).height(x, z)


def _batch(waters: _Waters, ahead: Floats, batch: int, epoch: int) -> Drops:
    """The drops of a batch. ``epoch``: its number since time 0."""
    spray, sea = waters.spray, waters.scene.sea if waters.coast is None else None
    # The drops of a batch are divided among grids of cells, and those of a cell among clusters.
    index = np.arange(batch, DROPS, BATCHES)
    level, rest = index // BATCHES % LEVELS, index // (BATCHES * LEVELS)
    sides = shared.cell_sides(spray)
    side, member = np.array(sides)[level], rest // (CELLS * CELLS)
    eye = np.mod([[float(Fraction(part) / Fraction(size)) for part in waters.origin] for size in sides], 256.0)[level]
    cell = np.stack((rest % CELLS, rest // CELLS % CELLS), axis=-1)
    cell = cell + np.floor(eye + 0.35 * CELLS * ahead - 0.5 * CELLS + 0.5).astype(np.int64)

    cluster = chained(0, member // CLUSTER * LEVELS + level, *(cell & 255).T, epoch % EPOCHS)
    word = pcg(cluster ^ (member % CLUSTER).astype(np.uint64))

    # A cluster starts where, of some places of its cell, the water breaks hardest; its drops beside each other.
    looked = 16 + 2 * np.arange(shared.PLACES)
    chance = np.stack([number(cluster[:, None], looked + i) for i in (0, 1)], axis=-1)
    candidates = (cell[:, None] + chance - eye[:, None]) * side[:, None, None]
    found = waters.breaks(candidates)[0]
    best = np.arange(index.size), np.argmax(found, axis=1)
    angle = 0.0 if sea is None or sea.wind_speed <= 0.0 else sea.downwind
    heading = np.array([math.cos(angle), math.sin(angle)])
    apart = np.stack((number(word, 12), number(word, 13)), axis=-1) - 0.5
    apart = shared.BESIDE * side[:, None] * apart * (0.25, 1.0)
    start = candidates[best] + apart[:, :1] * heading + apart[:, 1:] * np.array([-heading[1], heading[0]])
    most, place, onward, strong = waters.breaks(start)

    # A grid has all drops of places at one distance, which fade to those of the next; the finest has all nearer ones.
    middle = 0.5 * spray.reach * np.exp2(level - LEVELS + 1.0)
    steps = np.log2(np.maximum(np.hypot(place[:, 0], place[:, 1]), 0.01) / middle)
    share = np.where((level == 0) & (steps < 0.0), 1.0, np.maximum(1.0 - np.abs(steps), 0.0))
    strength = np.where(found[best] > 0.0, strong * smoothstep(0.25, 0.7, most) * share, 0.0)
    height, born = np.zeros(index.size), strength > 0.0
    height[born] = waters.height(place[born, 0], place[born, 1])

    torn, chosen = 0.0 if sea is None else shared.torn_share(sea, spray), number(word, 5)
    kind = np.where(chosen < torn, DRIFT, np.where(chosen < torn + (1.0 - torn) * spray.mist, MIST, SHEET))
    return Drops(
        birth=np.insert(place, 1, height, axis=1),
        velocity=_velocities(spray, onward, kind, cluster, word),
        age=np.full(index.size, waters.age),
        life=np.full(index.size, spray.life),
        radius=1.4 * spray.size * side * (0.4 + 0.6 * strong),
        strength=strength,
        kind=kind,
        word=word,
    )


def _velocities(spray: Spray, onward: Floats, kind: Floats, cluster: Words, word: Words) -> Floats:
    """Velocities (n, 3) of drops that fronts of velocities ``onward`` (n, 3) throw: a cluster flies together."""
    rise = spray.speed * onward[:, 1] * np.where(kind == DRIFT, 0.4, 1.0)
    upward = rise * (0.3 + 0.7 * number(cluster, 1)) * (0.3 + 0.7 * number(word, 1))
    aside = 0.3 * (number(cluster, 2) + number(word, 2) - 1.0)
    ahead_by = 0.8 + 0.2 * number(cluster, 4) + 0.2 * number(word, 4)
    across = np.stack((-onward[:, 2], onward[:, 0]), axis=-1)
    return np.insert(onward[:, ::2] * ahead_by[:, None] + aside[:, None] * across, 1, upward, axis=1)
