"""The seabed of a shore: heights on a grid."""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.arrays import Floats, read_only, smoothstep
from seafoam.ocean.basics.hash import chance
from seafoam.scene import STEPS, Shore, decoded_image


def _pictured(grey: Floats, x: Floats, z: Floats) -> Floats:
    """Return the quadratic B-spline of an image at x, z in [0, 1]; of the shape of ``x``."""
    taps = []
    for place, count in ((z, grey.shape[0]), (x, grey.shape[1])):
        at = place * count - 0.5
        base = np.floor(at + 0.5)
        t = at + 0.5 - base
        index = [np.clip(base.astype(np.int64) + i, 0, count - 1) for i in (-1, 0, 1)]
        taps.append((index, (0.5 * (1.0 - t) ** 2, 0.5 + t * (1.0 - t), 0.5 * t * t)))
    total = np.zeros_like(x)
    for row, down in zip(*taps[0], strict=True):
        for column, along in zip(*taps[1], strict=True):
            total += down * along * grey[row, column]
    return total


def floor_grid(shore: Shore, texels: int) -> Floats:
    """Return (texels, texels, 2): height of floor or land above y = 0 (m), and a tint in [0, 1]; row z, column x.

    Values are at texel centres. They are computed by sums, products, quotients and square roots (and one sine and
    cosine) and rounded to 1/1024, so that every machine gets the same bytes.
    """
    return _floor_grid(shore.ground, texels)


@lru_cache(maxsize=16)
def _floor_grid(shore: Shore, texels: int) -> Floats:
    half = 0.5 * shore.size
    centres = ((np.arange(texels) + 0.5) / texels - 0.5) * shore.size
    x, z = np.meshgrid(centres, centres, indexing="xy")
    if shore.image is not None:
        grey = _pictured(decoded_image(shore.image), x / shore.size + 0.5, z / shore.size + 0.5)
        return _finished(shore, x, z, grey * (shore.depth + shore.height) - shore.depth)
    strays = shore.roughness * 0.3 * min(shore.size, 8.0 * shore.radius if shore.kind != "beach" else shore.size)
    e = _plain(shore, x, z) + strays * (_fbm(x, z, 0.3 * shore.size, shore.seed, 5) - 0.5)
    # The square's edge is sea for every kind of shore, and the floor there is level.
    edge = np.maximum(np.abs(x), np.abs(z)) - 0.84 * half
    e = 0.5 * (e + edge + np.sqrt((e - edge) ** 2 + (0.04 * shore.size) ** 2))
    sea, land = np.maximum(e, 0.0), np.maximum(-e, 0.0)
    depth = np.full_like(x, shore.depth)
    if shore.kind == "lagoon":
        r = np.sqrt(x * x + z * z)
        depth = shore.inner_depth + (shore.depth - shore.inner_depth) * smoothstep(0.9, 1.15, r / shore.radius)
    fall = shore.slope * sea / depth
    floor = -depth * fall / np.sqrt(1.0 + fall * fall)
    dune = max(0.3 * shore.height, 1e-3)
    rise = shore.slope * land / dune
    hills = _fbm(x, z, 0.22 * shore.size, shore.seed + 101, 5)
    inland = smoothstep(0.0, 0.12 * shore.size if shore.kind == "beach" else 0.8 * shore.radius, land)
    rest = shore.height - 0.3 * shore.height
    floor += dune * rise / np.sqrt(1.0 + rise * rise) + rest * inland * (0.25 + 1.1 * hills * hills)
    # Sand ripples and bars, absent at the water's edge and in deep water.
    bars = _fbm(x, z, 0.06 * shore.size, shore.seed + 211, 3) - 0.5
    floor += 0.25 * shore.roughness * bars * smoothstep(0.0, 30.0, np.abs(e))
    # The floor sinks to full depth well inside the square, in a rounded shape, so that no edge is visible from above.
    out = np.sqrt(np.sqrt(x**4 + z**4)) / half
    floor += (-shore.depth - floor) * smoothstep(0.5, 0.95, out) * smoothstep(0.0, 0.14 * shore.size, e)
    return _finished(shore, x, z, floor)


def _finished(shore: Shore, x: Floats, z: Floats, floor: Floats) -> Floats:
    """Return the floor, levelled toward the edges of the square, with its tint; rounded, read-only."""
    half = 0.5 * shore.size
    if shore.relief > 0.0:
        # Shaped by a factor, so that the coast stays where it is.
        shape = 0.35 + 2.0 * _ridges(x, z, 0.13 * shore.size, shore.seed + 503, 5)
        floor = floor + shore.relief * np.maximum(floor, 0.0) * (shape - 1.0)
    # What lies on the edge goes on for ever: nothing may stand there, nor any patch of weed.
    ends = smoothstep(0.9, 0.985, np.maximum(np.abs(x), np.abs(z)) / half)
    floor = floor + (-shore.depth - floor) * ends
    tint = _fbm(x, z, 0.09 * shore.size, shore.seed + 307, 5)
    tint += (0.4 - tint) * ends
    both = np.stack((floor + shore.level, tint), axis=-1)
    return read_only(np.round(both * STEPS) / STEPS)


