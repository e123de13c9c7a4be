"""Section 9: noise on whole-number hashes: value noise, gradient noise in any number of dimensions, and its octaves.

And section 8: patterns that noise makes, averaged over footprints.
"""

from functools import reduce
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seafoam.reference.types import Floats, Footprints, Gradient, Indices, Pair, dot, smoothstep

KEY = 0x9031965F  # hash key of the noise that textures ground and foam
PERIOD = 256
GAIN = 0.58
FINER = 5.0**0.5
STRENGTH = {2: 4.6207, 3: 4.2631}
"""Amplitude of the first octave, by dimensions, so that infinitely many octaves have standard deviation 1."""
BITS = {2: 16, 3: 10}
SHIFT = (0.37, 0.71, 0.53)
TORN = 0.25, 0.72  # range of a sum of noises over which patches of foam grow from nothing to full
TORN_SHARES = 0.4, 0.35, 0.25  # shares of the noises in that sum
GRAIN_CELL, GRAIN_OCTAVES, GRAIN_STEP = 9.0, 5, 0.31
"""Side of the ground's first cells of noise (m), number of octaves, and ratio of one's cells to the one before."""
LOW = np.uint64(0xFFFFFFFF)
Words = NDArray[np.uint64]  # 32-bit words, in 64 bits


def pcg(word: Words) -> Words:
    """One output of PCG-RXS-M-XS 32 (O'Neill 2014)."""
    state = (word * np.uint64(747796405) + np.uint64(2891336453)) & LOW
    mixed: Words = (((state >> ((state >> np.uint64(28)) + np.uint64(4))) ^ state) * np.uint64(277803737)) & LOW
    return (mixed >> np.uint64(22)) ^ mixed


def share(word: Words) -> Floats:
    """The upper 24 of 32 bits, in [0, 1)."""
    return (word >> np.uint64(8)).astype(np.float64) / 2.0**24


def number(word: Words, k: int | Indices) -> Floats:
    """The k-th random number in [0, 1) that goes with each word."""
    return share(pcg(word + np.asarray(k, np.uint64)))


def chained(seed: int, *cells: ArrayLike, period: int = 2**32) -> Words:
    """pcg(... pcg(pcg(seed ⊕ i) ⊕ j) ...) of whole numbers modulo a period; of their shape, (1,) or more."""
    word = np.atleast_1d(np.uint64(seed & 0xFFFFFFFF))
    for cell in cells:
        word = pcg(word ^ (np.asarray(cell, np.int64) % period).astype(np.uint64))
    return word


def value(key: int, x: Floats, z: Floats) -> Floats:
    """Value noise in [0, 1] with cells of size 1; of the shape of ``x``."""
    i, j = np.floor(x), np.floor(z)
    u, v = smoothstep(0.0, 1.0, x - i), smoothstep(0.0, 1.0, z - j)
    a, b = i.astype(np.int64), j.astype(np.int64)
    near, far = (share(chained(key, a, b + k)) * (1.0 - u) + share(chained(key, a + 1, b + k)) * u for k in (0, 1))
    return near * (1.0 - v) + far * v


def perlin(x: Floats, seed: int, period: int = PERIOD, *, sloped: bool = False) -> Pair:
    """Gradient noise at (r, n), with cells of size 1, n 2 or 3; (r,). For n = 2, or ``sloped``, its gradient; (n, r).

    Its gradients at the cells' corners are uniform in the cube [−1, 1]ⁿ.
    """
    count, dimensions = x.shape
    bits = BITS[dimensions]
    base = np.floor(x)
    t = (x - base).T
    fade, change = t**3 * (10.0 + t * (6.0 * t - 15.0)), 30.0 * t**2 * (1.0 - t) ** 2
    total, slope = np.zeros(count), np.zeros((dimensions, count))
    for corner in product((0, 1), repeat=dimensions):
        word = chained(seed, *(base.astype(np.int64) + np.array(corner)).T, period=period)
        fields = ((word >> np.uint64(bits * axis)) & np.uint64(2**bits - 1) for axis in range(dimensions))
        gradient = [2.0 * field.astype(np.float64) / (2**bits - 1) - 1.0 for field in fields]
        rise = sum(by * (place - step) for by, place, step in zip(gradient, t, corner, strict=True))
        shares = [share if step else 1.0 - share for share, step in zip(fade, corner, strict=True)]
        weight = reduce(np.multiply, shares)
        total += weight * rise
        for axis, step in enumerate(corner if sloped or dimensions == 2 else ()):
            others = (share for other, share in enumerate(shares) if other != axis)
            by = reduce(np.multiply, others, change[axis] if step else -change[axis])
            slope[axis] += weight * gradient[axis] + by * rise
    return total, slope


