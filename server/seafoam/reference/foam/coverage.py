"""Section 5: masks and textures of foam, in cells and by its age, and the coverage of the filtered look."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seafoam.masks.catalogue import Mask, mask_by_name
from seafoam.ocean.waves.stokes import foam_drift, foam_life
from seafoam.reference import sampling
from seafoam.reference.foam import looks
from seafoam.reference.noise import PERIOD, chained, number, perlin
from seafoam.reference.types import Floats, Footprints, Pair, Rows, Vec2, smoothstep
from seafoam.reference.waves.parametric import reduced
from seafoam.scene import Foam, Scene
from seafoam.textures.foam import foam_texture

OCTAVES_MOST = 4
LATTICE = 4096
LEAST_WEIGHT = 0.25  # barycentric weight below which a cell has no influence
LAST_FREE = 1.0 / 256.0  # uncovered share below which the power is replaced by a ramp to 0
AGE = 0.8  # age between one mask and the next, in e-folds of the saturation
ROW_LENGTH = 8.0
RIDGE = 7.781
ROW_SEED = 1938


@dataclass(frozen=True, eq=False)
class Assets:
    """Masks and textures that foam reads."""

    thresholds: Floats
    """Thresholds m of the mask, (size, size), row v and column u."""
    spans: list[Floats]
    """Levels of (low, width), the range of the thresholds in each texel; level l is (size/2^l, size/2^l, 2)."""
    quantiles: Floats
    """Tables of Q, see :func:`sampling.quantile`, (1 + levels, 65): of the B-spline mask, then of each level."""
    ramps: Floats
    """Tables of an octave's ramp, (2 + levels, 65): of the B-spline mask, of each level, width over the former."""
    texture: list[Floats]
    """Box-averaged levels of the foam texture t in [0, 1]."""
    older: "tuple[Assets, ...]" = ()
    """The same of the masks of older foam."""

    @staticmethod
    def of(mask: Mask, texture: Floats, older: Sequence[Mask] = ()) -> "Assets":
        """From a mask, a foam texture (size, size) in [0, 1] and masks of older foam."""
        return Assets(
            older=tuple(Assets.of(other, texture) for other in older if other.ranks.shape == mask.ranks.shape),
            thresholds=sampling.thresholds(mask.ranks),
            spans=[level.astype(np.float64) for level in mask.spans],
            quantiles=mask.filtering.quantiles,
            ramps=mask.filtering.ramps,
            texture=sampling.box_chain(np.asarray(texture, np.float64)),
        )

    @staticmethod
    def for_scene(scene: Scene) -> "Assets | None":
        """The images of a scene's foam; None without foam. Raises ``KeyError`` or ``ValueError`` for a bad mask."""
        if scene.foam is None:
            return None
        life = foam_life(scene)
        older = [mask_by_name(name) for name in life.masks] if life is not None else []
        return Assets.of(mask_by_name(scene.foam.mask), foam_texture(), older)


@dataclass(frozen=True, eq=False)
class MaskPoints(Rows):
    """Places in a mask, (r,) in tiles, and both sides of the samples' footprints there, (r, 2) in tiles."""

    u: Floats
    v: Floats
    foot_u: Floats
    foot_v: Floats

    def finer(self) -> "MaskPoints":
        """The same places in the mask's next octave."""
        sides = (np.stack(looks.octave(foot[:, 0], foot[:, 1]), axis=-1) for foot in (self.foot_u, self.foot_v))
        return MaskPoints(*looks.octave(self.u, self.v), *sides)

    def size(self, assets: Assets) -> Floats:
        """Sides, in texels along the mask's axes, of the box with the footprint's variance; (r, 2)."""
        result: Floats = np.hypot(self.foot_u, self.foot_v) * assets.thresholds.shape[0]
        return result


