"""Reflections in the water: sky, land and boats."""

import numpy as np

from seafoam.reference.light import light
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.foam import FoamStage
from seafoam.reference.renderer.state import Lighting
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats, unit
from seafoam.reference.water.seafloor import FARTHEST

AROUND_HEIGHT = 1.0  # height from which the surroundings are seen, m
AROUND_BLUR = 0.012  # their blur by ripples, rad


class ReflectionStage(FoamStage):
    """Radiance along reflected rays."""

    def _mirror(self, lighting: Lighting, place: Floats, r: Floats, spread: tuple[Floats, Floats]) -> Floats:
        """Radiance that arrives from directions r (r, 3) at places (r, 3) on the water: sky, and what occludes it.

        ``spread``: standard deviations (r,) of the directions about r from which the sky's light comes, rad.
        """
        coast, reflection = self.surface.coast, lighting.settings.reflection
        if reflection == "cubemap" and coast is not None:
            return self._around(lighting, coast, r, spread)
        seen = lighting.air.mirrored(r, spread)
        if reflection != "planar":
            return seen
        to_land = np.full(r.shape[0], np.inf)
        if coast is not None:
            ashore = self._mirrored_land(lighting, coast, place, r, to_land)
            seen[np.isfinite(to_land)] = ashore
        met, radiance, far = self._hulls(place, r, to_land)
        seen[met] = lighting.haze(radiance, r[met], far)
        return seen

    def _mirrored_land(self, lighting: Lighting, coast: Coast, place: Floats, r: Floats, far: Floats) -> Floats:
        """Radiance (n, 3) of the land that rays r (r, 3) from places (r, 3) meet; writes its distance to ``far`` (r,),
        m."""
        low, high = coast.within(r, place[:, 0], place[:, 2])
        inside = np.flatnonzero(low < high)
        start = place[inside] + low[inside, None] * r[inside]
        distance = low[inside] + coast.crossing(start[:, 0], start[:, 1], start[:, 2], r[inside], FARTHEST)
        end = place[inside] + distance[:, None] * r[inside]
        ground = coast.ground(*coast.place(end[:, 0], end[:, 2]))[0]
        met = (distance < high[inside]) & (ground > 0.0)
        far[inside[met]] = distance[met]
        return self._land_light(lighting, coast, end[met], r[inside[met]], distance[met])

    def _land_light(self, lighting: Lighting, coast: Coast, place: Floats, d: Floats, far: Floats) -> Floats:
        """Radiance (n, 3) of land at places (n, 3) toward −d, seen through ``far`` metres of air."""
        q_x, q_z = coast.place(place[:, 0], place[:, 2])
        height, g_x, g_z, _ = coast.ground(q_x, q_z)
        wide = np.column_stack((AROUND_BLUR * far, np.zeros(far.size)))
        footprints = wide, wide[:, ::-1]
        soil = coast.soil(q_x, q_z, footprints, still=True)
        sun = lighting.sunlight(np.stack((place[:, 0], height, place[:, 2]), axis=-1), footprints)
        seen = light.land(lighting.air, soil, d, unit(intersect.normal(g_x, g_z)), sun)
        return lighting.haze(seen, d, far)

    def _around(self, lighting: Lighting, coast: Coast, r: Floats, spread: tuple[Floats, Floats]) -> Floats:
        """Sky and land toward r (n, 3), from 1 m above water or ground, vertically below the camera; (n, 3)."""
        here = coast.place(np.zeros(1), np.zeros(1))
        height = AROUND_HEIGHT + max(0.0, float(coast.ground(*here)[0][0]))
        distance = intersect.land_crossing(coast.land, height, r, *coast.within(r))
        met = np.isfinite(distance)
        colour = np.empty_like(r)
        colour[~met] = lighting.air.mirrored(r[~met], (spread[0][~met], spread[1][~met]))
        if met.any():
            d, far = r[met], distance[met]
            colour[met] = self._land_light(lighting, coast, far[:, None] * d, d, far)
        return colour
