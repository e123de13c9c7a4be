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
    front_saturation,
    front_saturation_filtered,
    gate,
    group,
    living_front,
    phase_gradient,
    phase_width,
    seen_phases,
)
from seafoam.reference.types import Floats
from seafoam.reference.waves.parametric import WaveSet
from seafoam.scene.foam import FrontSaturation


def height_saturation(H: Floats, base: float, full: float) -> Floats:
    """f = (H − H₀)/(Hmax − H₀), held in [0, 4]; H, H₀ and Hmax in m."""
    result: Floats = np.clip((H - base) / (full - base), 0.0, CAP)
    return result


Slopes = Callable[[Floats, Floats], tuple[Floats, Floats]]
"""The surface's gradient at (x, z), m from the origin; (r,) each."""


def slope_saturation(slopes: Slopes, x: Floats, z: Floats, gain: float, base: float, blur: float) -> Floats:
    """f = gain (1 − n.y − base), held in [0, 4]; with a blur (m) 1 − n.y is a mean of five places, a cross."""
    ways = ((0.0, 0.0), (blur, 0.0), (-blur, 0.0), (0.0, blur), (0.0, -blur)) if blur > 0.0 else ((0.0, 0.0),)
    lack = np.zeros_like(x)
    for dx, dz in ways:
        h_x, h_z = slopes(x + dx, z + dz)
        lack += (1.0 - 1.0 / np.sqrt(1.0 + h_x * h_x + h_z * h_z)) / len(ways)
    result: Floats = np.clip(gain * (lack - base), 0.0, CAP)
    return result


def joined(parts: list[Floats], combine: Literal["max", "product"], cap: float) -> Floats:
    """The greatest or the product of saturations, each and the result capped; one array or more."""
    result = np.minimum(parts[0], cap)
    for part in parts[1:]:
        held = np.minimum(part, cap)
        result = np.maximum(result, held) if combine == "max" else result * held
    return np.minimum(result, cap)


def front_source(
    source: FrontSaturation,
    waves: WaveSet,
    x: Floats,
    z: Floats,
    footprints: tuple[Floats, Floats] | None,
    over: Floats,
    cap: float,
    history: History = STILL,
) -> Floats:
    """f of fronts at (x, z), m from the origin; (r,).

    ``waves``: those of the source's constants. With footprints (each (r, 2) m) fronts are averaged over what an eye
    ``over`` metres (r,) over each place, and over (0, 0), sees of them. ``history``: how foam that fronts leave moves
    with the water.
    """
    if waves.amplitude.size == 0:
        return np.zeros_like(x)
    constants = FRONT_CONSTANTS[source.constants]
    if source.decay is not None:
        return living_front(source, source.decay, waves, x, z, footprints, over, history)
    sum_of = group(waves, x, z, constants.delta)
    if footprints is None:
        f = np.minimum(front_saturation(sum_of.X, sum_of.Y, source.intensity, constants.base), cap)
    else:
        away = np.hypot(x, z)
        gradient = phase_gradient(sum_of)
        along = (gradient[:, 0] * x + gradient[:, 1] * z) / np.maximum(away, 1e-6)
        psi, width = seen_phases(
            np.arctan2(sum_of.Y, sum_of.X),
            phase_width(gradient, *footprints),
            along,
            np.hypot(gradient[:, 0], gradient[:, 1]),
            over,
            away,
            waves.relief,
            2.0 * constants.delta - 0.5 * math.pi,
        )
        f = front_saturation_filtered(psi, width, source.intensity, constants.base)
    return f * gate(sum_of.rho, source.group)
