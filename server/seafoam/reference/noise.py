"""Section 9: noise on whole-number hashes: value noise, gradient noise in any number of dimensions, and its octaves."""

from itertools import product

import numpy as np
from numpy.typing import NDArray

from seafoam.reference.types import Floats, Indices, smoothstep

KEY = 0x9031965F
"""Hash key of the noise that textures ground and foam."""
PERIOD = 256
GAIN = 0.58
FINER = 5.0**0.5
STRENGTH = {2: 4.6207, 3: 4.2631}
"""Amplitude of the first octave, by dimensions, so that infinitely many octaves have standard deviation 1."""
BITS = {2: 16, 3: 10}
SHIFT = (0.37, 0.71, 0.53)
_LOW = np.uint64(0xFFFFFFFF)
_Words = NDArray[np.uint64]


def pcg(word: _Words) -> _Words:
    """One output of PCG-RXS-M-XS 32 (O'Neill 2014) for 32-bit words stored in 64 bits."""
    state = (word * np.uint64(747796405) + np.uint64(2891336453)) & _LOW
    mixed = (((state >> ((state >> np.uint64(28)) + np.uint64(4))) ^ state) * np.uint64(277803737)) & _LOW
    result: _Words = (mixed >> np.uint64(22)) ^ mixed
    return result


def share(word: _Words) -> Floats:
    """The upper 24 of 32 bits, in [0, 1)."""
    result: Floats = (word >> np.uint64(8)).astype(np.float64) / 2.0**24
    return result


def chained(seed: int, *cells: Indices) -> _Words:
    """pcg(... pcg(pcg(seed ⊕ i) ⊕ j) ...) of whole numbers modulo 256; of their shape."""
    word = np.full(cells[0].shape, seed & 0xFFFFFFFF, np.uint64)
    for cell in cells:
        word = pcg(word ^ (np.asarray(cell, np.int64) % PERIOD).astype(np.uint64))
    return word


def corner(key: int, i: Indices, j: Indices) -> Floats:
    """A random number in [0, 1) for integer coordinates (i, j) modulo 2³²; of their shape."""
    word = np.full(i.shape, key & 0xFFFFFFFF, np.uint64)
    for cell in (i, j):
        word = pcg(word ^ (np.asarray(cell, np.int64).astype(np.uint64) & _LOW))
    return share(word)


def value(key: int, x: Floats, z: Floats) -> Floats:
    """Value noise in [0, 1] with cells of size 1; of the shape of ``x``."""
    i, j = np.floor(x), np.floor(z)
    u, v = smoothstep(0.0, 1.0, x - i), smoothstep(0.0, 1.0, z - j)
    a, b = i.astype(np.int64), j.astype(np.int64)
    near = corner(key, a, b) * (1.0 - u) + corner(key, a + 1, b) * u
    far = corner(key, a, b + 1) * (1.0 - u) + corner(key, a + 1, b + 1) * u
    result: Floats = near * (1.0 - v) + far * v
    return result


def perlin(x: Floats, seed: int) -> Floats:
    """Gradient noise at (r, n), with cells of size 1, n 2 or 3; (r,). Gradients are uniform in the cube [−1, 1]ⁿ."""
    count, dimensions = x.shape
    bits = BITS[dimensions]
    base = np.floor(x)
    t = x - base
    fade = t**3 * (10.0 + t * (6.0 * t - 15.0))
    cells = base.astype(np.int64)
    total = np.zeros(count)
    for corner in product((0, 1), repeat=dimensions):
        word = chained(seed, *(cells[:, axis] + step for axis, step in enumerate(corner)))
        weight, rise = np.ones(count), np.zeros(count)
        for axis, step in enumerate(corner):
            field = (word >> np.uint64(bits * axis)) & np.uint64(2**bits - 1)
            rise += (2.0 * field.astype(np.float64) / (2**bits - 1) - 1.0) * (t[:, axis] - step)
            weight *= fade[:, axis] if step else 1.0 - fade[:, axis]
        total += weight * rise
    return total


def fractal(x: Floats, width: Floats, octaves: int, seed: int) -> Floats:
    """Octaves of :func:`perlin` at (r, n), filtered to a width (r,) in cells; (r,), standard deviation 1 unfiltered."""
    dimensions = x.shape[1]
    strength, place, scale = STRENGTH[dimensions], x, 1.0
    total = np.zeros(x.shape[0])
    for octave in range(octaves):
        kept = 1.0 - smoothstep(0.15, 0.6, width * scale)
        seen = np.flatnonzero(kept > 0.0)
        if seen.size:
            total[seen] += strength * kept[seen] * perlin(place[seen], seed + octave)
        finer = [2.0 * place[:, 0] + place[:, 1] + SHIFT[0], 2.0 * place[:, 1] - place[:, 0] + SHIFT[1]]
        if dimensions == 3:
            finer.append(2.0 * place[:, 2] + SHIFT[2])
        place = np.stack(finer, axis=-1)
        scale *= FINER
        strength *= GAIN
    return total
