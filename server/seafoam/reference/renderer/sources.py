"""Sources of foam saturation: the function of each kind, evaluated at surface points. docs/formulae.md, section 4."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from pydantic import BaseModel

from seafoam.extensions import TRUTHS
from seafoam.ocean.waves.stokes import foam_drift
from seafoam.reference.foam.drift import drift_saturation
from seafoam.reference.foam.front import CAP, History
from seafoam.reference.foam.saturation import front_source, height_saturation, joined, slope_saturation
from seafoam.reference.renderer.state import ReferenceState, WaterSamples
from seafoam.reference.types import Floats
from seafoam.reference.types import SurfacePoints as SurfacePoints
from seafoam.reference.waves.sea import whitecap_saturation
from seafoam.scene.foam import (
    DriftSaturation,
    Foam,
    FrontSaturation,
    HeightSaturation,
    SlopeSaturation,
    SurfSaturation,
    WakeSaturation,
    WhitecapSaturation,
)


def _front(state: ReferenceState, source: FrontSaturation, points: SurfacePoints) -> Floats:
    history = History(foam_drift(state.scene), state.surface.orbits)
    return front_source(source, state.front_waves[source.constants], points, state.eye_y, history)


def _height(state: ReferenceState, source: HeightSaturation, points: SurfacePoints) -> Floats:
    return height_saturation(points.height + state.surface.waves.level, source.base, source.full)


def _slope(state: ReferenceState, source: SlopeSaturation, points: SurfacePoints) -> Floats:
    x, z = points.x, points.z
    return slope_saturation(lambda x, z: state.surface.slopes(x, z)[1], x, z, source.gain, source.base, source.blur)


def _fold(state: ReferenceState, source: WhitecapSaturation, points: SurfacePoints) -> Floats:
    return whitecap_saturation(state.scene, source, state.surface.sea, points.x, points.z)


def _surf(state: ReferenceState, source: SurfSaturation, points: SurfacePoints) -> Floats:
    coast = state.surface.coast
    if coast is None:
        return np.zeros_like(points.x)
    return coast.foam(source, points.x, points.z, points.height, points.footprints)


def _drift(state: ReferenceState, source: DriftSaturation, points: SurfacePoints) -> Floats:
    return drift_saturation(state.scene, source, points.time, points.origin, points.x, points.z)


def _wake(state: ReferenceState, source: WakeSaturation, points: SurfacePoints) -> Floats:
    wakes = state.surface.wakes
    if wakes is None:
        return np.zeros_like(points.x)
    return wakes.foam(source, points.x, points.z, points.cap, points.footprints)


_SOURCES: dict[type[BaseModel], Callable[[ReferenceState, Any, SurfacePoints], Floats]] = {
    FrontSaturation: _front,
    HeightSaturation: _height,
    SlopeSaturation: _slope,
    WhitecapSaturation: _fold,
    SurfSaturation: _surf,
    DriftSaturation: _drift,
    WakeSaturation: _wake,
}


def saturation(state: ReferenceState, foam: Foam, samples: WaterSamples) -> Floats:
    """f where samples meet the water; (r,) in [0, 1] or, for other looks than the filtered one, [0, 4].

    Parts of effects outside the package that have a saturation are sources like the foam's own.
    """
    filtered = foam.look == "filtered"
    footprints = samples.footprints if filtered and state.filtering else None
    cap = 1.0 if filtered else CAP
    points = SurfacePoints(samples.x, samples.z, samples.height, footprints, cap, state.time, state.origin)
    parts = [_SOURCES[type(source)](state, source, points) for source in foam.saturation]
    outside = (part for _, part in state.scene.extensions if type(part) in TRUTHS)
    parts += [TRUTHS[type(part)](part, state.scene, points) for part in outside]
    return joined(parts, foam.combine, cap)
