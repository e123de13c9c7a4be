"""Section 5: the foam amount a that each look makes of a saturation.

f is a saturation in [0, 4], m a mask's threshold in (0, 1), t the foam texture in [0, 1], s a saturation in [0, 1];
arrays of one shape.
"""

import math

import numpy as np

from .sampling import Spline, quantile
from .types import Floats, smoothstep

LEAST_HALF = 5e-4
END = 1.0 / 256.0


def textured(f: Floats, t: Floats) -> Floats:
    """clamp(f, 0, 1)·t (figure 7a)."""
    result: Floats = np.clip(f, 0.0, 1.0) * t
    return result


def halftone(f: Floats, m: Floats) -> Floats:
    """1 where f > m, else 0 (equation 1)."""
    result: Floats = np.where(f > m, 1.0, 0.0)
    return result


def fading(f: Floats, m: Floats) -> Floats:
    """clamp(f/2 − m, 0, 1) where f > m, else 0 (equation 2)."""
    result: Floats = np.where(f > m, np.clip(0.5 * f - m, 0.0, 1.0), 0.0)
    return result


def halftone_textured(f: Floats, m: Floats, t: Floats) -> Floats:
    """clamp(f/2 − m, 0, 1)·t where f > m, else 0 (equation 3)."""
    return fading(f, m) * t


def listing(f: Floats, m: Floats, t: Floats) -> Floats:
    """clamp(f − m, 0.15, 3)·t where f > m, else 0 (the published code); in [0, 3], added to the water."""
    result: Floats = np.where(f > m, np.clip(f - m, 0.15, 3.0) * t, 0.0)
    return result


def thinned(A: Floats, t: Floats, texture: float) -> Floats:
    """A·(1 − texture + texture·t): the filtered look under its foam texture."""
    result: Floats = A * (1.0 - texture + texture * t)
    return result


def magnification(level: Floats) -> Floats:
    """1 − w: share of the B-spline mask at a level (log₂ of the longer footprint in texels); 0 from level 0 on."""
    return 1.0 - smoothstep(-1.0, 0.0, level)


def spline_over_footprint(spline: Spline, foot_u: Floats, foot_v: Floats) -> tuple[Floats, Floats]:
    """b and e: mean of the B-spline mask over a footprint (r, 2), (r, 2), and half the width of its box; (r,) each."""
    mean = spline.value + (spline.bend(foot_u) + spline.bend(foot_v)) / 24.0
    half: Floats = 0.5 * np.hypot(spline.along(foot_u), spline.along(foot_v))
    return mean, half


def filtered_coverage(
    s: Floats, mean: Floats, second: Floats, b: Floats, e: Floats, level: Floats, table: Floats, fade: float
) -> Floats:
    """A(s): the share of a footprint that a threshold of the mask covers; in [0, 1].

    ``mean`` and ``second`` are the moments (m, m²) in the footprint, b and e come
    from :func:`spline_over_footprint`, ``level`` is log₂ of the longer footprint in texels, ``table`` the
    quantile table (65,).
    """
    near = magnification(level)
    w = 1.0 - near
    sigma = np.sqrt(np.maximum(second - mean * mean, 0.0))
    s_here = near * quantile(table, s) + w * s
    m_here = near * b + w * mean
    half = np.maximum(np.maximum(math.sqrt(3.0) * sigma * w, e * near), LEAST_HALF)
    gap = s_here - m_here
    A = (_ramp(gap + half, fade) - _ramp(gap - half, fade)) / (2.0 * half)
    A = A * smoothstep(0.0, END, s)
    if fade == 0.0:
        A = 1.0 - (1.0 - A) * smoothstep(0.0, END, 1.0 - s)
    # Rounding of the quotient.
    return np.clip(A, 0.0, 1.0)


def converged_coverage(s: Floats, b: Floats, table: Floats, fade: float) -> Floats:
    """The limit of :func:`filtered_coverage` with infinitely many samples: Q(s) > b, or the ramp of ``fade``."""
    gap = quantile(table, s) - b
    result: Floats = np.where(gap > 0.0, 1.0, 0.0) if fade == 0.0 else np.clip(gap / fade, 0.0, 1.0)
    return result


def _ramp(x: Floats, fade: float) -> Floats:
    """R(x), the integral of the threshold's ramp of width ``fade``."""
    if fade == 0.0:
        return np.maximum(x, 0.0)
    held = np.clip(x, 0.0, fade)
    result: Floats = held * held / (2.0 * fade) + np.maximum(x - fade, 0.0)
    return result
