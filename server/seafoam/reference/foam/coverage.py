"""Section 5: coverage of the filtered look, over footprints and in the limit; coordinates of a mask."""

from __future__ import annotations

import math

import numpy as np

from seafoam.reference import sampling
from seafoam.reference.foam import looks
from seafoam.reference.renderer.assets import Assets
from seafoam.reference.types import Floats
from seafoam.scene.foam import Foam

OCTAVES_MOST = 4


def coverage(
    foam: Foam,
    assets: Assets,
    s: Floats,
    u: Floats,
    v: Floats,
    foot_u: Floats,
    foot_v: Floats,
    *,
    filtering: bool,
    shares: bool = False,
    octaves: int = OCTAVES_MOST,
) -> Floats:
    """Coverage of the filtered look at mask coordinates (u, v), in tiles, for a saturation s in [0, 1]; (r,).

    With ``filtering`` over footprints (r, 2), else in the limit of infinitely many samples. ``shares``: s is already
    the mean coverage, not the saturation before the fade. ``octaves``: maximum number of octaves.
    """
    if foam.octaves == 1:
        if filtering:
            return covered(assets, s, u, v, foot_u, foot_v, foam.fade)
        b = sampling.bspline(assets.thresholds, u, v).value
        return looks.converged_coverage(s, b, assets.quantiles[0], foam.fade)
    left = s if shares else looks.faded(s, foam.fade)
    for number in range(min(foam.octaves, octaves)):
        if filtering:
            size = np.hypot(foot_u, foot_v) * assets.thresholds.shape[0]
            shown = looks.octave_shown(size) if number else np.ones_like(s)
            own = covered(assets, left, u, v, foot_u, foot_v, None)
            left = left + shown * (own - left)
        else:
            b = sampling.bspline(assets.thresholds, u, v).value
            threshold, width = (sampling.quantile(assets.ramps[row], left) for row in (0, -1))
            left = looks.converged_octave(left, b, threshold, width)
        u, v = looks.octave(u, v)
        foot_u, foot_v = (np.stack(looks.octave(foot[:, 0], foot[:, 1]), axis=-1) for foot in (foot_u, foot_v))
    return left


def covered(
    assets: Assets, s: Floats, u: Floats, v: Floats, foot_u: Floats, foot_v: Floats, fade: float | None
) -> Floats:
    """A(s) of the mask at (u, v), in tiles, over footprints (r, 2); (r,). ``fade`` None: with an octave's ramp."""
    # Sides of the box with the footprint's variance along the mask's axes.
    size = np.hypot(foot_u, foot_v) * assets.thresholds.shape[0]
    minified, magnified = np.zeros_like(s), np.zeros_like(s)
    w = looks.minification(size)
    far, near = np.flatnonzero(w > 0.0), np.flatnonzero(w < 1.0)
    tables, ramp = (assets.ramps[1:-1], looks.OCTAVE_RAMP) if fade is None else (assets.quantiles[1:], fade)
    minified[far] = looks.minified_coverage(s[far], u[far], v[far], size[far], assets.spans, tables, ramp)
    b, e = looks.spline_over_footprint(
        sampling.bspline(assets.thresholds, u[near], v[near]), foot_u[near], foot_v[near]
    )
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


def mask_place(x: Floats, z: Floats, foam: Foam, origin: tuple[float, float]) -> tuple[Floats, Floats]:
    """Mask coordinates (u, v) of (x, z), m from the origin; (r,) each, in tiles."""
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    tile = foam.mask_tile
    u = (x * cosine + z * sine) / tile + tiles(origin[0] * cosine + origin[1] * sine, tile)
    v = (z * cosine - x * sine) / tile + tiles(origin[1] * cosine - origin[0] * sine, tile)
    return u, v


def turned_footprint(foot: Floats, foam: Foam) -> Floats:
    """A footprint (r, 2) m in mask coordinates; (r, 2), in tiles."""
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    x, z = foot[:, 0], foot[:, 1]
    result: Floats = np.stack((x * cosine + z * sine, z * cosine - x * sine), axis=-1) / foam.mask_tile
    return result
