"""Section 8: land in detail, and how wet the swash left it."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from seafoam.reference.foam.torn import Feet, torn_step
from seafoam.reference.noise import pcg, share
from seafoam.reference.types import Floats, Indices, dot, smoothstep, unit

if TYPE_CHECKING:
    from seafoam.reference.shore.shore import Coast

KEY = 0x51ED270B
CELL = 64.0
"""Side of the first octave's cells, m."""
FINER = 0.31
STRENGTH = 5.672
"""Over the standard deviation of the gradient noise."""
OCTAVES = (
    # share of the pattern, then relief's height over its cell on sand, rock and plants
    (0.30, 0.0, 0.03, 0.02),
    (0.38, 0.004, 0.06, 0.05),
    (0.45, 0.008, 0.09, 0.10),
    (0.45, 0.012, 0.11, 0.14),
    (0.40, 0.018, 0.12, 0.14),
    (0.35, 0.022, 0.11, 0.10),
    (0.29, 0.020, 0.08, 0.05),
)
CRACKED = 0.0575
"""Mean of (1 − 5|x|)² where 5|x| < 1, x normal."""
WIND = np.array([40.0, 17.0])
"""Wavevector of the sand's ripples, rad/m."""
DIP = np.array([0.21, -0.13])
"""Slope of the layers of rock, negative."""
WRACK = np.array([0.08, 0.06, 0.04])
FILM_ROUGHNESS2 = 0.003
"""Mean square slope of the film of water on sand."""
DRYING = 4.0, 40.0
"""Times in which the film of water and the sand dry to 1/e, s."""


@dataclass(frozen=True, eq=False)
class Soil:
    """What land looks like at places (r,)."""

    normal: Floats
    """(r, 3) unit vectors, of the relief."""
    albedo: Floats
    """(r, 3)."""
    film: Floats
    """(r,) share that a film of water mirrors."""
    roughness2: float
    """Mean square slope of the film."""
    glints: bool
    """Whether the film mirrors the sun."""


