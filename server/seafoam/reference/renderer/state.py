"""The part of a frame's state that all samples share."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np

from seafoam.ocean.stokes import foam_life
from seafoam.reference.boats import boat as fleets
from seafoam.reference.boats.stones import stone_set
from seafoam.reference.boats.wake import wake_set
from seafoam.reference.foam.front import FRONT_CONSTANTS
from seafoam.reference.light import light, sparkles
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.assets import Assets
from seafoam.reference.renderer.relief import Relief, ReliefPart
from seafoam.reference.renderer.sunlight import open_sun, sunlight
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats
from seafoam.reference.water.seafloor import bed_of, under_of
from seafoam.reference.waves.current import afloat
from seafoam.reference.waves.gusts import GustField
from seafoam.reference.waves.parametric import RippleSet, WaveSet, ripple_set, wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.reference.waves.touch import touch_set
from seafoam.scene.foam import FrontSaturation
from seafoam.scene.models import Scene

Mode = Literal["same-samples", "converged"]


class ReferenceState:
    """Surface, light, sources of foam and view of a frame at one time, shared by its samples."""

    def __init__(
        self,
        scene: Scene,
        time: float,
        view: cameras.View,
        width: int,
        height: int,
        samples: int,
        mode: Mode,
        assets: Assets | None,
    ) -> None:
        self.scene = scene
        self.time = time
        self.view = view
        self.filtering = mode == "same-samples"
        self.assets = assets
        self.delta_x = 2.0 * view.ray_x / (samples * width)
        self.delta_y = 2.0 * view.ray_y / (samples * height)
        self.eye_y = float(view.eye[1])
        self.origin = (float(view.eye[0]), float(view.eye[2]))
        eye = (self.origin[0], self.eye_y, self.origin[1])
        self.afloat = afloat(scene, time, self.origin)
        self.air = None if scene.light is None else light.air(scene.light, time, eye)
        self.sun: light.Glint | None = None
        if scene.light is not None and self.air is not None:
            step = max(math.sqrt(float(side @ side)) for side in (self.delta_x, self.delta_y))
            self.sun = sparkles.sun(scene.light, self.air, time, step if self.filtering else 0.0)
        self.waves = wave_set(scene, time, self.afloat)
        self.sea = sea_surface(scene, time, self.afloat)
        self.wakes = wake_set(scene, time, self.origin) if scene.boats else None
        parts: tuple[ReliefPart, ...] = (self.waves, ring_set(scene, time, self.origin))
        if self.wakes is not None:
            parts = (*parts, self.wakes)
        self.stones = None if scene.current is None else stone_set(scene.current, self.origin)
        if self.stones is not None:
            parts = (*parts, self.stones)
        open_sea = Relief(parts if self.sea is None else (*parts, self.sea))
        self.coast = None if scene.shore is None else Coast(scene.shore, time, self.origin, open_sea)
        self.relief: ReliefPart = open_sea if self.coast is None else self.coast
        coast = self.coast
        ground = None if coast is None else lambda x, z: coast.ground(*coast.place(x, z))[0]
        self.fleet = fleets.fleet(scene, time, self.origin, self.relief.height, ground) if scene.boats else None
        self.open_sun = open_sun(scene, self.air, self.coast)
        if self.fleet is not None:
            self.fleet = replace(self.fleet, open_sun=self.open_sun)
        self.sunlight = sunlight(self.air, self.fleet, self.open_sun)
        self.gusts = GustField(scene.water.ripples, time, self.origin)
        repeats = scene.light is not None and scene.light.caustics is not None
        self.ripples: RippleSet = ripple_set(scene.water.ripples, time, self.afloat, repeats)
        self.touches = touch_set(scene, time, self.origin)
        self.bed = bed_of(scene, self.air, time, self.origin)
        at_eye = float(self.relief.height(np.zeros(1), np.zeros(1))[0])
        self.covered = self.eye_y < at_eye
        self.under = scene.water.view_below and self.covered
        self.below = under_of(scene, self.air, time, self.origin, self.coast) if self.under else None
        for floor in (self.bed, self.below):
            if floor is not None:
                floor.sun_reaches = self.sunlight
        self.fronts = _front_waves(scene, time, self.afloat)

    @property
    def exposure(self) -> float:
        return 1.0 if self.scene.light is None else 2.0**self.scene.light.exposure

    def slopes(self, x: Floats, z: Floats) -> tuple[tuple[Floats, Floats], ...]:
        """Slopes at (x, z): of the surface for rays, of that for shading, and of waves without height; (r,) each."""
        met_x, met_z = self.relief.gradient(x, z)
        c_x, c_z = self.ripples.gradient(x, z)
        if self.gusts.gusts is not None:
            gust = self.gusts(x, z)
            c_x, c_z = gust * c_x, gust * c_z
        t_x, t_z = self.touches.gradient(x, z)
        c_x, c_z = c_x + t_x, c_z + t_z
        if self.sea is None:
            return (met_x, met_z), (met_x, met_z), (c_x, c_z)
        # Rays intersect the bilinear sea; shading uses its spline.
        (seen_x, seen_z), (own_x, own_z), (s_x, s_z) = (
            self.sea.shading(x, z),
            self.sea.gradient(x, z),
            self.sea.detail(x, z),
        )
        return (met_x, met_z), (met_x + (seen_x - own_x), met_z + (seen_z - own_z)), (c_x + s_x, c_z + s_z)

    @property
    def carries(self) -> bool:
        life = foam_life(self.scene)
        return life is not None and life.carried

    def carry(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """Displacement from (x, z) to where the water there rests, m; (r,) each."""
        way_x, way_z = np.zeros_like(x), np.zeros_like(x)
        if not self.carries:
            return way_x, way_z
        for part in (self.waves, self.sea):
            if part is not None:
                more_x, more_z = part.carry(x, z)
                way_x, way_z = way_x + more_x, way_z + more_z
        return (way_x, way_z) if self.coast is None else self.coast.carry((way_x, way_z), x, z)

    def footprints(self, t: Floats, D: Floats, N: Floats) -> tuple[Floats, Floats]:
        """Footprints (r, 2) m of samples along both sides, where rays tD meet a surface of normal N."""
        return intersect.footprint(t, D, N, self.delta_x), intersect.footprint(t, D, N, self.delta_y)


def _front_waves(scene: Scene, time: float, afloat: tuple[float, float]) -> dict[str, WaveSet]:
    """The waves whose groups make fronts, by the name of their constants; none: the scene has no fronts."""
    front = None if scene.foam is None else scene.foam.source(FrontSaturation)
    if front is None:
        return {}
    return {front.constants: wave_set(scene, time, afloat, FRONT_CONSTANTS[front.constants].spatial)}
