"""Section 3: intersections of rays with the waves, the normals there, and the footprints of samples.

A ray's height over the surface, G, is sampled at steps that cannot pass a crossing (by the greatest slope) or, where
those are small, at a quarter of the finest feature; every sampled minimum low enough to hide a double crossing (by the
greatest curvature) is then searched. So the first crossing is found while steps are fine, that is for the first
``FINE_STEPS`` steps in the slab that contains the waves: for any ray more than about a degree below the horizon in
common scenes. Later steps grow by ``GROWTH``, where waves are far smaller than a pixel; such a ray still gets a
crossing of the sampled waves. The bounds do not hold for exponents below ½ (below 1 from under the surface), whose
troughs are cusps; there no crossing from above is missed. Crossings are refined to the last few digits of float64.
"""

import math
from itertools import count

import numpy as np

from seafoam.reference.types import Bools, Floats, Indices, ReliefPart, dot

LEVEL = 1e-9  # rays with |d.y| below this are treated as horizontal: they intersect no horizontal plane
FAR = 1e7  # distance to which rays inside the waves' slab are followed, m
FINE_STEPS = 1500
GROWTH = 1.02
SHAPE_SHARE = 0.25  # step size over the size of the finest feature
REFINEMENTS = 80
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
GOLDEN_STEPS = 40


def first_crossing(relief: ReliefPart, eye_y: float, d: Floats) -> Floats:
    """Distance along unit rays d (r, 3) from (0, eye_y, 0) to the surface, from either side, m; (r,), ∞: a miss."""
    distance = np.full(d.shape[0], np.inf)
    if relief.bounds.top <= 0.0:
        slanted = np.abs(d[:, 1]) >= LEVEL
        s: Floats = -eye_y / np.where(slanted, d[:, 1], 1.0)
        met = slanted & (s > 0.0)
        distance[met] = s[met]
        return distance
    low, high, inside = _slab(eye_y, relief.bounds.trough, relief.bounds.top, d[:, 1])
    chosen = np.flatnonzero(inside)
    distance[chosen] = _Search(relief, eye_y, d[chosen]).first(low[chosen], high[chosen])
    return distance


def land_crossing(land: ReliefPart, eye_y: float, d: Floats, low: Floats, high: Floats) -> Floats:
    """Distance along unit rays d (r, 3) to land above y = 0, from ``low`` to ``high`` (r,), m; (r,), ∞ for a miss."""
    distance = np.full(d.shape[0], np.inf)
    if land.bounds.top <= 0.0:
        return distance
    start, end, inside = _slab(eye_y, 0.0, land.bounds.top, d[:, 1])
    start, end = np.maximum(start, low), np.minimum(end, high)
    chosen = np.flatnonzero(inside & (start < end))
    found = _Search(land, eye_y, d[chosen]).first(start[chosen], end[chosen])
    # The search reports a crossing at its end for rays that leave; only crossings on land count.
    met = np.isfinite(found)
    s = np.where(met, found, 0.0)
    height = land.height(d[chosen, 0] * s, d[chosen, 2] * s)
    met &= (height > 0.0) & (np.abs(eye_y + d[chosen, 1] * s - height) <= 1e-6)
    distance[chosen] = np.where(met, found, np.inf)
    return distance


def normal(h_x: Floats, h_z: Floats) -> Floats:
    """(−h_x, 1, −h_z), not normalised; (r, 3)."""
    return np.stack((-h_x, np.ones_like(h_x), -h_z), axis=-1)


def footprint(t: Floats, D: Floats, N: Floats, delta: Floats, axes: tuple[int, ...] = (0, 2)) -> Floats:
    """∂P/∂X = t(δ − D (N·δ)/(N·D)) for a step δ (3,) of D, N·D at most −10⁻³ |N||D|; along n axes, (r, n) m."""
    facing = np.minimum(dot(N, D), -1e-3 * np.sqrt(dot(N, N) * dot(D, D)))
    moved = t[:, None] * (delta - D * (dot(N, delta) / facing)[:, None])
    return moved[:, axes]


def _slab(eye_y: float, bottom: float, top: float, rise: Floats) -> tuple[Floats, Floats, Bools]:
    """Distances at which rays enter and leave bottom ≤ y ≤ top, m, and whether they meet it; (r,) each."""
    slanted = np.abs(rise) >= LEVEL
    rise = np.where(slanted, rise, 1.0)
    ends = np.sort(np.stack(((top - eye_y) / rise, (bottom - eye_y) / rise)), axis=0)
    within = bottom <= eye_y <= top
    low = np.where(slanted, np.maximum(ends[0], 0.0), 0.0)
    high = np.where(slanted, ends[1], FAR)
    inside = np.where(slanted, ends[1] > 0.0, within)
    # Only rays that start in the slab can stay in it indefinitely.
    return low, np.minimum(high, FAR) if within else high, inside


