"""Section 13: all drops of a scene, and those that breaking waves throw up, in the open and on a beach."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from seafoam.ocean.foam import spray as shared
from seafoam.ocean.foam.spray import BATCHES, CELLS, CLUSTER, EPOCHS, LEVELS, MOMENT, SEA_TEXELS
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.reference.noise import Words, chained, number, pcg
from seafoam.reference.renderer.relief import Relief, ReliefPart
from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray import births
from seafoam.reference.spray.births import DRIFT, MIST, SHEET, Drops, surf_then
from seafoam.reference.types import Floats, dot, smoothstep
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import SeaSurface, coefficients, grids, tile
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS, Spray

CREST_SLOPE2 = 0.02
"""Least squared slope of a wave by which the speed of its front is divided."""
Breaking = tuple[Floats, Floats, Floats, Floats]
"""How hard water breaks (...), where it is (..., 2), and the velocity (..., 3) and strength (...) of the front."""


def _limits(scene: Scene) -> tuple[float, float] | None:
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
    age: float
    """How long before ``now`` the birth was, s."""
    origin: tuple[float, float]
    coast: Coast | None
    """The shore now."""

    @cached_property
    def time(self) -> float:
        """Of the birth, s."""
        return float(Fraction(self.now) - Fraction(self.age))

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
        return self._surf(self.coast, p) if self.coast is not None else self._waves(*self._sea(p))

    def _sea(self, p: Floats) -> Breaking:
        """How a sea without single waves does."""
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

    def _waves(self, folds: Floats, p: Floats, onward: Floats, strong: Floats) -> Breaking:
        """How it does with the scene's single waves."""
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

    def _steep(self, rise: Floats) -> Floats:
        """How hard water breaks that rises at speeds in m/s."""
        return 2.0 * (rise / max(self.spray.threshold, 0.1) - 1.0)

    def _surf(self, coast: Coast, p: Floats) -> Breaking:
        """How surf breaks on a beach."""
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

    def height(self, x: Floats, z: Floats) -> Floats:
        """Height of the surface, m."""
        at, sea = (self.scene, self.time, self.origin), self.scene.sea
        parts: list[ReliefPart] = [wave_set(*at), ring_set(*at)]
        if sea is not None and sea.wind_speed > 0.0:
            raised = cascades(sea, self.scene.water.depth)[:RAISED]
            tiles = tuple(tile(one, self.time, sea.choppiness) for one in raised)
            parts.append(SeaSurface(tiles, raised, self.origin, ()))
        relief = Relief(parts)
        if self.coast is None:
            return relief.height(x, z)
        return Coast(self.coast.shore, self.time, self.origin, relief).height(x, z)


def drops(scene: Scene, time: float, origin: tuple[float, float], ahead: Floats, coast: Coast | None) -> Drops | None:
    """The drops of a scene's spray in the air; None where nothing can throw any.

    ``ahead``: (2,) x and z of the ray through the picture's centre.
    """
    spray = scene.spray
    assert spray is not None
    sources = [births.from_bursts(spray, time, origin)] if spray.bursts else []
    still = sum(wave.amplitude for wave in scene.waves) == 0.0 and _limits(scene) is None
    if coast is not None and births.on_rocks(scene):
        sources.append(births.from_rocks(scene, coast, time, origin))
    elif coast.shore.surf.height > 0.0 if coast is not None else not still:
        sources.append(from_waves(scene, spray, time, origin, ahead, coast))
    if not sources:
        return None
    # Of two sources each has half of the drops.
    both = births.joined([drops.subset(np.arange(DROPS // len(sources))) for drops in sources])
    return both.subset(both.strength > 0.0)


def from_waves(
    scene: Scene, spray: Spray, time: float, origin: tuple[float, float], ahead: Floats, coast: Coast | None
) -> Drops:
    """Drops that breaking waves throw up, by index, with a strength of 0 where there is none; at a shore, its surf."""
    step = spray.life / BATCHES
    whole, left = births.cycles(time, step)
    parts = [
        _batch(_Waters(scene, spray, time, (left + batch) * step, origin, coast), ahead, batch, whole - batch)
        for batch in range(BATCHES)
    ]
    index = np.concatenate([np.arange(batch, DROPS, BATCHES) for batch in range(BATCHES)])
    return births.joined(parts).subset(np.argsort(index, kind="stable"))


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
