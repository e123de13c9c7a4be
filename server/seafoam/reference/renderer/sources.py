"""Section 4: the saturation f of foam, before any look thresholds it: the function of each kind of source."""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np

from seafoam.extensions import TRUTHS
from seafoam.ocean.waves.stokes import foam_drift
from seafoam.reference.foam import front
from seafoam.reference.foam.drift import drift_saturation
from seafoam.reference.renderer.state import ReferenceState
from seafoam.reference.types import Floats, WaterSamples
from seafoam.reference.types import SurfacePoints as SurfacePoints
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.sea import whitecap_saturation
from seafoam.scene import foam as scenes

Slopes = Callable[[Floats, Floats], Floats]  # the surface's gradient at (x, z), m from the origin; (2, r)


def height_saturation(H: Floats, base: float, full: float) -> Floats:
    """f = (H − H₀)/(Hmax − H₀), held in [0, 4]; H, H₀ and Hmax in m."""
    return np.clip((H - base) / (full - base), 0.0, front.CAP)


def slope_saturation(slopes: Slopes, x: Floats, z: Floats, gain: float, base: float, blur: float) -> Floats:
    """f = gain (1 − n.y − base), held in [0, 4]; with a blur (m) 1 − n.y is a mean of five places, a cross."""
    offsets = ((0.0, 0.0), (blur, 0.0), (-blur, 0.0), (0.0, blur), (0.0, -blur)) if blur > 0.0 else ((0.0, 0.0),)
    lack = np.zeros_like(x)
    for dx, dz in offsets:
        h_x, h_z = slopes(x + dx, z + dz)
        lack += (1.0 - 1.0 / np.sqrt(1.0 + h_x * h_x + h_z * h_z)) / len(offsets)
    return np.clip(gain * (lack - base), 0.0, front.CAP)


def joined(parts: list[Floats], combine: Literal["max", "product"], cap: float) -> Floats:
    """The greatest or the product of saturations, each and the result capped; one array or more."""
    joint: Callable[..., Floats] = np.max if combine == "max" else np.prod
    return np.minimum(joint(np.minimum(parts, cap), axis=0), cap)


def _front(state: ReferenceState, source: scenes.FrontSaturation, points: SurfacePoints) -> Floats:
    """f of fronts at points, with footprints averaged over what the camera sees of them; (r,)."""
    constants, eye_y = front.FRONT_CONSTANTS[source.constants], state.eye_y
    waves = wave_set(state.scene, state.time, state.surface.afloat, constants.spatial)
    if waves.amplitude.size == 0:
        return np.zeros_like(points.x)
    if source.decay is not None:
        return front.decaying_front(source, waves, points, eye_y, foam_drift(state.scene), state.surface.orbits)
    sum_of = front.group(waves, points.x, points.z, constants.delta)
    if points.footprints is None:
        f = np.minimum(front.front_saturation(sum_of.X, sum_of.Y, source.intensity, constants.base), points.cap)
    else:
        psi, crest = np.arctan2(sum_of.Y, sum_of.X), 2.0 * constants.delta - 0.5 * math.pi
        psi, width = front.phases_under(psi, front.phase_gradient(sum_of), points, eye_y, waves.relief, crest)
        f = front.front_saturation_filtered(psi, width, source.intensity, constants.base)
    return f * front.gate(sum_of.rho, source.group)


def _of(state: ReferenceState, source: scenes.FoamSource, at: SurfacePoints) -> Floats:
    """f of one source at points; (r,)."""
    surface, none = state.surface, np.zeros_like(at.x)
    match source:
        case scenes.FrontSaturation():
            return _front(state, source, at)
        case scenes.HeightSaturation():
            return height_saturation(at.height + surface.waves.level, source.base, source.full)
        case scenes.SlopeSaturation(gain=gain, base=base, blur=blur):
            return slope_saturation(lambda x, z: surface.slopes(x, z)[1], at.x, at.z, gain, base, blur)
        case scenes.WhitecapSaturation():
            return whitecap_saturation(state.scene, source, surface.sea, at.x, at.z)
        case scenes.DriftSaturation():
            return drift_saturation(state.scene, source, at.time, at.origin, at.x, at.z)
        case scenes.SurfSaturation():
            coast = surface.coast
            return none if coast is None else coast.foam(source, at.x, at.z, at.height, at.footprints)
        case scenes.BreakerSaturation():
            return state.crests[0].left(source, at.x, at.z, at.footprints, even=False) if state.crests else none
    assert isinstance(source, scenes.WakeSaturation)
    wakes = surface.wakes
    return none if wakes is None else wakes.foam(source, at.x, at.z, at.cap, at.footprints)


def saturation(state: ReferenceState, foam: scenes.Foam, samples: WaterSamples) -> Floats:
    """f where samples meet the water; (r,) in [0, 1] or, for other looks than the filtered one, [0, 4].

    Parts of effects outside the package that have a saturation are sources like the foam's own.
    """
    filtered = foam.look == "filtered"
    footprints = samples.footprints if filtered and state.filtering else None
    cap = 1.0 if filtered else front.CAP
    points = SurfacePoints(samples.x, samples.z, samples.height, footprints, cap, state.time, state.origin)
    parts = [_of(state, source, points) for source in foam.saturation]
    outside = (part for _, part in state.scene.extensions if type(part) in TRUTHS)
    parts += [TRUTHS[type(part)](part, state.scene, points) for part in outside]
    return joined(parts, foam.combine, cap)
