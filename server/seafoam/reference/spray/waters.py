"""Section 13: drops that breaking waves throw up, in the open and on a beach."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from seafoam.ocean.foam.spray import (
    BATCHES,
    BESIDE,
    CELLS,
    CLUSTER,
    EPOCHS,
    LEVELS,
    MOMENT,
    PLACES,
    SEA_TEXELS,
    cell_sides,
    crest_strength,
    crest_velocity,
    fold_limits,
    torn_share,
)
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.reference.noise import Words, chained, number, pcg
from seafoam.reference.renderer.relief import Relief, ReliefPart
from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray.drop import DRIFT, MIST, SHEET, Drops, cycles, joined
from seafoam.reference.spray.rocks import surf_then
from seafoam.reference.types import Bools, Floats, dot, smoothstep
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import coefficients, grids, raised_surface
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray
from seafoam.scene.waves import Sea

CREST_SLOPE2 = 0.02


@dataclass(frozen=True, eq=False)
class _Sea:
    """The sea at one birth: of each raised tile coefficients of displacement (m) and divergence, side, choppiness."""

    tiles: tuple[tuple[Floats, Floats, Floats, float, float], ...]
    origin: tuple[float, float]
    threshold: float
    width: float

    @classmethod
    def of(cls, scene: Scene, time: float, origin: tuple[float, float]) -> _Sea | None:
        sea = scene.sea
        limits = (
            None
            if sea is None or sea.wind_speed <= 0.0 or scene.spray is None
            else fold_limits(sea, scene.spray, scene.water.depth)
        )
        if sea is None or limits is None:
            return None
        tiles = []
        for each in cascades(sea, scene.water.depth)[:RAISED]:
            field = grids(each, time, SEA_TEXELS)
            chop = each.choppiness(sea.choppiness)
            parts = (field.d_x, field.d_z, chop * (field.xx + field.zz))
            d_x, d_z, folds = (coefficients(part) for part in parts)
            tiles.append((d_x, d_z, folds, each.size, chop))
        return cls(tuple(tiles), origin, *limits)

    def breaks(self, p: Floats) -> tuple[Floats, Floats]:
        """How hard the sea breaks where water rests at p (n, 2), and where that water is."""
        total, now = np.zeros(p.shape[:-1]), p
        for i, (d_x, d_z, folds, size, chop) in enumerate(self.tiles):
            place = [
                np.floor((now[..., j] + math.fmod(self.origin[j], size)) / size * SEA_TEXELS + 0.5).astype(np.int64)
                for j in (0, 1)
            ]
            texel = place[1] % SEA_TEXELS, place[0] % SEA_TEXELS
            total += folds[texel]
            if i == 0:
                now = now + chop * np.stack((d_x[texel], d_z[texel]), axis=-1)
        return (self.threshold - total) / self.width, now


@dataclass(frozen=True, eq=False)
class _Waters:
    """The open water at one birth, or the surf of a beach."""

    scene: Scene
    spray: Spray
    age: float
    """How long ago the birth was, s."""
    time: float
    """Of the birth, s."""
    now: float
    origin: tuple[float, float]
    sea: _Sea | None
    coast: Coast | None
    """The shore now."""

    @classmethod
    def of(cls, scene: Scene, now: float, age: float, origin: tuple[float, float], coast: Coast | None) -> _Waters:
        assert scene.spray is not None
        then = float(Fraction(now) - Fraction(age))
        sea = None if coast is not None else _Sea.of(scene, then, origin)
        return cls(scene, scene.spray, age, then, now, origin, sea, coast)

    @property
    def wind(self) -> Sea | None:
        """The sea whose wind throws the drops; None on a beach and without wind."""
        sea = self.scene.sea
        return None if self.coast is not None or sea is None or sea.wind_speed <= 0.0 else sea

    def breaks(self, p: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """How hard the water breaks that rests at p (n, 2), where it is, the front's velocity (n, 3) and strength."""
        if self.coast is not None:
            return self._surf(self.coast, p)
        crest = (0.0, 0.0) if self.scene.sea is None else crest_velocity(self.scene.sea)
        folds, p = (np.zeros(p.shape[:-1]), p) if self.sea is None else self.sea.breaks(p)
        strength = 0.0 if self.scene.sea is None else crest_strength(self.scene.sea)
        strong, speed = np.full(folds.shape, strength), math.hypot(*crest) * strength
        onward = np.stack(
            (
                np.full(folds.shape, crest[0]),
                (0.2 + 0.3 * np.clip(folds, 0.0, 1.0)) * speed,
                np.full(folds.shape, crest[1]),
            ),
            axis=-1,
        )
        if not self.scene.waves:
            return folds, p, onward, strong
        waves = wave_set(self.scene, self.time, self.origin)
        x, z = p[..., 0].ravel(), p[..., 1].ravel()
        rise = waves.rise(x, z).reshape(folds.shape)
        slope = np.stack(waves.gradient(x, z), axis=-1).reshape(*folds.shape, 2)
        steep = 2.0 * (rise / max(self.spray.threshold, 0.1) - 1.0)
        level = -slope * (rise / np.maximum(dot(slope, slope), CREST_SLOPE2))[..., None]
        fronts = np.stack((level[..., 0], rise, level[..., 1]), axis=-1)
        front = steep > folds
        return np.maximum(folds, steep), p, np.where(front[..., None], fronts, onward), np.where(front, 1.0, strong)

    def _surf(self, coast: Coast, p: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """The same of surf on a beach."""
        shape, period = p.shape[:-1], coast.shore.surf.period
        q = p.reshape(-1, 2) + np.array(coast.offset)
        field, map_x, map_z = coast.field.all(q[:, 0], q[:, 1])
        age = self.now - self.time
        ends = [surf_then(coast, q, field, np.full(len(q), age + side * MOMENT), self.now) for side in (-1.0, 1.0)]
        rise = (ends[0] - ends[1]) / (2.0 * MOMENT)
        slope = np.stack((map_x[:, 0], map_z[:, 0]), axis=-1)
        level = -slope / (np.maximum(dot(slope, slope), 1e-4) * period)[:, None]
        steep = 2.0 * (rise / max(self.spray.threshold, 0.1) - 1.0)
        steep = np.where((np.abs(q) > 0.5 * coast.shore.size).any(axis=-1) | (field[:, 1] <= 0.0), 0.0, steep)
        onward = np.stack((level[:, 0], rise, level[:, 1]), axis=-1)
        return steep.reshape(shape), p, onward.reshape(*shape, 3), np.ones(shape)

    def height(self, x: Floats, z: Floats) -> Floats:
        """Height of the surface, m."""
        raised = raised_surface(self.scene, self.time, self.origin)
        parts: tuple[ReliefPart, ...] = (
            wave_set(self.scene, self.time, self.origin),
            ring_set(self.scene, self.time, self.origin),
            *(() if raised is None else (raised,)),
        )
        relief = Relief(parts)
        if self.coast is None:
            return relief.height(x, z)
        return Coast(self.coast.shore, self.time, self.origin, relief).height(x, z)


def from_waves(
    scene: Scene, time: float, origin: tuple[float, float], ahead: Floats, coast: Coast | None
) -> list[Drops]:
    """Drops that breaking waves throw up, by index, with a strength of 0 where there is none; at a shore, its surf.

    Empty where no wave can break.
    """
    spray = scene.spray
    assert spray is not None
    still = sum(wave.amplitude for wave in scene.waves) == 0.0
    calm = coast is not None and coast.shore.surf.height == 0.0
    if calm or (coast is None and still and _Sea.of(scene, time, origin) is None):
        return []
    step = spray.life / BATCHES
    whole, left = cycles(time, step)
    parts = []
    for batch in range(BATCHES):
        waters = _Waters.of(scene, time, (left + batch) * step, origin, coast)
        parts.append(_batch(waters, ahead, batch, whole - batch))
    index = np.concatenate([np.arange(batch, DROPS, BATCHES) for batch in range(BATCHES)])
    return [joined(parts).subset(np.argsort(index, kind="stable"))]


def _batch(waters: _Waters, ahead: Floats, batch: int, epoch: int) -> Drops:
    """The drops of a batch. ``epoch``: its number since time 0."""
    spray, origin = waters.spray, waters.origin
    # The drops of a batch are divided among grids of cells, and those of a cell among clusters.
    index = np.arange(batch, DROPS, BATCHES)
    level, rest = index // BATCHES % LEVELS, index // (BATCHES * LEVELS)
    side, member = np.array(cell_sides(spray))[level], rest // (CELLS * CELLS)
    eye = np.stack([np.mod([float(Fraction(part) / Fraction(s)) for s in cell_sides(spray)], 256.0) for part in origin])
    eye = eye.T[level]
    cell = np.stack((rest % CELLS, rest // CELLS % CELLS), axis=-1)
    cell = cell + np.floor(eye + 0.35 * CELLS * ahead - 0.5 * CELLS + 0.5).astype(np.int64)

    cluster = chained(0, member // CLUSTER * LEVELS + level, *(cell & 255).T, epoch % EPOCHS)
    word = pcg(cluster ^ (member % CLUSTER).astype(np.uint64))

    # A cluster starts where, of some places of its cell, the water breaks hardest; its drops beside each other.
    looked = 16 + 2 * np.arange(PLACES)
    chance = np.stack([number(cluster[:, None], looked + i) for i in (0, 1)], axis=-1)
    candidates = (cell[:, None] + chance - eye[:, None]) * side[:, None, None]
    found = waters.breaks(candidates)[0]
    best = np.arange(index.size), np.argmax(found, axis=1)
    angle = 0.0 if waters.wind is None else waters.wind.downwind
    heading = np.array([math.cos(angle), math.sin(angle)])
    apart = BESIDE * side[:, None] * (np.stack((number(word, 12), number(word, 13)), axis=-1) - 0.5) * (0.25, 1.0)
    start = candidates[best] + apart[:, :1] * heading + apart[:, 1:] * np.array([-heading[1], heading[0]])
    most, place, onward, strong = waters.breaks(start)

    far = np.hypot(place[:, 0], place[:, 1])
    middle = 0.5 * spray.reach * np.exp2(level - LEVELS + 1.0)
    strength = strong * smoothstep(0.25, 0.7, most) * _share(far, middle, level == 0)
    strength = np.where(found[best] > 0.0, strength, 0.0)
    height, born = np.zeros(index.size), strength > 0.0
    height[born] = waters.height(place[born, 0], place[born, 1])
    kind = _kinds(spray, waters.wind, word)
    return Drops(
        birth=np.stack((place[:, 0], height, place[:, 1]), axis=-1),
        velocity=_velocities(spray, onward, kind, cluster, word),
        age=np.full(index.size, waters.age),
        life=np.full(index.size, spray.life),
        radius=1.4 * spray.size * side * (0.4 + 0.6 * strong),
        strength=strength,
        kind=kind,
        word=word,
    )


def _kinds(spray: Spray, sea: Sea | None, word: Words) -> Floats:
    """Kinds of drops (n,)."""
    torn = 0.0 if sea is None else torn_share(sea, spray)
    chosen = number(word, 5)
    return np.where(chosen < torn, DRIFT, np.where(chosen < torn + (1.0 - torn) * spray.mist, MIST, SHEET))


def _velocities(spray: Spray, onward: Floats, kind: Floats, cluster: Words, word: Words) -> Floats:
    """Velocities (n, 3) of drops that fronts of velocities ``onward`` (n, 3) throw: a cluster flies together."""
    rise = spray.speed * onward[:, 1] * np.where(kind == DRIFT, 0.4, 1.0)
    upward = rise * (0.3 + 0.7 * number(cluster, 1)) * (0.3 + 0.7 * number(word, 1))
    aside = 0.3 * (number(cluster, 2) + number(word, 2) - 1.0)
    ahead_by = 0.8 + 0.2 * number(cluster, 4) + 0.2 * number(word, 4)
    across = np.stack((-onward[:, 2], onward[:, 0]), axis=-1)
    flat = onward[:, ::2] * ahead_by[:, None] + aside[:, None] * across
    return np.stack((flat[:, 0], upward, flat[:, 1]), axis=-1)


def _share(far: Floats, middle: Floats, nearest: Bools) -> Floats:
    """Share of a place's drops that a grid has."""
    steps = np.log2(np.maximum(far, 0.01) / middle)
    return np.where(nearest & (steps < 0.0), 1.0, np.maximum(1.0 - np.abs(steps), 0.0))