def fractal(x: Floats, width: Floats, count: int, seed: int) -> Floats:
    """Octaves of :func:`perlin` at (r, n), filtered to a width (r,) in cells; (r,), standard deviation 1 unfiltered."""
    return octaves(x, width, (0, count), seed)[0]


def octaves(x: Floats, width: Floats, span: tuple[int, int], seed: int) -> Pair:
    """Octaves ``span`` of :func:`fractal`, and the variance that they lack of 1; (r,)."""
    dimensions = x.shape[1]
    strength, place, scale, variance = STRENGTH[dimensions], x, 1.0, 1.0 - GAIN * GAIN
    total, lost = np.zeros(x.shape[0]), np.ones(x.shape[0])
    for octave in range(span[1]):
        if octave >= span[0]:
            kept = 1.0 - smoothstep(0.15, 0.6, width * scale)
            seen = np.flatnonzero(kept > 0.0)
            total[seen] += strength * kept[seen] * perlin(place[seen], seed + octave)[0]
            lost -= variance * kept * kept
        finer = [2.0 * place[:, 0] + place[:, 1] + SHIFT[0], 2.0 * place[:, 1] - place[:, 0] + SHIFT[1]]
        if dimensions == 3:
            finer.append(2.0 * place[:, 2] + SHIFT[2])
        place = np.stack(finer, axis=-1)
        scale *= FINER
        strength *= GAIN
        variance *= GAIN * GAIN
    return total, lost


def filtered_step(low: ArrayLike, high: ArrayLike, x: Floats, variance: Floats | float) -> Floats:
    """Mean of smoothstep(low, high, x) where x has this variance; (r,)."""
    begin, end = np.asarray(low, np.float64), np.asarray(high, np.float64)
    reach = np.sqrt(0.25 * (end - begin) ** 2 + 5.0 * variance)
    q = np.clip((x - 0.5 * (begin + end) + reach) / (2.0 * reach), 0.0, 1.0)
    return q * q * (3.0 - 2.0 * q)


def patches(
    x: Floats, z: Floats, octaves: tuple[tuple[float, bool], ...], footprints: Footprints | None, unit: float = 1.0
) -> Floats:
    """How far patches of foam that noise tears at (x, z) have grown, averaged over footprints; (r,) in [0, 1].

    ``octaves``: the size of cells, in units of ``unit`` m as places are, and whether they are turned.
    """
    t_x, t_z = 0.8 * x - 0.6 * z, 0.6 * x + 0.8 * z
    along, down = (side.T for side in footprints) if footprints is not None else np.zeros((2, 2, 1))
    mean, lost = np.full(x.shape, 0.5), np.zeros(x.shape)
    for weight, (cell, turned) in zip(TORN_SHARES, octaves, strict=True):
        noise = value(KEY, t_x / cell, t_z / cell) if turned else value(KEY, x / cell, z / cell)
        per = 3.23 / 12.0 / (cell * unit) ** 2
        area = per * (along[0] * down[1] - along[1] * down[0])
        kept = 1.0 / (1.0 + per * ((along**2).sum(axis=0) + (down**2).sum(axis=0)) + area**2)
        mean += weight * np.sqrt(kept) * (noise - 0.5)
        lost += weight**2 * 0.046 * (1.0 - kept)
    return filtered_step(*TORN, mean, lost)


def footprint_variance(gradient: Gradient, footprints: Footprints | None) -> Floats | float:
    """Variance under footprints of a quantity with this gradient, per metre; (r,), without footprints 0."""
    if footprints is None:
        return 0.0
    return sum((gradient[0] * side[:, 0] + gradient[1] * side[:, 1]) ** 2 / 12.0 for side in footprints)


def grain(q_x: Floats, q_z: Floats, footprints: Footprints) -> Floats:
    """Texture of the ground in [0, 1]: octaves of noise, faded out before they are smaller than footprints; (r,)."""
    reach = np.sqrt(np.maximum(*(dot(side, side) for side in footprints)))
    total: Floats = np.full(q_x.shape, 0.5)
    cell = GRAIN_CELL
    for _ in range(GRAIN_OCTAVES):
        q_x, q_z = 0.8 * q_x - 0.6 * q_z, 0.6 * q_x + 0.8 * q_z
        kept = 1.0 - smoothstep(0.15 * cell, 0.6 * cell, reach)
        seen = np.flatnonzero(kept > 0.0)
        total[seen] += (value(KEY, q_x[seen] / cell, q_z[seen] / cell) - 0.5) * 0.45 * kept[seen]
        cell *= GRAIN_STEP
    return np.clip(total, 0.0, 1.0)
