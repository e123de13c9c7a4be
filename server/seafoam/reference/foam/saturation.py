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
from seafoam.scene.foam import (
    DriftSaturation,
    FoldSaturation,
    HeightSaturation,
    Saturation,
    SlopeSaturation,
    SurfSaturation,
    WakeSaturation,
)


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


def saturation(
    sources: tuple[Saturation, ...],
    combine: Literal["max", "product"],
    waves: dict[str, WaveSet],
    slopes: Slopes,
    x: Floats,
    z: Floats,
    H: Floats,
    *,
    cap: float,
    footprints: tuple[Floats, Floats] | None,
    eye_height: float,
    level: float,
    folds: list[Floats],
    surf: Callable[[SurfSaturation, Floats, Floats, Floats], Floats] | None = None,
    drift: Callable[[DriftSaturation, Floats, Floats], Floats] | None = None,
    wake: Callable[[WakeSaturation, Floats, Floats, float], Floats] | None = None,
    history: History = STILL,
) -> Floats:
    """f at (x, z), m from the origin, where the surface is at height H; (r,) in [0, cap].

    ``waves`` holds the waves for each kind of front constants, ``slopes`` is the gradient that light sees. With
    footprints (each (r, 2) m) fronts are averaged over what an eye at this height (m) over (0, 0) sees of them.
    ``level``: still water over the waves' troughs, m. ``folds``: f of the fold sources, in their order. ``surf``
    gives the foam of a shore's surf, ``drift`` that a flow carries, ``wake`` that behind boats; without them there is
    none. ``history``: how foam that fronts leave moves with the water.
    """
    parts = []
    given = iter(folds)
    for source in sources:
        if isinstance(source, HeightSaturation):
            parts.append(height_saturation(H + level, source.base, source.full))
            continue
        if isinstance(source, SlopeSaturation):
            parts.append(slope_saturation(slopes, x, z, source.gain, source.base, source.blur))
            continue
        if isinstance(source, FoldSaturation):
            parts.append(next(given))
            continue
        if isinstance(source, SurfSaturation):
            parts.append(np.zeros_like(x) if surf is None else surf(source, x, z, H))
            continue
        if isinstance(source, DriftSaturation):
            parts.append(np.zeros_like(x) if drift is None else drift(source, x, z))
            continue
        if isinstance(source, WakeSaturation):
            parts.append(np.zeros_like(x) if wake is None else wake(source, x, z, cap))
            continue
        if waves[source.constants].amplitude.size == 0:
            parts.append(np.zeros_like(x))
            continue
        constants = FRONT_CONSTANTS[source.constants]
        if source.decay is not None:
            parts.append(
                living_front(source, source.decay, waves[source.constants], x, z, footprints, eye_height - H, history)
            )
            continue
        sum_of = group(waves[source.constants], x, z, constants.delta)
        if footprints is None:
            f = np.minimum(front_saturation(sum_of.X, sum_of.Y, source.intensity, constants.base), cap)
        else:
            here = waves[source.constants]
            away = np.hypot(x, z)
            gradient = phase_gradient(sum_of)
            along = (gradient[:, 0] * x + gradient[:, 1] * z) / np.maximum(away, 1e-6)
            psi, width = seen_phases(
                np.arctan2(sum_of.Y, sum_of.X),
                phase_width(gradient, *footprints),
                along,
                np.hypot(gradient[:, 0], gradient[:, 1]),
                eye_height - H,
                away,
                here.relief,
                2.0 * constants.delta - 0.5 * math.pi,
            )
            f = front_saturation_filtered(psi, width, source.intensity, constants.base)
        parts.append(f * gate(sum_of.rho, source.group))
    return joined(parts, combine, cap)
