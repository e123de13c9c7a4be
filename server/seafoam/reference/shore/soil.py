"""Section 8: land in detail, and how wet the swash left it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from seafoam.reference.noise import chained, filtered_step, perlin, share
from seafoam.reference.types import Floats, Footprints, Pair, Vec2, dot, smoothstep, unit
from seafoam.scene import Shore

KEY = 0x51ED270B
CELL = 64.0  # side of the first octave's cells, m
FINER = 0.31
STRENGTH = 5.672  # over the standard deviation of the gradient noise
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
CRACKED = 0.0575  # mean of (1 − 5|x|)² where 5|x| < 1, x normal
WIND = np.array([40.0, 17.0])  # wavevector of the sand's ripples, rad/m
DIP = np.array([0.21, -0.13])  # slope of the layers of rock, negative
WRACK = np.array([0.08, 0.06, 0.04])
FILM_ROUGHNESS2 = 0.003  # mean square slope of the film of water on sand
LAYERS = 7.0, 1.7, 0.37  # thickness of the layers of rock, m
SPLASHED_ROUGHNESS2 = 0.04  # the same where drops fall on land
SUNKEN = 8.0  # how much lower the ground below still water lies for its look, m


@dataclass(frozen=True)
class Pattern:
    """A weighted sum of octaves of noise: of those of 64 and 20 m together, of 6 m, of 2 m, of all finer ones together,
    and of all by their shares; and the range over which the pattern grows to full."""

    broad: float = 0.0
    six: float = 0.0
    two: float = 0.0
    fine: float = 0.0
    all: float = 0.0
    grows: Vec2 = (0.0, 1.0)

    def sum(self, noise: "_Noise", start: Floats | float = 0.0) -> Floats:
        """The sum (r,), added to ``start``."""
        weights = (self.broad, self.six, self.two, self.fine, self.all)
        total = start + np.zeros_like(noise.pattern)
        for weight, band in zip(weights, (*noise.bands.T, noise.pattern), strict=True):
            total = total + weight * band
        return total

    def grown(self, noise: "_Noise") -> Floats:
        """How far it has grown at each place; (r,) in [0, 1]."""
        return smoothstep(*self.grows, self.sum(noise))

    def grown_under(self, noise: "_Noise") -> Floats:
        """The same as a mean under footprints, which hide a part of the octaves."""
        return filtered_step(*self.grows, self.sum(noise), 0.5 * noise.hidden)


SAND_TONE = Pattern(broad=0.06, six=0.05, two=0.05, fine=0.11)  # lightness of sand, about 1
RIPPLE_BEND = Pattern(two=2.2, fine=1.2)  # by how much ripples of the wind are off their straight lines, rad
RIPPLED = Pattern(broad=0.5, six=1.0, grows=(-0.6, 1.0))  # where the wind has combed the sand
STRAND_BEND = Pattern(six=0.5, two=0.35)
"""By how much the strand line is off a contour of height, over its width."""
STRINGS = Pattern(two=0.6, fine=1.8, grows=(0.3, 1.8))  # where wrack lies on the strand line
LAYER_BEND = Pattern(broad=0.9, six=0.35, two=0.12)  # by how much layers of rock are off their plane, m
CRACKED_ROCK = Pattern(six=1.0, fine=1.0, grows=(-0.5, 1.2))  # where rock has cracks
CROWNS = Pattern(six=0.5, two=0.7, fine=0.6, grows=(-1.4, 1.6))  # crowns of plants between their shadows
DRY_PLANTS = Pattern(broad=1.0, six=0.4, grows=(-0.4, 1.6))  # where plants are yellow
BARE_EARTH = Pattern(broad=0.8, all=-0.7, grows=(0.9, 1.7))  # earth between plants


@dataclass(frozen=True, eq=False)
class Soil:
    """What land looks like at places (r,)."""

    normal: Floats  # (r, 3) unit vectors, of the relief
    albedo: Floats  # (r, 3)
    film: Floats  # (r,) share that a film of water mirrors
    roughness2: float  # mean square slope of the film
    glints: bool  # whether the film mirrors the sun


@dataclass(eq=False)
class _Noise:
    """Octaves of noise under footprints: see shore/soil.glsl@soil."""

    bands: Floats  # (r, 4): octaves of 64 and 20 m together, of 6 m, of 2 m, and finer ones together
    pattern: Floats
    hidden: Floats
    cracks: Floats
    strings: Floats
    relief: Floats  # (r, 3, 2): slopes on sand, rock and plants


def _noise(q_x: Floats, q_z: Floats, ground: tuple[Floats, Floats, Floats], footprints: Footprints) -> _Noise:
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
        _add_octaves(result, place, (along, up), KEY + 8 * i, (gains[i], shares[i]), footprints)
    result.hidden = np.maximum(result.hidden, 0.0)
    return result


def _add_octaves(result: _Noise, place: Pair, axes: Pair, key: int, weights: Pair, footprints: Footprints) -> None:
    """Adds octaves at ``place`` in a plane whose coordinates have the gradients ``axes`` (r, 2) in x and z.
    ``weights``: gain of the noise, and share of means, (r,) each."""
    gain, part_of_means = weights
    x, y = (np.stack([dot(axis, side) for axis in axes], axis=-1) for side in footprints)
    longer = np.sqrt(np.maximum(dot(x, x), dot(y, y)))
    area = np.abs(x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0])
    reach = np.maximum(area / np.maximum(longer, 1e-9), 0.3 * longer)
    turn, cell = complex(1.0, 0.0), CELL
    for i, (part, *heights) in enumerate(OCTAVES):
        turn *= complex(0.8, 0.6)
        kept = 1.0 - smoothstep(0.15, 0.6, reach / cell)
        at_x = (turn.real * place[0] - turn.imag * place[1]) / cell
        at_z = (turn.imag * place[0] + turn.real * place[1]) / cell
        n, (n_x, n_z) = (STRENGTH * part for part in perlin(np.column_stack((at_x, at_z)), key + i, 2**32))
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


def _layer(key: int, x: Floats, width: Floats) -> Pair:
    """Value noise along a line, mean 0, and its derivative, under a width; (r,)."""
    base = np.floor(x)
    t = x - base
    a, b = (share(chained(0, np.full(base.shape, key), base + k)) for k in (0, 1))
    kept = 1.0 - smoothstep(0.15, 0.6, width)
    return kept * (a + (b - a) * t * t * (3.0 - 2.0 * t) - 0.5), kept * (b - a) * 6.0 * t * (1.0 - t)


def _mix(a: Floats, b: Floats, part: Floats) -> Floats:
    return a + (b - a) * part[:, None]


def detailed(
    shore: Shore,
    place: Pair,
    ground: tuple[Floats, Floats, Floats, Floats],
    footprints: Footprints,
    wet: Pair,
    *,
    floor: bool = False,
) -> Soil:
    """Land in detail at places (x, z), m from the square's centre, of a wetness (darkness, mirror), (r,) each.

    ``ground``: its height (m), gradient (x, z) and tint, (r,) each. ``floor``: below still water as if it lay
    ``SUNKEN`` m lower, without plants.
    """
    d = shore.detail
    y, g_x, g_z, tint = ground
    if floor:
        y = y - SUNKEN * smoothstep(0.0, 0.15, -y)
    gradient = np.stack((g_x, g_z), axis=-1)
    steep = np.hypot(g_x, g_z)
    noise = _noise(*place, (y, g_x, g_z), footprints)
    lost = d * d * noise.hidden

    ragged = 0.15 * d * noise.pattern * (wet[0] < 1.0)
    damp = filtered_step(0.25, 0.6, wet[0] + ragged, 0.02 * lost)
    sand, slope = _sand(shore, place, steep, noise, footprints, damp)
    albedo = _mix(sand, 0.68 * sand / (1.77 - 0.77 * sand), damp)
    albedo = _mix(albedo, WRACK, _wrack(shore, y, noise))

    rock, rock_slope = _rock(shore, noise, y + place[0] * DIP[0] + place[1] * DIP[1], gradient + DIP, footprints)
    rock = rock * (1.0 - 0.5 * damp)[:, None]
    rough = np.minimum(1.6 * steep, 0.5) * d
    leaning = gradient + rough[:, None] * noise.relief[:, 1]
    rough2 = 0.45 * rough**2 * noise.hidden
    uneven = 0.3 * np.minimum(steep, 0.5) * d * noise.pattern
    rocky = filtered_step(0.35, 0.6, np.sqrt(dot(leaning, leaning) + rough2) + uneven, 0.02 * lost + 0.6 * rough2)

    above = y + 4.0 * (tint - 0.5) + 1.1 * d * noise.pattern
    grown = filtered_step(shore.plants_from, 1.25 * shore.plants_from + 0.5, above, 1.2 * lost)
    bare = d * BARE_EARTH.grown_under(noise)
    earth = 0.75 * (0.4 * sand + 0.6 * np.array(shore.rock))

    albedo = _mix(albedo, _mix(_plants(shore, noise), earth, bare), grown)
    slope = _mix(slope, _mix(noise.relief[:, 2], 0.5 * noise.relief[:, 1], bare), grown)
    albedo, slope = _mix(albedo, rock, rocky), _mix(slope, rock_slope, rocky)
    film = wet[1] * (1.0 - rocky) * (1.0 - grown)
    film = filtered_step(0.1, 0.75, film + 0.1 * d * noise.pattern * wet[1], 0.01 * lost)
    leans = gradient + (d * (1.0 - 0.9 * film))[:, None] * slope
    normal = unit(np.stack((-leans[:, 0], np.ones_like(y), -leans[:, 1]), axis=-1))
    return Soil(normal, np.minimum(albedo, 0.95), film, FILM_ROUGHNESS2, glints=True)


def splashed(soil: Soil, height: float, ground: tuple[Floats, Floats, Floats, Floats], wet: Floats) -> Soil:
    """Land on which drops fall up to a height (m, twice that for the last); ``wet`` (r,): dark by the swash."""
    y, g_x, g_z, _ = ground
    part = 1.0 - smoothstep(height, 2.0 * height, y)
    level = unit(np.stack((-g_x, np.ones_like(y), -g_z), axis=-1))
    albedo = soil.albedo * (1.0 - 0.5 * part * (1.0 - smoothstep(0.25, 0.6, wet)))[:, None]
    film = np.maximum(soil.film, 0.3 * part * smoothstep(0.85, 1.0, dot(soil.normal, level)))
    return replace(soil, albedo=albedo, film=film, roughness2=SPLASHED_ROUGHNESS2)


def _sand(shore: Shore, place: Pair, steep: Floats, noise: _Noise, footprints: Footprints, damp: Floats) -> Pair:
    """Reflectance (r, 3) and slopes (r, 2) of dry sand, combed by the wind where it is level and not ``damp`` (r,)."""
    d = shore.detail
    tone = np.maximum(1.0 + d * SAND_TONE.sum(noise), 0.2)
    phases = np.stack([side @ WIND for side in footprints])
    combed = np.exp(-np.minimum((phases**2).sum(axis=0), 1800.0) / 24.0) * (1.0 - damp)
    combed *= RIPPLED.grown(noise) * (1.0 - smoothstep(0.15, 0.35, steep))
    turn = RIPPLE_BEND.sum(noise, WIND[0] * place[0] + WIND[1] * place[1])
    slope = (1.0 - 0.85 * damp)[:, None] * noise.relief[:, 0]
    slope = slope + (0.28 * combed * np.cos(turn))[:, None] * WIND / math.hypot(*WIND)
    sand = np.array(shore.sand) * tone[:, None]
    return sand * (1.0 + d * 0.08 * combed * np.sin(turn))[:, None], slope


def _wrack(shore: Shore, y: Floats, noise: _Noise) -> Floats:
    """Share (r,) of the ground that wrack covers, on the line of the last swash, at heights y over still water, m."""
    line = 0.4 * shore.surf.height + 0.12
    strand = STRAND_BEND.sum(noise, (y - line) / (0.2 * line + 0.02))
    strings = np.minimum(1.5 * noise.strings * STRINGS.grown(noise), 1.0)
    return 0.6 * shore.detail * (1.0 - smoothstep(0.0, 1.0, np.abs(strand))) * strings


def _plants(shore: Shore, noise: _Noise) -> Floats:
    d = shore.detail
    drier = d * DRY_PLANTS.grown(noise)
    green = np.array(shore.plants) * _mix(np.ones((drier.size, 3)), np.array([2.3, 1.65, 1.5]), drier)
    return green * (1.0 + d * (0.3 + 1.5 * CROWNS.grown_under(noise) - 1.0))[:, None]


def _rock(shore: Shore, noise: _Noise, level: Floats, across: Floats, footprints: Footprints) -> Pair:
    """Reflectance (r, 3) and slopes (r, 2) of rock; ``level``: height over its layers, ``across``: gradient of that."""
    d = shore.detail
    layer = level + d * LAYER_BEND.sum(noise)
    width = np.sqrt(sum((across * side).sum(axis=1) ** 2 for side in footprints))
    (thick, thick_s), (middle, middle_s), (thin, thin_s) = (
        _layer(KEY + 32 + i, layer / size, width / size) for i, size in enumerate(LAYERS)
    )
    tone = np.maximum(1.0 + d * (0.75 * (thick + middle + 0.7 * thin) + 0.16 * noise.pattern), 0.15)
    tone *= 1.0 - d * 0.35 * np.minimum(noise.cracks * CRACKED_ROCK.grown(noise), 1.0)
    warm = d * np.clip(0.8 * thick + 0.3 * noise.bands[:, 1], -1.0, 1.0)
    rock = np.array(shore.rock) * tone[:, None] * (1.0 + warm[:, None] * np.array([0.12, 0.0, -0.14]))
    ledges = 0.5 * thick_s + 0.5 * middle_s + 0.4 * thin_s
    result: Floats = noise.relief[:, 1] - ledges[:, None] * across
    return rock, result