def _plain(shore: Shore, x: Floats, z: Floats) -> Floats:
    """Return the distance to the plain coastline, m: positive at sea."""
    c, s = math.cos(shore.heading), math.sin(shore.heading)
    r = np.sqrt(x * x + z * z)
    match shore.kind:
        case "beach":
            return -(x * c + z * s)
        case "island":
            return r - shore.radius
        case "islands":
            e = np.full_like(x, 2.0 * shore.size)
            for i in range(7):
                draws = [chance(shore.seed + 401, i, k) for k in range(3)]
                at_x, at_z = (0.62 * shore.size * (float(draw) - 0.5) for draw in draws[:2])
                size = shore.radius * (0.35 + 0.65 * float(draws[2]))
                island = np.sqrt((x - at_x) ** 2 + (z - at_z) ** 2) - size
                # Smooth minimum: islands near each other merge.
                blend = 0.5 * shore.radius
                share = np.clip(0.5 + 0.5 * (e - island) / blend, 0.0, 1.0)
                e = e + (island - e) * share - blend * share * (1.0 - share)
            return e
        case _:
            width = 0.16 * shore.radius
            along = (x * c + z * s) / np.maximum(r, 1e-6)
            return np.abs(r - shore.radius) - width + 2.2 * width * smoothstep(0.90, 0.985, along)


def _value_noise(x: Floats, z: Floats, seed: int) -> Floats:
    """Value noise in [0, 1] with cells of size 1, with continuous second derivatives."""
    i, j = np.floor(x), np.floor(z)
    u, v = x - i, z - j
    u = u * u * u * (u * (6.0 * u - 15.0) + 10.0)
    v = v * v * v * (v * (6.0 * v - 15.0) + 10.0)
    a, b = i.astype(np.int64), j.astype(np.int64)
    along, down = np.arange(a.min(), a.max() + 2), np.arange(b.min(), b.max() + 2)
    corners = chance(seed, along[None, :], down[:, None])
    a, b = a - along[0], b - down[0]
    near: Floats = corners[b, a] * (1.0 - u) + corners[b, a + 1] * u
    far: Floats = corners[b + 1, a] * (1.0 - u) + corners[b + 1, a + 1] * u
    return near * (1.0 - v) + far * v


def _fbm(x: Floats, z: Floats, cell: float, seed: int, octaves: int) -> Floats:
    """Octaves of value noise, the largest with cells of ``cell`` m; in [0, 1], mean about ½."""
    total, weight, sum_of_weights = np.zeros_like(x), 1.0, 0.0
    for octave in range(octaves):
        # Each octave is rotated against the last (by 3-4-5 triangles), which hides the lattice.
        x, z = 0.8 * x - 0.6 * z, 0.6 * x + 0.8 * z
        total += weight * _value_noise(x / cell, z / cell, seed + 17 * octave)
        sum_of_weights += weight
        weight, cell = 0.5 * weight, 0.47 * cell
    return total / sum_of_weights


def _ridges(x: Floats, z: Floats, cell: float, seed: int, octaves: int) -> Floats:
    """Ridged multifractal noise (Musgrave 2003), the largest ridges ``cell`` m apart; in [0, 1].

    Ridges are where value noise passes ½; each octave is as strong as the last is high, so that valleys are smooth.
    """
    # Warped, so that ridges do not run straight.
    bent_x = x + 0.6 * cell * (_fbm(x, z, 0.8 * cell, seed + 1009, 3) - 0.5)
    bent_z = z + 0.6 * cell * (_fbm(x, z, 0.8 * cell, seed + 2003, 3) - 0.5)
    total, strength, sum_of_strengths, weight = np.zeros_like(x), 1.0, 0.0, np.ones_like(x)
    for octave in range(octaves):
        bent_x, bent_z = 0.8 * bent_x - 0.6 * bent_z, 0.6 * bent_x + 0.8 * bent_z
        ridge = 1.0 - np.abs(2.0 * _value_noise(bent_x / cell, bent_z / cell, seed + 17 * octave) - 1.0)
        ridge = ridge * ridge * weight
        total += strength * ridge
        sum_of_strengths += strength
        weight = np.clip(1.6 * ridge, 0.0, 1.0)
        strength, cell = 0.5 * strength, 0.47 * cell
    return total / sum_of_strengths
