"""Sources of foam saturation: the function of each kind, evaluated at surface points. docs/formulae.md, section 4."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic import BaseModel

from seafoam.extensions import TRUTHS
from seafoam.ocean.stokes import foam_drift
from seafoam.reference.foam.drift import drift_saturation
from seafoam.reference.foam.front import CAP, History
from seafoam.reference.foam.patches import FrontPatches
from seafoam.reference.foam.saturation import front_source, height_saturation, joined, slope_saturation
from seafoam.reference.renderer.state import ReferenceState
from seafoam.reference.types import Floats
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


@dataclass(frozen=True)
class SurfacePoints:
    """Points of the surface at which sources of foam are evaluated."""

    x: Floats
    """(r,) m from ``origin``."""
    z: Floats
    height: Floats
    """(r,) m over still water."""
    footprints: tuple[Floats, Floats] | None
    """Both sides of each sample's footprint, (r, 2) m; None: no average over footprints."""
    cap: float
    """Upper limit of the saturation."""
    time: float
    """s."""
    origin: tuple[float, float]
    """World coordinates (x, z) of the point below the camera, m."""


def _front(of: ReferenceState, source: FrontSaturation, at: SurfacePoints) -> Floats:
    drift = foam_drift(of.scene)
    patches = FrontPatches(source, at.time, at.origin, drift) if source.variation > 0.0 else None
    history = History(drift, of.carries, patches)
    over = of.eye_y - at.height
    return front_source(source, of.fronts[source.constants], at.x, at.z, at.footprints, over, at.cap, history)


def _height(of: ReferenceState, source: HeightSaturation, at: SurfacePoints) -> Floats:
    return height_saturation(at.height + of.waves.level, source.base, source.full)


def _slope(of: ReferenceState, source: SlopeSaturation, at: SurfacePoints) -> Floats:
    return slope_saturation(lambda x, z: of.slopes(x, z)[1], at.x, at.z, source.gain, source.base, source.blur)


def _fold(of: ReferenceState, source: WhitecapSaturation, at: SurfacePoints) -> Floats:
    return whitecap_saturation(of.scene, source, of.sea, at.x, at.z)


def _surf(of: ReferenceState, source: SurfSaturation, at: SurfacePoints) -> Floats:
    return np.zeros_like(at.x) if of.coast is None else of.coast.foam(source, at.x, at.z, at.height, at.footprints)


def _drift(of: ReferenceState, source: DriftSaturation, at: SurfacePoints) -> Floats:
    return drift_saturation(of.scene, source, at.time, at.origin, at.x, at.z)


def _wake(of: ReferenceState, source: WakeSaturation, at: SurfacePoints) -> Floats:
    if of.stones is not None and of.stones.wakes:
        return of.stones.foam(source, at.x, at.z, at.cap, at.footprints)
    return np.zeros_like(at.x) if of.wakes is None else of.wakes.foam(source, at.x, at.z, at.cap, at.footprints)


_SOURCES: dict[type[BaseModel], Callable[[ReferenceState, Any, SurfacePoints], Floats]] = {
    FrontSaturation: _front,
    HeightSaturation: _height,
    SlopeSaturation: _slope,
    WhitecapSaturation: _fold,
    SurfSaturation: _surf,
    DriftSaturation: _drift,
    WakeSaturation: _wake,
}


def saturation(of: ReferenceState, foam: Foam, x: Floats, z: Floats, H: Floats, feet: tuple[Floats, Floats]) -> Floats:
    """f at (x, z), m from the origin, where the surface is at height H; (r,) in [0, 1] or, for other looks, [0, 4].

    ``feet``: both sides of the samples' footprints, (r, 2) m. Parts of effects outside the package that have a
    saturation are sources like the foam's own.
    """
    filtered = foam.look == "filtered"
    footprints = feet if filtered and of.filtering else None
    at = SurfacePoints(x, z, H, footprints, 1.0 if filtered else CAP, of.time, of.origin)
    parts = [_SOURCES[type(source)](of, source, at) for source in foam.saturation]
    parts += [TRUTHS[type(part)](part, of.scene, at) for _, part in of.scene.extensions if type(part) in TRUTHS]
    return joined(parts, foam.combine, at.cap)
