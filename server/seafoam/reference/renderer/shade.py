"""Colours of samples: sky, water, land and boats."""

from __future__ import annotations

import math

import numpy as np

from seafoam.reference.boats import boat as fleets
from seafoam.reference.foam import scattering
from seafoam.reference.foam.front import CAP
from seafoam.reference.light import light
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.underwater import BRIGHTEST, UnderwaterStage
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Bools, Floats, dot, unit
from seafoam.scene.foam import SurfSaturation


class SampleShader(UnderwaterStage):
    """Colour, foam amount and hit of samples at clip positions."""

    def shade(self, X: Floats, Y: Floats) -> tuple[Floats, Floats, Bools]:
        """Colour (r, 3), foam amount (r,) and hit (r,) of samples at clip positions (r,)."""
        D = cameras.rays(self.view, X, Y)
        d = unit(D)
        if self.under:
            return self._below_flat(D, d) if self.below is None else self._below(self.below, D, d)
        distance = intersect.first_crossing(self.relief, self.eye_y, d)
        met = np.isfinite(distance)
        colour = np.zeros_like(D)
        amount = np.zeros_like(X)
        dry = np.zeros_like(met)
        if self.coast is not None:
            to_land = intersect.land_crossing(self.coast.land, self.eye_y, d, *self.coast.within(d))
            dry = to_land < distance
            if dry.any():
                colour[dry], amount[dry] = self._land(self.coast, D[dry], d[dry], to_land[dry])
            met &= ~dry
        sky = ~met & ~dry
        if sky.any() and self.air is not None:
            if self.air.above is None:
                beyond = self.air.sky(d[sky]) + light.sun_disc(self.air, d[sky])
            else:
                beyond = self.air.above.whole(
                    d[sky], math.sqrt(dot(self.delta_y, self.delta_y)) / np.sqrt(dot(D[sky], D[sky]))
                )
            colour[sky] = beyond * self.exposure
        if met.any():
            colour[met], amount[met] = self._surface(D[met], d[met], distance[met])
        if self.fleet is not None:
            nearer = np.minimum(distance, to_land) if self.coast is not None else distance
            self._boats(self.fleet, d, nearer, colour)
        return np.minimum(colour, BRIGHTEST), amount, met | dry

    def _surface(self, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Colour (r, 3) and foam amount (r,) where rays D meet the surface, ``distance`` metres away."""
        scene, air = self.scene, self.air
        x, z = d[:, 0] * distance, d[:, 2] * distance
        H = self.relief.height(x, z)
        met, (h_x, h_z), (c_x, c_z) = self.slopes(x, z)
        N = intersect.normal(*met)
        a, f, past = np.zeros_like(x), None, None
        if scene.foam is not None and self.assets is not None:
            t = distance / np.sqrt(dot(D, D))
            a, f = self._foam(x, z, H, t, D, N)
            if scene.foam.thickness > 0.0 and air is not None:
                past = self._past_foam(air, a, f, x, z, t, D, N)
        if air is None or scene.light is None:
            colour = np.repeat(np.minimum(a, 1.0)[:, None], 3, axis=1)
        else:
            n = unit(intersect.normal(h_x + c_x, h_z + c_z))
            bed = None
            if self.coast is not None:
                t = distance / np.sqrt(dot(D, D))
                feet = self.footprints(t, D, N)
                bed = self.coast.bed(x, z, H, d, n, *feet)
            lit = None
            if self.bed is not None and scene.water.depth is not None:
                t = distance / np.sqrt(dot(D, D))
                feet = self.footprints(t, D, N)
                lit = self.bed.seen(x, z, H, d, n, feet)
            place = np.stack((x, H, z), axis=-1)
            open_sun = None
            if self.sunlight is not None:
                t = distance / np.sqrt(dot(D, D))
                open_sun = self.sunlight(place, self.footprints(t, D, N))
                past = (open_sun, open_sun) if past is None else (past[0] * open_sun, past[1] * open_sun)
            colour = light.water(
                air,
                scene.water,
                (self.relief.trough, self.relief.top),
                d,
                n,
                H,
                bed,
                mirrored=lambda r, spread: self._mirror(place, r, spread),
                sun=self.sun,
                lit=lit,
                saturation=f,
                past=None if past is None else past[0],
                open_sun=open_sun,
            )
            if scene.foam is not None:
                stiff = unit(intersect.normal(h_x + 0.5 * c_x, h_z + 0.5 * c_z))
                shaded = None if past is None else past[1]
                if scene.foam.scattering is not None and f is not None:
                    glow, opaque = scattering.layer(air, scene.foam.scattering, scene.foam.albedo, stiff, d, f, shaded)
                    white = glow + (1.0 - opaque)[:, None] * colour
                else:
                    white = light.foam(air, scene.foam.albedo, stiff, shaded)
                colour = self._laid(colour, white, a)
            colour = light.haze(air, scene.light.visibility, colour, d, distance) * self.exposure
        return colour, np.minimum(a, 1.0)

    def _land(self, coast: Coast, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Colour (r, 3) and foam amount (r,) where rays D meet land, ``distance`` metres away."""
        scene = self.scene
        x, z = d[:, 0] * distance, d[:, 2] * distance
        q_x, q_z = coast.place(x, z)
        height, g_x, g_z, _ = coast.ground(q_x, q_z)
        N = intersect.normal(g_x, g_z)
        t = distance / np.sqrt(dot(D, D))
        feet = self.footprints(t, D, N)
        amount = np.zeros_like(x)
        surf = None if scene.foam is None else scene.foam.source(SurfSaturation)
        if scene.foam is not None and self.assets is not None and surf is not None and surf.line > 0.0:
            filtered = scene.foam.look == "filtered"
            left = coast.left(surf, x, z, height, feet if filtered and self.filtering else None)
            f = np.minimum(left, 1.0 if filtered else CAP)
            still = np.zeros_like(x), np.zeros_like(x)
            amount = np.minimum(self._lying(f, x, z, *feet, way=still), 1.0)
        if self.air is None or scene.light is None:
            return np.repeat(amount[:, None], 3, axis=1), amount
        reaches = None
        if self.sunlight is not None:
            reaches = self.sunlight(np.stack((x, height, z), axis=-1), feet)
        colour = light.land(self.air, coast.soil(q_x, q_z, feet, still=False), d, unit(N), reaches)
        if scene.foam is not None:
            white = light.foam(self.air, scene.foam.albedo, unit(N), reaches)
            colour = colour + (white - colour) * amount[:, None]
        return light.haze(self.air, scene.light.visibility, colour, d, distance) * self.exposure, amount

    def _boats(self, fleet: fleets.Fleet, d: Floats, nearer: Floats, colour: Floats) -> None:
        """Draw boats over ``colour`` (r, 3) where rays d meet them before what is ``nearer`` metres away."""
        eye = np.array([0.0, self.eye_y, 0.0])
        hit = fleet.trace(eye, d)
        seen = np.flatnonzero(hit.t < nearer)
        if seen.size == 0:
            return
        if self.air is None or self.scene.light is None:
            colour[seen] = 0.0
            return
        own = fleets.Hit(hit.t[seen], hit.normal[seen], hit.place[seen], hit.part[seen], hit.boat[seen])
        light_of = fleet.light(self.air, eye, d[seen], own)
        hazed = light.haze(self.air, self.scene.light.visibility, light_of, d[seen], own.t)
        colour[seen] = hazed * self.exposure
