"""Section 5: masks and textures of foam, and the coverage of the filtered look, over footprints and in the limit."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seafoam.masks.catalogue import Mask, mask_by_name
from seafoam.ocean.waves.stokes import foam_life
from seafoam.reference import sampling
from seafoam.reference.foam import looks
from seafoam.reference.types import Floats, Footprints, Rows, Vec2
from seafoam.scene import Foam, Scene
from seafoam.textures.foam import foam_texture

OCTAVES_MOST = 4


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
    for number in range(min(foam.octaves, octaves)):
        if filtering:
            shown = looks.octave_shown(points.size(assets)) if number else np.ones_like(s)
            left = left + shown * (covered(assets, left, points, None) - left)
        else:
            b = sampling.bspline(assets.thresholds, points.u, points.v).value
            threshold, width = (sampling.quantile(assets.ramps[row], left) for row in (0, -1))
            left = looks.converged_octave(left, b, threshold, width)
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
