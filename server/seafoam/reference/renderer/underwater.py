"""The view from under the surface."""

import numpy as np

from seafoam.reference.light import light
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.reflect import ReflectionStage
from seafoam.reference.types import Bools, Floats, dot
from seafoam.reference.water.seafloor import FOAM_THROUGH, Seabed

BRIGHTEST = 65504.0
"""The greatest half float, at which frames are clamped."""


class UnderwaterStage(ReflectionStage):
    """The surface from below, the floor, and the submerged parts of boats."""

    def _below(self, D: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
        """Colour (r, 3) and foam amount (r,) along rays D of a camera under the surface; every ray ends in water."""
        distance = intersect.first_crossing(self.surface.relief, self.eye_y, d)
        colour, amount = np.zeros_like(d), np.zeros(d.shape[0])
        if self.seabed is None or self.lighting is None:
            # Without light: white foam, black water.
            up = np.isfinite(distance)
            if up.any() and self.scene.foam is not None and self.assets is not None:
                a, _ = self._foam(self.water_samples(D[up], d[up], distance[up], side=-1.0))
                amount[up] = np.minimum(a, 1.0)
            return np.repeat(amount[:, None], 3, axis=1), amount, np.ones(d.shape[0], np.bool_)
        bed, here = self.seabed, np.zeros(d.shape[0])
        to_floor = bed.reach(here, here, here + self.eye_y, d)
        floor = ~np.isfinite(distance) | (to_floor < distance)
        if floor.any():
            t = to_floor[floor] / np.sqrt(dot(D[floor], D[floor]))
            footprints = self.footprints(t, D[floor], np.tile((0.0, 1.0, 0.0), (t.size, 1)))
            here = np.zeros(t.size)
            colour[floor] = bed.below(here, here, here + self.eye_y, d[floor], to_floor[floor], footprints)
        up = ~floor
        if up.any():
            colour[up], amount[up] = self._underside(bed, D[up], d[up], distance[up])
        seen, radiance, far = self._hulls(np.array([0.0, self.eye_y, 0.0]), d, np.where(up, distance, to_floor))
        colour[seen] = self._through_water(bed, radiance, d[seen], far)
        return np.minimum(colour * self.exposure, BRIGHTEST), amount, np.ones(d.shape[0], np.bool_)

    def _underside(self, bed: Seabed, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Colour (r, 3), not exposed, and foam amount (r,) of the surface that rays D meet from below."""
        foam, samples = self.scene.foam, self.water_samples(D, d, distance, side=-1.0)
        place = samples.x, samples.z, samples.height
        radiance, amount = bed.underside(*place, d, samples.normal, distance, samples.footprints), np.zeros(len(d))
        if foam is not None and self.assets is not None:
            a, _ = self._foam(samples)
            white = FOAM_THROUGH * light.foam(bed.air, foam.albedo, samples.foam_normal)
            radiance = self._blend(radiance, white, a)
            amount = np.minimum(a, 1.0)
        return self._through_water(bed, radiance, d, distance), amount

    def _through_water(self, bed: Seabed, radiance: Floats, d: Floats, distance: Floats) -> Floats:
        """Radiance (r, 3) that reaches the camera along rays d (r, 3) through (r,) m of water."""
        glow = bed.glow(np.full(distance.shape, -self.eye_y), -d[:, 1], distance)
        return radiance * np.exp(-bed.extinction * distance[:, None]) + glow

    def _blend(self, colour: Floats, white: Floats, a: Floats) -> Floats:
        """Foam (r, 3) blended over water (r, 3) by its amount (r,)."""
        if self.scene.foam is not None and self.scene.foam.look == "listing":
            return np.clip(self.exposure * (colour + white * a[:, None]), 0.0, 1.0) / self.exposure
        return colour * (1.0 - a[:, None]) + white * a[:, None]