def slopes(key: int, x: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
    """Gradient noise with cells of size 1, standard deviation 1, and its gradient; of the shape of ``x``."""
    i, j = np.floor(x), np.floor(z)
    u, v = x - i, z - j
    columns, rows = i.astype(np.int64), j.astype(np.int64)

    def word(column: Indices, row: Indices) -> tuple[Floats, Floats]:
        low = np.uint64(0xFFFFFFFF)
        first = pcg((column.astype(np.uint64) & low) ^ np.uint64(key & 0xFFFFFFFF))
        drawn = pcg(first ^ (row.astype(np.uint64) & low))
        x_part = (drawn & np.uint64(0xFFFF)).astype(np.float64) / 32767.5 - 1.0
        return x_part, (drawn >> np.uint64(16)).astype(np.float64) / 32767.5 - 1.0

    def fade(t: Floats) -> tuple[Floats, Floats]:
        return t**3 * (t * (6.0 * t - 15.0) + 10.0), 30.0 * t**2 * (1.0 - t) ** 2

    (w_u, s_u), (w_v, s_v) = fade(u), fade(v)
    value, along_x, along_z = np.zeros_like(u), np.zeros_like(u), np.zeros_like(u)
    for a, share_u, change_u in ((0, 1.0 - w_u, -s_u), (1, w_u, s_u)):
        for b, share_v, change_v in ((0, 1.0 - w_v, -s_v), (1, w_v, s_v)):
            g_x, g_z = word(columns + a, rows + b)
            rise = g_x * (u - a) + g_z * (v - b)
            value += share_u * share_v * rise
            along_x += share_u * share_v * g_x + change_u * share_v * rise
            along_z += share_u * share_v * g_z + share_u * change_v * rise
    return STRENGTH * value, STRENGTH * along_x, STRENGTH * along_z


@dataclass(eq=False)
class _Noise:
    """Octaves of noise under footprints: see shore/soil.glsl@soil."""

    bands: Floats
    """(r, 4): octaves of 64 and 20 m together, of 6 m, of 2 m, and finer ones together."""
    pattern: Floats
    hidden: Floats
    cracks: Floats
    strings: Floats
    relief: Floats
    """(r, 3, 2): slopes on sand, rock and plants."""


def _noise(q_x: Floats, q_z: Floats, ground: tuple[Floats, Floats, Floats], feet: Feet) -> _Noise:
    """Noise in the level plane, and on walls in the upright planes; ``ground``: height and its gradient."""
    count = q_x.size
    result = _Noise(
        np.zeros((count, 4)), np.zeros(count), np.ones(count), np.zeros(count), np.zeros(count), np.zeros((count, 3, 2))
    )
    y, g_x, g_z = ground
    lean_x, lean_z = np.abs(g_x), np.abs(g_z)
    wall = smoothstep(0.8, 1.5, np.hypot(lean_x, lean_z))
    over_x = smoothstep(0.4, 0.6, lean_z / np.maximum(lean_x + lean_z, 1e-6))
    shares = np.stack((1.0 - wall, wall * over_x, wall * (1.0 - over_x)))
    gains = shares / np.sqrt((shares**2).sum(axis=0))
    level_x, level_z = np.tile((1.0, 0.0), (count, 1)), np.tile((0.0, 1.0), (count, 1))
    upward = np.stack((g_x, g_z), axis=-1)
    planes = (((q_x, q_z), level_x, level_z), ((q_x, y), level_x, upward), ((q_z, y), level_z, upward))
    for i, (place, along, up) in enumerate(planes):
        _add_octaves(result, place, (along, up), KEY + 8 * i, (gains[i], shares[i]), feet)
    result.hidden = np.maximum(result.hidden, 0.0)
    return result


def _add_octaves(
    result: _Noise,
    place: tuple[Floats, Floats],
    axes: tuple[Floats, Floats],
    key: int,
    weights: tuple[Floats, Floats],
    feet: Feet,
) -> None:
    """Adds octaves at ``place`` in a plane whose coordinates have the gradients ``axes`` (r, 2) in x and z.

    ``weights``: gain of the noise, and share of means, (r,) each.
    """
    gain, part_of_means = weights
    x, y = (np.stack([dot(axis, foot) for axis in axes], axis=-1) for foot in feet)
    longer = np.sqrt(np.maximum(dot(x, x), dot(y, y)))
    area = np.abs(x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0])
    reach = np.maximum(area / np.maximum(longer, 1e-9), 0.3 * longer)
    turn, cell = complex(1.0, 0.0), CELL
    for i, (part, *heights) in enumerate(OCTAVES):
        turn *= complex(0.8, 0.6)
        kept = 1.0 - smoothstep(0.15, 0.6, reach / cell)
        at_x = (turn.real * place[0] - turn.imag * place[1]) / cell
        at_z = (turn.imag * place[0] + turn.real * place[1]) / cell
        n, n_x, n_z = slopes(key + i, at_x, at_z)
        slope = (turn.real * n_x + turn.imag * n_z)[:, None] * axes[0]
        slope = (gain * kept)[:, None] * (slope + (turn.real * n_z - turn.imag * n_x)[:, None] * axes[1])
        result.bands[:, max(0, min(i - 1, 3))] += {0: 0.7, 1: 0.7, 2: 1.0, 3: 1.0}.get(i, 0.6) * gain * kept * n
        result.pattern += part * gain * kept * n
        result.hidden -= part_of_means * part * part * kept * kept
        crack = CRACKED + kept * (np.maximum(1.0 - 5.0 * np.abs(n), 0.0) ** 2 - CRACKED)
        if 2 <= i <= 4:
            result.cracks += part_of_means * crack
        if i >= 5:
            result.strings += part_of_means * crack
        sand, rock, plants = heights
        result.relief[:, 0] += sand * slope
        result.relief[:, 1] -= rock * (n / np.sqrt(n * n + 0.04))[:, None] * slope
        result.relief[:, 2] += plants * slope
        cell *= FINER


