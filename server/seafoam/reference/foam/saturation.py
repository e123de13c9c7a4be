"""Section 4: the saturation f of foam, before any look thresholds it."""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np

from seafoam.reference.foam.front import (
    CAP,
    FRONT_CONSTANTS,
    STILL,
    History,
    decaying_front,
    front_saturation,
    front_saturation_filtered,
    gate,
    group,
    phase_gradient,
    phases_under,
)
from seafoam.reference.types import Floats, SurfacePoints
from seafoam.reference.waves.parametric import WaveSet
from seafoam.scene.foam import FrontSaturation


def height_saturation(H: Floats, base: float, full: float) -> Floats:
    """f = (H − H₀)/(Hmax − H₀), held in [0, 4]; H, H₀ and Hmax in m."""
    return np.clip((H - base) / (full - base), 0.0, CAP)


Slopes = Callable[[Floats, Floats], tuple[Floats, Floats]]
"""The surface's gradient at (x, z), m from the origin; (r,) each."""


def slope_saturation(slopes: Slopes, x: Floats, z: Floats, gain: float, base: float, blur: float) -> Floats:
    """f = gain (1 − n.y − base), held in [0, 4]; with a blur (m) 1 − n.y is a mean of five places, a cross."""
    offsets = ((0.0, 0.0), (blur, 0.0), (-blur, 0.0), (0.0, blur), (0.0, -blur)) if blur > 0.0 else ((0.0, 0.0),)
    lack = np.zeros_like(x)
    for dx, dz in offsets:
        h_x, h_z = slopes(x + dx, z + dz)
        lack += (1.0 - 1.0 / np.sqrt(1.0 + h_x * h_x + h_z * h_z)) / len(offsets)
    return np.clip(gain * (lack - base), 0.0, CAP)


def joined(parts: list[Floats], combine: Literal["max", "product"], cap: float) -> Floats:
    """The greatest or the product of saturations, each and the result capped; one array or more."""
    result = np.minimum(parts[0], cap)
    for part in parts[1:]:
        held = np.minimum(part, cap)
        result = np.maximum(result, held) if combine == "max" else result * held
    return np.minimum(result, cap)


def front_source(
    source: FrontSaturation, waves: WaveSet, points: SurfacePoints, eye_y: float, history: History = STILL
) -> Floats:
    """f of fronts at points; (r,).

    ``waves``: those of the source's constants. With footprints fronts are averaged over what an eye at a height of
    ``eye_y`` m over (0, 0) sees of them. ``history``: how foam that fronts leave moves with the water.
    """
    if waves.amplitude.size == 0:
        return np.zeros_like(points.x)
    if source.decay is not None:
        return decaying_front(source, waves, points, eye_y, history)
    constants = FRONT_CONSTANTS[source.constants]
    sum_of = group(waves, points.x, points.z, constants.delta)
    if points.footprints is None:
        f = np.minimum(front_saturation(sum_of.X, sum_of.Y, source.intensity, constants.base), points.cap)
    else:
        psi, crest = np.arctan2(sum_of.Y, sum_of.X), 2.0 * constants.delta - 0.5 * math.pi
        psi, width = phases_under(psi, phase_gradient(sum_of), points, eye_y, waves.relief, crest)
        f = front_saturation_filtered(psi, width, source.intensity, constants.base)
    return f * gate(sum_of.rho, source.group)
