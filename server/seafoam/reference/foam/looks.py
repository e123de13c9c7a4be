"""Section 5: the foam amount a of each look.

f is a saturation in [0, 4], m a mask's threshold in (0, 1), t the foam texture in [0, 1], s a saturation in [0, 1];
arrays of one shape.
"""

import numpy as np

from seafoam.reference.sampling import SplineSample, quantile, texel
from seafoam.reference.types import Floats, Pair, smoothstep
from seafoam.scene import Look

LEAST_HALF = 5e-4
OCTAVE_RAMP = 0.6  # width of an octave's ramp that the next octave resolves, as a share of the plane
OCTAVE_SHOWN = (32.0, 64.0)  # footprint in texels of an octave at which it begins to fade and is gone
END = 1.0 / 256.0


def textured(f: Floats, t: Floats) -> Floats:
    """clamp(f, 0, 1)·t (figure 7a)."""
    return np.clip(f, 0.0, 1.0) * t


def halftone(f: Floats, m: Floats) -> Floats:
    """1 where f > m, else 0 (equation 1)."""
    return np.where(f > m, 1.0, 0.0)


def fading(f: Floats, m: Floats) -> Floats:
    """clamp(f/2 − m, 0, 1) where f > m, else 0 (equation 2)."""
    return np.where(f > m, np.clip(0.5 * f - m, 0.0, 1.0), 0.0)


def halftone_textured(f: Floats, m: Floats, t: Floats) -> Floats:
    """clamp(f/2 − m, 0, 1)·t where f > m, else 0 (equation 3)."""
    return fading(f, m) * t


def listing(f: Floats, m: Floats, t: Floats) -> Floats:
    """clamp(f − m, 0.15, 3)·t where f > m, else 0 (the published code); in [0, 3], added to the water."""
    return np.where(f > m, np.clip(f - m, 0.15, 3.0) * t, 0.0)


def hard(look: Look, f: Floats, m: Floats, t: Floats) -> Floats:
    """The amount of a look that compares with single texels, by its name."""
    match look:
        case "textured":
            return textured(f, t)
        case "halftone":
            return halftone(f, m)
        case "fading":
            return fading(f, m)
        case "halftone_textured":
            return halftone_textured(f, m, t)
        case _:
            return listing(f, m, t)


def thinned(A: Floats, t: Floats, texture: float) -> Floats:
    """A·(1 − texture + texture·t): the filtered look under its foam texture."""
    return A * (1.0 - texture + texture * t)


def minification(size: Floats) -> Floats:
    """w: share of the minified mask under footprints of sides (r, 2) in texels; 1 from one and a half texels on."""
    return smoothstep(1.0, 1.5, size.max(axis=1))


def spline_over_footprint(spline: SplineSample, foot_u: Floats, foot_v: Floats) -> Pair:
    """b and e: mean of the B-spline mask over footprints (r, 2), and half the range of its values; (r,) each."""
    mean = spline.value + (spline.bend(foot_u) + spline.bend(foot_v)) / 24.0
    half: Floats = 0.5 * np.hypot(spline.along(foot_u), spline.along(foot_v))
    return mean, half


def spline_fade(table: Floats, s: Floats, fade: float) -> Floats:
    """Width of the ramp in values of the B-spline mask: the share ``fade`` of the plane is in it below Q(s); (r,)."""
    part = np.minimum(s, fade)
    return (quantile(table, s) - quantile(table, s - part)) * fade / np.maximum(part, 1e-30)


def magnified_coverage(b: Floats, e: Floats, threshold: Floats, width: Floats) -> Floats:
    """Share (r,) of a footprint where a threshold (Q(s), its ramp ``width`` wide) exceeds the B-spline mask, taken as
    uniform in b ± e, of :func:`spline_over_footprint`."""
    half = np.maximum(e, LEAST_HALF)
    return _ramp_mean(threshold, b - half, 2.0 * half, width)