def coverage(
    foam: Foam,
    assets: Assets,
    s: Floats,
    points: MaskPoints,
    *,
    filtering: bool,
    shares: bool = False,
    octaves: int = OCTAVES_MOST,
) -> Floats:
    """Coverage of the filtered look for a saturation s in [0, 1]; (r,).

    With ``filtering`` over footprints, else in the limit of infinitely many samples. ``shares``: s is already the mean
    coverage, not the saturation before the fade. ``octaves``: maximum number of octaves.
    """
    if foam.octaves == 1:
        if filtering:
            return covered(assets, s, points, foam.fade)
        b = sampling.bspline(assets.thresholds, points.u, points.v).value
        return looks.converged_coverage(s, b, assets.quantiles[0], foam.fade)
    left = s if shares else looks.ramped(s, foam.fade)
    for octave in range(min(foam.octaves, octaves)):
        if filtering:
            texels = points.size(assets).max(axis=1)
            shown = 1.0 - smoothstep(*looks.OCTAVE_SHOWN, texels) if octave else np.ones_like(s)
            left = left + shown * (covered(assets, left, points, None) - left)
        else:
            b = sampling.bspline(assets.thresholds, points.u, points.v).value
            threshold, width = (sampling.quantile(assets.ramps[row], left) for row in (0, -1))
            A = np.clip((threshold - b) / width, 0.0, 1.0) * smoothstep(0.0, looks.END, left)
            left = 1.0 - (1.0 - A) * smoothstep(0.0, looks.END, 1.0 - left)
        points = points.finer()
    return left


def covered(assets: Assets, s: Floats, points: MaskPoints, fade: float | None) -> Floats:
    """A(s) of the mask over footprints; (r,). ``fade`` None: with an octave's ramp."""
    size = points.size(assets)
    minified, magnified = np.zeros_like(s), np.zeros_like(s)
    w = looks.minification(size)
    far, near = np.flatnonzero(w > 0.0), np.flatnonzero(w < 1.0)
    tables, ramp = (assets.ramps[1:-1], looks.OCTAVE_RAMP) if fade is None else (assets.quantiles[1:], fade)
    minified[far] = looks.minified_coverage(s[far], points.u[far], points.v[far], size[far], assets.spans, tables, ramp)
    at_near = points.subset(near)
    spline = sampling.bspline(assets.thresholds, at_near.u, at_near.v)
    b, e = looks.spline_over_footprint(spline, at_near.foot_u, at_near.foot_v)
    if fade is None:
        threshold, width = (sampling.quantile(assets.ramps[row], s[near]) for row in (0, -1))
    else:
        threshold = sampling.quantile(assets.quantiles[0], s[near])
        width = looks.spline_fade(assets.quantiles[0], s[near], fade)
    magnified[near] = looks.magnified_coverage(b, e, threshold, width)
    return looks.filtered_coverage(s, minified, magnified, size, whole=fade is None or fade == 0.0)


def tiles(position: float, tile: float) -> float:
    """Position within its tile, in (−1, 1) tiles, exact before the division."""
    return math.fmod(position, tile) / tile


def mask_points(x: Floats, z: Floats, footprints: Footprints, foam: Foam, origin: Vec2) -> MaskPoints:
    """Where (x, z), m from the origin, and footprints lie in a foam's mask."""
    cosine, sine, tile = math.cos(foam.mask_angle), math.sin(foam.mask_angle), foam.mask_tile
    u = (x * cosine + z * sine) / tile + tiles(origin[0] * cosine + origin[1] * sine, tile)
    v = (z * cosine - x * sine) / tile + tiles(origin[1] * cosine - origin[0] * sine, tile)
    sides = (
        np.stack((side[:, 0] * cosine + side[:, 1] * sine, side[:, 1] * cosine - side[:, 0] * sine), axis=-1) / tile
        for side in footprints
    )
    return MaskPoints(u, v, *sides)


@dataclass(frozen=True, eq=False)
class Corner:
    """One of the three cells around each of r places."""

    weight: Floats  # (r,); the weights of the three cells sum to 1
    u: Floats  # mask coordinates, in tiles; (r,) each
    v: Floats
    cosine: Floats  # of the cell's rotation; (r,) each
    sine: Floats

    def turned(self, foot: Floats) -> Floats:
        x, y = foot[:, 0], foot[:, 1]
        return np.stack((self.cosine * x + self.sine * y, self.cosine * y - self.sine * x), axis=-1)


def corners(u: Floats, v: Floats, blended: bool) -> list[Corner]:
    """The three cells around (u, v), tiles from the world's origin; not ``blended``: the nearest has all weight."""
    a, b = u - v / math.sqrt(3.0), 2.0 / math.sqrt(3.0) * v
    i, j = np.floor(a), np.floor(b)
    s, t = a - i, b - j
    upper = s + t > 1.0
    shares = np.where(upper, (s + t - 1.0, 1.0 - t, 1.0 - s), (1.0 - s - t, s, t))
    if blended:
        weights = np.maximum(shares - LEAST_WEIGHT, 0.0) ** 4
    else:
        weights = (np.argmax(shares, axis=0) == np.arange(3)[:, None]).astype(np.float64)
    both = upper.astype(np.float64)
    offsets: tuple[tuple[Floats | float, Floats | float], ...] = ((both, both), (1.0, 0.0), (0.0, 1.0))
    around = []
    for weight, (di, dj) in zip(weights / weights.sum(axis=0), offsets, strict=True):
        word = chained(0, i + di, j + dj, period=LATTICE)
        angle = 2.0 * math.pi * number(word, 0)
        cosine, sine = -np.cos(angle), -np.sin(angle)
        x, y = (s - di) + 0.5 * (t - dj), 0.5 * math.sqrt(3.0) * (t - dj)
        place = cosine * x + sine * y + number(word, 1), cosine * y - sine * x + number(word, 2)
        around.append(Corner(weight, *place, cosine, sine))
    return around


