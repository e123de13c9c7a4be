"""Section 5: foam with a history, in float64: its drift, its windrows, and its masks by age."""

import math

import numpy as np

from seafoam.ocean.waves.stokes import foam_drift, foam_life
from seafoam.reference.foam.cells import part
from seafoam.reference.noise import PERIOD, perlin
from seafoam.reference.types import Floats, Pair, Vec2, smoothstep
from seafoam.reference.waves.parametric import reduced
from seafoam.scene import Scene

AGE = 0.8  # age between one mask and the next, in e-folds of the saturation
ROW_LENGTH = 8.0
RIDGE = 7.781
ROW_SEED = 1938


def gathered(scene: Scene, time: float, origin: Vec2, s: Floats, x: Floats, z: Floats) -> Floats:
    """The coverage s (r,) at (x, z), m from the origin, concentrated in windrows; (r,)."""
    life = foam_life(scene)
    if life is None or life.row_strength == 0.0:
        return s
    cosine, sine = math.cos(life.downwind), math.sin(life.downwind)
    across = 1.0 / life.windrow_spacing
    rows = ((cosine * across / ROW_LENGTH, sine * across / ROW_LENGTH), (-sine * across, cosine * across))
    drift, turn, cells = foam_drift(scene), 2.0 * math.pi / PERIOD, PERIOD / (2.0 * math.pi)
    place = []
    for a, b in rows:
        at_eye = reduced((turn * a, origin[0]), (turn * b, origin[1]), (-turn * (a * drift[0] + b * drift[1]), time))
        place.append(cells * at_eye + a * x + b * z)
    ridge = np.maximum(1.0 - RIDGE * np.abs(perlin(np.column_stack(place), ROW_SEED)), -1.0)
    return s + life.row_strength * ridge * s * (1.0 - s)


def shares(masks: int, s: Floats, f: Floats) -> list[Pair]:
    """How the coverage s (r,) of foam of saturation f (r,) in [0, 1] is divided among masks by its age.

    Of each mask, the foam's own first, the weight, 0 where it has no foam, and the share of the plane; (r,) each.
    """
    if masks == 1:
        return [(np.ones_like(s), s)]
    age = np.clip(-np.log(np.maximum(f, 1e-6)) / AGE, 0.0, masks - 1.0)
    young = np.minimum(np.floor(age), masks - 2.0)
    older = smoothstep(0.35, 0.65, age - young)
    result = []
    for mask in range(masks):
        weight = np.where(young == mask, 1.0 - older, np.where(young + 1.0 == mask, older, 0.0))
        result.append((weight, part(s, weight)))
    return result


def drifted(scene: Scene, time: float, origin: Vec2) -> Vec2:
    """Mask coordinates (u, v) of the origin, moved back along the drift; tiles in [0, 1)."""
    foam = scene.foam
    assert foam is not None
    drift, turn = foam_drift(scene), 2.0 * math.pi
    cosine, sine = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    rates = -turn * (cosine * drift[0] + sine * drift[1]), -turn * (cosine * drift[1] - sine * drift[0])
    u = reduced((turn * cosine, origin[0]), (turn * sine, origin[1]), (rates[0], time))
    v = reduced((-turn * sine, origin[0]), (turn * cosine, origin[1]), (rates[1], time))
    return u / turn, v / turn