def minified_coverage(
    s: Floats, u: Floats, v: Floats, size: Floats, spans: list[Floats], tables: Floats, fade: float
) -> Floats:
    """Coverage of a box of sides ``size`` (r, 2) texels around (u, v) by the thresholded mask; (r,).

    ``spans``: (low, width) of the thresholds in each texel of a level; ``tables`` (levels, 65): thresholds of each
    level. Reads the finest level in which the box is at most three texels wide, blended with the next one near that
    limit.
    """
    limited = np.clip(size.max(axis=1) / 1.5, 1.0, 2.0 ** (len(spans) - 1))
    level = np.floor(np.log2(limited))
    following = smoothstep(1.75, 2.0, limited / 2.0**level)
    covered = np.zeros_like(s)
    for index, image in enumerate(spans):
        weight = np.where(level == index, 1.0 - following, np.where(level + 1.0 == index, following, 0.0))
        here = np.flatnonzero(weight > 0.0)
        coverage = _level_coverage(s[here], u[here], v[here], size[here] / 2.0**index, image, tables[index], fade)
        covered[here] += weight[here] * coverage
    return covered


def filtered_coverage(s: Floats, minified: Floats, magnified: Floats, size: Floats, whole: bool) -> Floats:
    """A(s) in [0, 1], blended from its two forms. ``whole``: 1 at s = 1, as without a fade and in every octave."""
    w = minification(size)
    A = w * minified + (1.0 - w) * magnified
    A = A * smoothstep(0.0, END, s)
    if whole:
        A = 1.0 - (1.0 - A) * smoothstep(0.0, END, 1.0 - s)
    # The quotient can exceed 1 by rounding.
    return np.clip(A, 0.0, 1.0)


def octave(u: Floats, v: Floats) -> Pair:
    """Coordinates or footprints in the next octave: times the Gaussian integer 4 + 3i, so five times finer."""
    return 4.0 * u - 3.0 * v, 3.0 * u + 4.0 * v


def converged_coverage(s: Floats, b: Floats, table: Floats, fade: float) -> Floats:
    """The limit of :func:`filtered_coverage` for infinitely many samples: Q(s) > b, or the ramp of ``fade``."""
    gap = quantile(table, s) - b
    if fade == 0.0:
        return np.where(gap > 0.0, 1.0, 0.0)
    return np.clip(gap / np.maximum(spline_fade(table, s, fade), 1e-30), 0.0, 1.0)


def _level_coverage(s: Floats, u: Floats, v: Floats, size: Floats, image: Floats, table: Floats, fade: float) -> Floats:
    """Coverage of a box of sides ``size`` (r, 2) texels, from 4 × 4 texels of one level, (low, width) each."""
    side = image.shape[0]
    threshold = quantile(table, s)
    x, y = u * side - 0.5, v * side - 0.5
    i, j = np.floor(x), np.floor(y)
    width = np.clip(size, 1e-2, 3.0)
    across, down = _box_shares(x - i, width[:, 0]), _box_shares(y - j, width[:, 1])
    covered = np.zeros_like(s)
    for row in range(4):
        for column in range(4):
            low, spread = texel(image, i + (column - 1.0), j + (row - 1.0)).T
            covered += down[row] * across[column] * _ramp_mean(threshold, low, spread, fade)
    return covered


def _box_shares(t: Floats, width: Floats) -> list[Floats]:
    """Shares of a box around t, its width in texels, that lie in texels −1, 0, 1 and 2; (r,) each."""
    low, high = t - 0.5 * width, t + 0.5 * width
    return [
        (np.clip(high - texel + 0.5, 0.0, 1.0) - np.clip(low - texel + 0.5, 0.0, 1.0)) / width
        for texel in (-1.0, 0.0, 1.0, 2.0)
    ]


def _ramp_mean(threshold: Floats, low: Floats, width: Floats, fade: float | Floats) -> Floats:
    """Mean of the ramp for thresholds uniform in [low, low + width]; (r,)."""
    return (ramped(threshold - low, fade) - ramped(threshold - low - width, fade)) / width


def ramped(x: Floats, fade: float | Floats) -> Floats:
    """R(x), the integral of a threshold's ramp of width ``fade``: of a saturation, the mean coverage of its look."""
    limited = np.clip(x, 0.0, fade)
    return limited * limited / np.maximum(2.0 * fade, 1e-30) + np.maximum(x - fade, 0.0)
