"""The view from under the surface."""

from __future__ import annotations

import numpy as np

from seafoam.reference.boats import boat as fleets
from seafoam.reference.light import light
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.reflect import ReflectionStage
from seafoam.reference.types import Bools, Floats, dot, unit
from seafoam.reference.water.seafloor import FOAM_THROUGH, Seabed

BRIGHTEST = 65504.0
"""The greatest half float, at which frames are clamped."""


class UnderwaterStage(ReflectionStage):
    """The surface from below, the floor, and the submerged parts of boats."""

    def _below(self, bed: Seabed, D: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
        """Colour (r, 3) and foam amount (r,) along rays D of a camera under the surface; every ray ends in water."""
        scene = self.scene
        distance = intersect.first_crossing(self.relief, self.eye_y, d)
        here = np.zeros(d.shape[0])
        to_floor = bed.reach(here, here, here + self.eye_y, d)
        amount = np.zeros(d.shape[0])
        colour = np.zeros_like(d)
        length = np.sqrt(dot(D, D))
        floor = ~np.isfinite(distance) | (to_floor < distance)
        if floor.any():
            t = to_floor[floor] / length[floor]
            N = np.tile((0.0, 1.0, 0.0), (t.size, 1))
            feet = (
                intersect.footprint(t, D[floor], N, self.delta_x),
                intersect.footprint(t, D[floor], N, self.delta_y),
            )
            here = np.zeros(t.size)
            colour[floor] = bed.below(here, here, here + self.eye_y, d[floor], to_floor[floor], feet)
        up = ~floor
        if up.any():
            s = distance[up]
            x, z = d[up, 0] * s, d[up, 2] * s
            H = self.relief.height(x, z)
            (met_x, met_z), (h_x, h_z), (c_x, c_z) = self.slopes(x, z)
            feet = (
                intersect.footprint(s / length[up], D[up], -intersect.normal(met_x, met_z), self.delta_x),
                intersect.footprint(s / length[up], D[up], -intersect.normal(met_x, met_z), self.delta_y),
            )
            n = unit(intersect.normal(h_x + c_x, h_z + c_z))
            light_up = bed.underside(x, z, H, d[up], n, s, feet)
            if scene.foam is not None and self.assets is not None and scene.light is not None:
                N = -intersect.normal(met_x, met_z)
                a, _ = self._foam(x, z, H, s / length[up], D[up], N)
                stiff = unit(intersect.normal(h_x + 0.5 * c_x, h_z + 0.5 * c_z))
                white = FOAM_THROUGH * light.foam(bed.air, scene.foam.albedo, stiff)
                light_up = self._laid(light_up, white, a)
                amount[up] = np.minimum(a, 1.0)
            glow = bed.glow(np.full(s.shape, -self.eye_y), -d[up, 1], s)
            colour[up] = light_up * np.exp(-bed.extinction * s[:, None]) + glow
        if self.fleet is not None:
            self._sunk(self.fleet, bed, d, np.where(up, distance, to_floor), colour)
        return np.minimum(colour * self.exposure, BRIGHTEST), amount, np.ones(d.shape[0], np.bool_)

    def _below_flat(self, D: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
        """The same without light: white foam on the surface, black water."""
        distance = intersect.first_crossing(self.relief, self.eye_y, d)
        amount = np.zeros(d.shape[0])
        up = np.isfinite(distance)
        if up.any() and self.scene.foam is not None and self.assets is not None:
            s = distance[up]
            x, z = d[up, 0] * s, d[up, 2] * s
            N = -intersect.normal(*self.relief.gradient(x, z))
            t = s / np.sqrt(dot(D[up], D[up]))
            H = self.relief.height(x, z)
            a, _ = self._foam(x, z, H, t, D[up], N)
            amount[up] = np.minimum(a, 1.0)
        return np.repeat(amount[:, None], 3, axis=1), amount, np.ones(d.shape[0], np.bool_)

    def _sunk(self, fleet: fleets.Fleet, bed: Seabed, d: Floats, nearer: Floats, colour: Floats) -> None:
        """Draw the submerged parts of boats over ``colour`` (r, 3), not exposed, seen through the water."""
        eye = np.array([0.0, self.eye_y, 0.0])
        hit = fleet.trace(eye, d)
        seen = np.flatnonzero(hit.t < nearer)
        if seen.size:
            own = fleets.Hit(hit.t[seen], hit.normal[seen], hit.place[seen], hit.part[seen], hit.boat[seen])
            seen_through = fleet.light(bed.air, eye, d[seen], own) * np.exp(-bed.extinction * own.t[:, None])
            colour[seen] = seen_through + bed.glow(np.full(own.t.shape, -self.eye_y), -d[seen, 1], own.t)

    def _laid(self, colour: Floats, white: Floats, a: Floats) -> Floats:
        """Foam (r, 3) blended over water (r, 3) by its amount (r,)."""
        if self.scene.foam is not None and self.scene.foam.look == "listing":
            return np.clip(self.exposure * (colour + white * a[:, None]), 0.0, 1.0) / self.exposure
        return colour * (1.0 - a[:, None]) + white * a[:, None]
