"""What all samples of a frame share: the surface, its light, and the view."""

import math
from typing import Literal

import numpy as np

from seafoam.ocean.coast.rocks import splash_height
from seafoam.ocean.waves.plunging import overturning
from seafoam.ocean.waves.stokes import follows_orbits
from seafoam.ocean.waves.wakes import stone_wakes
from seafoam.reference.boats.boat import Fleet
from seafoam.reference.boats.wake import StoneSet, WakeSet, wake_set
from seafoam.reference.foam.coverage import Assets
from seafoam.reference.light import light, sparkles
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.shore.shore import Coast, land_shadow
from seafoam.reference.types import Floats, Footprints, Relief, ReliefPart, Sunlight, Vec2, WaterSamples, dot, unit
from seafoam.reference.water.seafloor import Seabed
from seafoam.reference.waves.boulders import Boulders
from seafoam.reference.waves.breaker import PlungingCrest
from seafoam.reference.waves.parametric import afloat, gust_field, ripple_set, wave_set
from seafoam.reference.waves.rings import ring_set, touch_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.scene import Light, Scene

Mode = Literal["same-samples", "converged"]


class Surface:
    """The water of a scene at a time (s) around an origin (x, z) in m, all that raises and tilts it, and the land."""

    def __init__(self, scene: Scene, time: float, origin: Vec2) -> None:
        self.afloat = afloat(scene, time, origin)  # the origin in the frame of the flowing water, m
        self.waves, self.sea = wave_set(scene, time, self.afloat), sea_surface(scene, time, self.afloat)
        boats = wake_set(scene, time, origin) if scene.boats else None
        current = scene.current
        stones = None if current is None else StoneSet(stone_wakes(current), current, origin)
        # The wakes that leave foam.
        self.wakes: WakeSet | StoneSet | None = stones if stones is not None and stones.wakes else boats
        parts = (self.waves, ring_set(scene, time, origin), boats, stones, self.sea)
        open_sea = Relief(part for part in parts if part is not None)
        self.coast: Coast | None = None
        if scene.shore is not None:
            splash = splash_height(scene.shore, scene.spray)
            self.coast = Coast(scene.shore, time, origin, open_sea, splash=splash)
        # The sum of all that raises the water.
        self.relief: ReliefPart = open_sea if self.coast is None else self.coast
        repeats, ripples = scene.light is not None and scene.light.caustics is not None, scene.water.ripples
        self.ripples = ripple_set(ripples, time, self.afloat, repeats, gust_field(ripples, time, origin))
        self.touches = touch_set(scene, time, origin)
        self.orbits = follows_orbits(scene)

    def slopes(self, x: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
        """Slopes at (x, z): of the surface for rays, of that for shading, and of waves without height; (2, r) each."""
        met = self.relief.gradient(x, z)
        fine = self.ripples.gradient(x, z) + self.touches.gradient(x, z)
        if self.sea is None:
            return met, met, fine
        # Rays intersect the bilinear sea; shading uses its spline.
        bent = self.sea.shading(x, z) - self.sea.gradient(x, z)
        return met, met + bent, fine + self.sea.detail(x, z)

    def to_rest(self, x: Floats, z: Floats) -> Floats:
        """Displacement from (x, z) to the rest position of the foam there, m; (2, r)."""
        if not self.orbits:
            return np.zeros((2, x.size))
        by = self.waves.to_rest(x, z)
        if self.sea is not None:
            by = by + self.sea.to_rest(x, z)
        return by if self.coast is None else self.coast.to_rest(by, x, z)


class Lighting:
    """A light on a coast, a fleet and stones at one time around one origin. ``filtering``: sparkles are at least as
    large as samples are apart."""

    def __init__(
        self,
        settings: Light,
        time: float,
        grid: SampleGrid,
        filtering: bool,
        coast: Coast | None,
        solid: tuple[Fleet | None, Boulders | None],
    ) -> None:
        fleet, stones = solid
        self.settings, self.exposure = settings, float(2.0**settings.exposure)  # the factor on radiance
        self.air = air = light.air(settings, time, (grid.origin[0], grid.eye_y, grid.origin[1]))
        step = max(math.sqrt(float(side @ side)) for side in grid.steps) if filtering else 0.0
        self.glint = sparkles.sun(settings, air, time, step)
        parts: list[Sunlight] = []
        if coast is not None and coast.shore.shadows:
            parts.append(land_shadow(coast, air.sun))
        layer = None if air.above is None else air.above.clouds
        if layer is not None and layer.clouds.shadows > 0.0 and layer.taken > 0.0:
            parts.append(layer.sunlight)
        if stones is not None:
            parts.append(lambda place, _: stones.sunlight(place, air.sun))
        boats: list[Sunlight] = [] if fleet is None else [lambda place, _: fleet.sunlight(place, air.sun)]
        # What land, clouds and stones leave of the sun, and what boats leave too.
        self.open_sun, self.sunlight = _product(parts), _product([*parts, *boats])

    def haze(self, L: Floats, d: Floats, distance: Floats) -> Floats:
        """L (r, 3) seen through (r,) m of air along d (r, 3); (r, 3)."""
        return light.haze(self.air, self.settings.visibility, L, d, distance)


def _product(parts: list[Sunlight]) -> Sunlight:
    return lambda place, at: np.prod([np.ones(len(place)), *(part(place, at) for part in parts)], axis=0)


class ReferenceState:
    """Surface, light, sources of foam and view of a frame at one time, shared by its samples."""

    def __init__(self, scene: Scene, time: float, grid: SampleGrid, mode: Mode, assets: Assets | None) -> None:
        self.scene = scene
        self.time = time
        self.grid = grid
        self.filtering = mode == "same-samples"
        self.assets = assets
        self.origin, self.eye_y = grid.origin, grid.eye_y
        self.surface = Surface(scene, time, self.origin)
        coast, relief = self.surface.coast, self.surface.relief
        self.fleet = None
        if scene.boats:
            ground = None if coast is None else lambda x, z: coast.ground(*coast.place(x, z))[0]
            self.fleet = Fleet(scene, time, self.origin, relief.height, ground)
        self.covered = self.eye_y < float(relief.height(np.zeros(1), np.zeros(1))[0])
        self.under = scene.water.view_below and self.covered
        self.boulders = None if scene.current is None else Boulders(scene.current, scene.shore, grid, self.under)
        crest, self.crests = scene.breaker, list[PlungingCrest]()
        if crest is not None and crest.height > 0.0:
            self.crests = [PlungingCrest(crest, time, self.origin, i) for i in range(overturning(crest).crests)]
        self.lighting = None
        if scene.light is not None:
            solid = self.fleet, self.boulders
            self.lighting = Lighting(scene.light, time, grid, self.filtering, coast, solid)
        self.exposure = 1.0 if self.lighting is None else self.lighting.exposure
        self.seabed = None if self.lighting is None else self._seabed(self.lighting)

    def _seabed(self, lighting: Lighting) -> Seabed | None:
        """The floor that rays meet: from under water any, from above one that is level and not uniform."""
        coast, water = self.surface.coast, self.scene.water
        uniform = lighting.settings.caustics is None and water.floor_tile is None
        if not self.under and (coast is not None or water.depth is None or uniform):
            return None
        return Seabed(self.scene, lighting.air, self.time, self.origin, lighting.sunlight, coast)

    def footprints(self, t: Floats, D: Floats, N: Floats) -> Footprints:
        """Footprints (r, 2) m of samples along both sides, where rays tD meet a surface of normal N."""
        along, down = (intersect.footprint(t, D, N, step) for step in self.grid.steps)
        return along, down

    def water_samples(self, D: Floats, d: Floats, distance: Floats, side: float = 1.0) -> WaterSamples:
        """Where rays D (r, 3) of directions d meet the surface, ``distance`` (r,) m away; ``side`` −1: from below."""
        x, z = d[:, 0] * distance, d[:, 2] * distance
        met, seen, fine = self.surface.slopes(x, z)
        footprints = self.footprints(distance / np.sqrt(dot(D, D)), D, side * intersect.normal(*met))
        normal, damped = (unit(intersect.normal(*(seen + part * fine))) for part in (1.0, 0.5))
        return WaterSamples(d, distance, x, z, self.surface.relief.height(x, z), footprints, normal, damped)