def part(s: Floats, weight: Floats) -> Floats:
    """Coverage of a cell of weight w for a saturation s in [0, 1]: 1 − (1 − s)^w, with a ramp to 1 at s = 1; (r,)."""
    left = 1.0 - np.clip(s, 0.0, 1.0)
    return 1.0 - np.maximum(left, LAST_FREE) ** weight * smoothstep(0.0, LAST_FREE, left)


def counted(x: Floats, z: Floats, foam: Foam, origin: Vec2) -> Pair:
    """Rotated (x, z), m from the origin, in tiles from the world's, less whole periods of the lattice; (r,) each."""
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    far_u = (origin[0] * cosine + origin[1] * sine) / foam.mask_tile
    far_v = (origin[1] * cosine - origin[0] * sine) / foam.mask_tile
    rows = math.floor(far_v / (LATTICE * math.sqrt(3.0) / 2.0))
    far_v -= rows * LATTICE * math.sqrt(3.0) / 2.0
    far_u = math.fmod(far_u - rows * LATTICE / 2.0, LATTICE)
    u = (x * cosine + z * sine) / foam.mask_tile + far_u
    v = (z * cosine - x * sine) / foam.mask_tile + far_v
    return u, v


def gathered(scene: Scene, time: float, origin: Vec2, s: Floats, x: Floats, z: Floats) -> Floats:
    """The coverage s (r,) at (x, z), m from the origin, concentrated in windrows; (r,)."""
    life = foam_life(scene)
    if life is None or life.row_strength == 0.0:
        return s
    cosine, sine = math.cos(life.downwind), math.sin(life.downwind)
    across = 1.0 / life.windrow_spacing
    rows = ((cosine * across / ROW_LENGTH, sine * across / ROW_LENGTH), (-sine * across, cosine * across))
    drift, turn, cells = foam_drift(scene), 2.0 * math.pi / PERIOD, PERIOD / (2.0 * math.pi)
    place = []
    for a, b in rows:
        at_eye = reduced((turn * a, origin[0]), (turn * b, origin[1]), (-turn * (a * drift[0] + b * drift[1]), time))
        place.append(cells * at_eye + a * x + b * z)
    ridge = np.maximum(1.0 - RIDGE * np.abs(perlin(np.column_stack(place), ROW_SEED)[0]), -1.0)
    return s + life.row_strength * ridge * s * (1.0 - s)


def shares(masks: int, s: Floats, f: Floats) -> list[Pair]:
    """How the coverage s (r,) of foam of saturation f (r,) in [0, 1] is divided among masks by its age: of each mask,
    the foam's own first, the weight, 0 where it has no foam, and the share of the plane; (r,) each."""
    if masks == 1:
        return [(np.ones_like(s), s)]
    age = np.clip(-np.log(np.maximum(f, 1e-6)) / AGE, 0.0, masks - 1.0)
    young = np.minimum(np.floor(age), masks - 2.0)
    older = smoothstep(0.35, 0.65, age - young)
    result = []
    for mask in range(masks):
        weight = np.where(young == mask, 1.0 - older, np.where(young + 1.0 == mask, older, 0.0))
        result.append((weight, part(s, weight)))
    return result


def drifted(scene: Scene, time: float, origin: Vec2) -> Vec2:
    """Mask coordinates (u, v) of the origin, moved back along the drift; tiles in [0, 1)."""
    foam = scene.foam
    assert foam is not None
    drift, turn = foam_drift(scene), 2.0 * math.pi
    cosine, sine = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    rates = -turn * (cosine * drift[0] + sine * drift[1]), -turn * (cosine * drift[1] - sine * drift[0])
    u = reduced((turn * cosine, origin[0]), (turn * sine, origin[1]), (rates[0], time))
    v = reduced((-turn * sine, origin[0]), (turn * cosine, origin[1]), (rates[1], time))
    return u / turn, v / turn