def _layer(key: int, x: Floats, width: Floats) -> tuple[Floats, Floats]:
    """Value noise along a line, mean 0, and its derivative, under a width; (r,)."""
    base = np.floor(x)
    t = x - base
    low, first = np.uint64(0xFFFFFFFF), pcg(np.array([key & 0xFFFFFFFF], np.uint64))
    a, b = (share(pcg(first ^ ((base.astype(np.int64) + k).astype(np.uint64) & low))) for k in (0, 1))
    kept = 1.0 - smoothstep(0.15, 0.6, width)
    return kept * (a + (b - a) * t * t * (3.0 - 2.0 * t) - 0.5), kept * (b - a) * 6.0 * t * (1.0 - t)


def _mix(a: Floats, b: Floats, part: Floats) -> Floats:
    result: Floats = a + (b - a) * part[:, None]
    return result


def wetness(coast: "Coast", q_x: Floats, q_z: Floats, height: Floats) -> tuple[Floats, Floats]:
    """How dark the swash left the ground, and how much of it mirrors; (r,) each."""
    surf = coast.shore.surf
    dark = coast.wet(height)
    if surf.height <= 0.0:
        return dark, 0.6 * dark
    swash = 0.3 * surf.height
    film = 1.0 - smoothstep(0.1 * swash, 0.6 * swash + 0.03, height)
    here, _, _ = coast.field.all(q_x, q_z)
    swept = 1.0 - smoothstep(0.8, 1.05, height / np.maximum(here[:, 1], 1e-3))
    since = (coast.turn(here[:, 0]) - 1.0) * surf.period
    near = height <= 1.3 * swash + 0.2
    after = [np.where(near, swept * np.exp(since / drying), 0.0) for drying in DRYING]
    return np.maximum(dark, after[1]), np.maximum(film, after[0])


def _strand(surf: float, y: Floats, of_6: Floats, of_2: Floats) -> Floats:
    """How near the line of the last swash is, in [0, 1], of surf so high (m), at heights y over still water (m)."""
    line = 0.4 * surf + 0.12
    strand = (y - line) / (0.2 * line + 0.02) + 0.5 * of_6 + 0.35 * of_2
    return 1.0 - smoothstep(0.0, 1.0, np.abs(strand))