class _Search:
    """G along r rays."""

    def __init__(self, relief: ReliefPart, eye_y: float, d: Floats) -> None:
        self.relief, self.eye_y = relief, eye_y
        self.d = d.T
        self.level = np.hypot(d[:, 0], d[:, 2])

    def _value(self, s: Floats, x: Floats, y: Floats, z: Floats) -> Floats:
        """G at distances s along (x, y, z); (r,) m."""
        return self.eye_y + y * s - self.relief.height(x * s, z * s)

    def first(self, low: Floats, high: Floats) -> Floats:
        """First zero of G between the ends of the slab; (r,) m, infinite where there is none."""
        size, rise = low.size, self.d[1]
        # Rounding must not place a camera above all crests below one.
        outside = (
            1.0 if self.eye_y > self.relief.bounds.top else -1.0 if self.eye_y < self.relief.bounds.trough else 0.0
        )
        side = np.full(size, outside)
        if outside == 0.0:
            side = np.where(self._value(low, *self.d) >= 0.0, 1.0, -1.0)
        before, after = np.full(size, np.inf), np.full(size, np.inf)
        # Every ray that leaves the slab on the other side has crossed, even if rounding of G there says otherwise.
        sure = (np.abs(rise) >= LEVEL) & (side * rise < 0.0) & ((high < FAR) | (outside != 0.0))
        # Rays steeper than any slope have one crossing, between the ends.
        steep = sure & (side > 0.0) & (-rise > self.relief.bounds.slope * self.level)
        before[steep], after[steep] = low[steep], high[steep]
        dips = self._march(np.flatnonzero(~steep), low, high, side, sure, before, after)
        self._search_dips(dips, side, before, after)
        crossed = np.flatnonzero(np.isfinite(after))
        after[crossed] = self._refine(crossed, before[crossed], after[crossed], side[crossed])
        return after

    def _march(
        self, rays: Indices, low: Floats, high: Floats, side: Floats, sure: Bools, before: Floats, after: Floats
    ) -> list[tuple[Indices, Floats, Floats]]:
        """Bracket the first sign change of each ray in ``before`` and ``after``; return the minima to be searched. A
        minimum is (rays, from, to): G is positive where it was sampled, but may be negative between."""
        dips: list[tuple[Indices, Floats, Floats]] = []
        d, level, sign, s, end = (part[..., rays] for part in (self.d, self.level, side, low, high))
        certain = sure[rays]
        g = sign * self._value(s, *d)
        s_old, g_old = s, np.full(s.shape, np.inf)
        closing = self.relief.bounds.slope * level - sign * d[1]
        live = np.ones(rays.size, np.bool_)
        fine = SHAPE_SHARE * self.relief.bounds.shape / np.maximum(level, 1e-12)
        for steps in count(1):
            if steps > FINE_STEPS:
                fine = fine * GROWTH
            # With infinite slope, or where the gap does not close, the quotient is 0 or undefined.
            safe = np.where(closing > 0.0, g / np.where(closing > 0.0, closing, 1.0), np.inf)
            s_new = np.minimum(s + np.maximum(fine, safe), end)
            g_new = sign * self._value(s_new, *d)
            crossed = live & ((g_new <= 0.0) | (certain & (s_new >= end)))
            where = rays[crossed]
            before[where], after[where] = s[crossed], s_new[crossed]
            width = np.maximum(s - s_old, s_new - s) * level
            suspect = (
                live
                & ~crossed
                & (g <= g_old)
                & (g <= g_new)
                & (g <= 0.5 * self.relief.bounds.curvature * width * width)
            )
            if suspect.any():
                dips.append((rays[suspect], s_old[suspect], s_new[suspect]))
            live &= ~crossed & (s_new < end)
            if not live.any():
                break
            s_old, g_old, s, g = s, g, s_new, g_new
            if np.count_nonzero(live) < 0.75 * live.size:
                rays, certain, d = rays[live], certain[live], d[:, live]
                level, sign, end, closing, fine = (part[live] for part in (level, sign, end, closing, fine))
                s, g, s_old, g_old = (part[live] for part in (s, g, s_old, g_old))
                live = np.ones(rays.size, np.bool_)
        return dips

    def _search_dips(
        self, dips: list[tuple[Indices, Floats, Floats]], side: Floats, before: Floats, after: Floats
    ) -> None:
        """Find the least G of each minimum by golden section; where it is negative, it ends an earlier bracket."""
        if not dips:
            return
        rays, start, b = (np.concatenate(parts) for parts in zip(*dips, strict=True))
        early = start < np.minimum(after[rays], np.finfo(np.float64).max)
        rays, start, a, b = rays[early], start[early], start[early], b[early]
        sign, d = side[rays], self.d[:, rays]
        for _ in range(GOLDEN_STEPS):
            left, right = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
            keep_left = sign * self._value(left, *d) < sign * self._value(right, *d)
            a, b = np.where(keep_left, a, left), np.where(keep_left, right, b)
        middle = 0.5 * (a + b)
        below = np.flatnonzero(sign * self._value(middle, *d) < 0.0)
        # With several minima of one ray the last assignment wins, so the nearest is assigned last.
        for i in below[np.argsort(-middle[below], kind="stable")]:
            if middle[i] < after[rays[i]]:
                before[rays[i]], after[rays[i]] = start[i], middle[i]

    def _refine(self, rays: Indices, a: Floats, b: Floats, side: Floats) -> Floats:
        """The zero between a (G·side ≥ 0) and b (G·side ≤ 0): Newton steps, bisection where they leave the bracket."""
        result = np.empty(rays.size)
        place = np.arange(rays.size)
        d, s = self.d[:, rays], 0.5 * (a + b)
        for _ in range(REFINEMENTS):
            g = side * self._value(s, *d)
            h_x, h_z = self.relief.gradient(d[0] * s, d[2] * s)
            slope = side * (d[1] - d[0] * h_x - d[2] * h_z)
            a, b = np.where(g > 0.0, s, a), np.where(g > 0.0, b, s)
            falling = slope < 0.0
            newton = s - g / np.where(falling, slope, 1.0)
            good = falling & (newton > a) & (newton < b)
            following = np.where(good, newton, 0.5 * (a + b))
            done = (np.abs(following - s) <= 1e-14 * (s + abs(self.eye_y))) | (g == 0.0)
            result[place] = np.where(g == 0.0, s, following)
            left = ~done
            if not left.any():
                break
            s, a, b, side = (part[left] for part in (following, a, b, side))
            d, place = d[:, left], place[left]
        return result
