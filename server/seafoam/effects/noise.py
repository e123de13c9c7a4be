"""The noise library for effects: its files, and the position in noise that drifts and changes."""

import math
from collections.abc import Iterable

from seafoam.framegraph.rules import Phase, Uniform, array

HASH = "lib/noise.glsl@hash"
VALUE_NOISE = (HASH, "lib/noise.glsl@value")
SLOPES = (HASH, "lib/noise.glsl@slopes")
PERLIN_2 = (HASH, "lib/noise.glsl@perlin_2")
PERLIN_3 = (HASH, "lib/noise.glsl@perlin_3")

CELLS = 256
"""Period of the gradient noise, cells."""


def drifting_phases(axes: Iterable[tuple[float, float]], velocity: tuple[float, float], turn: float) -> Uniform:
    """Phases of the camera's place on a pattern that drifts with ``velocity``, (x, z) m/s; rad.

    ``axes``: those of the pattern, per metre; ``turn``: the phase of a unit along them, rad.
    """
    phases = [
        Phase(offset=0.0, rate=-turn * (x * velocity[0] + z * velocity[1]), k=(turn * x, turn * z)) for x, z in axes
    ]
    return array("float", phases, len(phases))


def drifting_noise(size: float, speed: float, heading: float, change: float) -> Uniform:
    """Phases (x, z, t), float[3], of three-dimensional gradient noise, 2π per :data:`CELLS` cells.

    ``size``: side of a cell, m; ``speed``, m/s, and ``heading``, rad, of its drift; ``change``: cell length along t, s.
    """
    k = 2.0 * math.pi / (CELLS * size)
    velocity = (speed * math.cos(heading), speed * math.sin(heading))
    changes = Phase(offset=0.0, rate=2.0 * math.pi / (CELLS * change), k=(0.0, 0.0))
    return array("float", (*drifting_phases(((1.0, 0.0), (0.0, 1.0)), velocity, k).rules, changes), 3)