def detailed(
    coast: "Coast", q_x: Floats, q_z: Floats, feet: Feet, wet: tuple[Floats, Floats], *, floor: bool = False
) -> Soil:
    """Land in detail at (q_x, q_z), m from the square's centre, of a wetness (darkness, mirror).

    ``floor``: below still water as if it lay 8 m lower, without plants.
    """
    shore = coast.shore
    d = shore.detail
    y, g_x, g_z, tint = coast.ground(q_x, q_z)
    if floor:
        y = y - 8.0 * smoothstep(0.0, 0.15, -y)
    ground = np.stack((g_x, g_z), axis=-1)
    steep = np.hypot(g_x, g_z)
    of = _noise(q_x, q_z, (y, g_x, g_z), feet)
    broad, of_6, of_2, fine = of.bands.T
    spread = d * d * of.hidden

    ragged = 0.15 * d * of.pattern * (wet[0] < 1.0)
    damp = torn_step(0.25, 0.6, wet[0] + ragged, 0.02 * spread)
    tone = np.maximum(1.0 + d * (0.06 * broad + 0.05 * of_6 + 0.05 * of_2 + 0.11 * fine), 0.2)
    sand = np.array(shore.sand) * tone[:, None]
    phases = np.stack([foot @ WIND for foot in feet])
    combed = np.exp(-np.minimum((phases**2).sum(axis=0), 1800.0) / 24.0) * (1.0 - damp)
    combed *= smoothstep(-0.6, 1.0, of_6 + 0.5 * broad) * (1.0 - smoothstep(0.15, 0.35, steep))
    turn = WIND[0] * q_x + WIND[1] * q_z + 2.2 * of_2 + 1.2 * fine
    slope = (1.0 - 0.85 * damp)[:, None] * of.relief[:, 0]
    slope = slope + (0.28 * combed * np.cos(turn))[:, None] * WIND / math.hypot(*WIND)
    sand = sand * (1.0 + d * 0.08 * combed * np.sin(turn))[:, None]
    albedo = _mix(sand, 0.68 * sand / (1.77 - 0.77 * sand), damp)

    strings = np.minimum(1.5 * of.strings * smoothstep(0.3, 1.8, 0.6 * of_2 + 1.8 * fine), 1.0)
    albedo = _mix(albedo, WRACK, 0.6 * d * _strand(shore.surf.height, y, of_6, of_2) * strings)

    rock, rock_slope = _rock(coast, of, y + q_x * DIP[0] + q_z * DIP[1], ground + DIP, feet)
    rock = rock * (1.0 - 0.5 * damp)[:, None]
    rough = np.minimum(1.6 * steep, 0.5) * d
    leaning = ground + rough[:, None] * of.relief[:, 1]
    rough2 = 0.45 * rough**2 * of.hidden
    uneven = 0.3 * np.minimum(steep, 0.5) * d * of.pattern
    rocky = torn_step(0.35, 0.6, np.sqrt(dot(leaning, leaning) + rough2) + uneven, 0.02 * spread + 0.6 * rough2)

    above = y + 4.0 * (tint - 0.5) + 1.1 * d * of.pattern
    grown = torn_step(shore.plants_from, 1.25 * shore.plants_from + 0.5, above, 1.2 * spread)
    lit = torn_step(-1.4, 1.6, 0.5 * of_6 + 0.7 * of_2 + 0.6 * fine, 0.5 * of.hidden)
    drier = d * smoothstep(-0.4, 1.6, broad + 0.4 * of_6)
    green = np.array(shore.plants) * _mix(np.ones((y.size, 3)), np.array([2.3, 1.65, 1.5]), drier)
    green = green * (1.0 + d * (0.3 + 1.5 * lit - 1.0))[:, None]
    bare = d * torn_step(0.9, 1.7, 0.8 * broad - 0.7 * of.pattern, 0.5 * of.hidden)
    earth = 0.75 * (0.4 * sand + 0.6 * np.array(shore.rock))

    albedo = _mix(albedo, _mix(green, earth, bare), grown)
    slope = _mix(slope, _mix(of.relief[:, 2], 0.5 * of.relief[:, 1], bare), grown)
    albedo, slope = _mix(albedo, rock, rocky), _mix(slope, rock_slope, rocky)
    film = wet[1] * (1.0 - rocky) * (1.0 - grown)
    film = torn_step(0.1, 0.75, film + 0.1 * d * of.pattern * wet[1], 0.01 * spread)
    leans = ground + (d * (1.0 - 0.9 * film))[:, None] * slope
    normal = unit(np.stack((-leans[:, 0], np.ones_like(y), -leans[:, 1]), axis=-1))
    return Soil(normal, np.minimum(albedo, 0.95), film, FILM_ROUGHNESS2, glints=True)


def _rock(coast: "Coast", of: _Noise, level: Floats, across: Floats, feet: Feet) -> tuple[Floats, Floats]:
    """Reflectance (r, 3) and slopes (r, 2) of rock; ``level``: height over its layers, ``across``: gradient of that."""
    d = coast.shore.detail
    broad, of_6, of_2, fine = of.bands.T
    layer = level + d * (0.9 * broad + 0.35 * of_6 + 0.12 * of_2)
    width = np.sqrt(sum((across * foot).sum(axis=1) ** 2 for foot in feet))
    (thick, thick_s), (middle, middle_s), (thin, thin_s) = (
        _layer(KEY + 32 + i, layer / size, width / size) for i, size in enumerate((7.0, 1.7, 0.37))
    )
    tone = np.maximum(1.0 + d * (0.75 * (thick + middle + 0.7 * thin) + 0.16 * of.pattern), 0.15)
    tone *= 1.0 - d * 0.35 * np.minimum(of.cracks * smoothstep(-0.5, 1.2, of_6 + fine), 1.0)
    warm = d * np.clip(0.8 * thick + 0.3 * of_6, -1.0, 1.0)
    rock = np.array(coast.shore.rock) * tone[:, None] * (1.0 + warm[:, None] * np.array([0.12, 0.0, -0.14]))
    ledges = 0.5 * thick_s + 0.5 * middle_s + 0.4 * thin_s
    result: Floats = of.relief[:, 1] - ledges[:, None] * across
    return rock, result
