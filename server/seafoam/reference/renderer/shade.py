"""Colours of samples: sky, water, land, boats and their reflections, and the view from under the surface."""

import math

import numpy as np

from seafoam.reference.foam.front import CAP
from seafoam.reference.light import light
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.foam import FoamStage
from seafoam.reference.renderer.state import Lighting
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Bounds, Floats, Pair, WaterSamples, dot, unit
from seafoam.reference.water.seafloor import FARTHEST, FOAM_THROUGH, Seabed
from seafoam.reference.waves.breaker import CrestLook, PlungingCrest
from seafoam.scene import BreakerSaturation, SurfSaturation

AROUND_HEIGHT = 1.0  # height from which the surroundings are seen, m
AROUND_BLUR = 0.012  # their blur by ripples, rad
BRIGHTEST = 65504.0  # the greatest half float, at which frames are clamped


class SampleShader(FoamStage):
    """Colour and foam amount of samples at clip positions."""

    def shade(self, X: Floats, Y: Floats) -> Pair:
        """Colour (r, 3) and foam amount (r,) of samples at clip positions (r,)."""
        D = self.grid.rays(X, Y)
        d = unit(D)
        if self.under:
            return self._below(D, d)
        coast = self.surface.coast
        distance = intersect.first_crossing(self.surface.relief, self.eye_y, d)
        to_land = np.full(d.shape[0], np.inf)
        if coast is not None:
            to_land = intersect.land_crossing(coast.land, self.eye_y, d, *coast.within(d))
        dry = to_land < distance
        met = np.isfinite(distance) & ~dry
        colour, amount = np.zeros_like(D), np.zeros_like(X)
        if coast is not None and dry.any():
            colour[dry], amount[dry] = self._land(coast, D[dry], d[dry], to_land[dry])
        sky = ~met & ~dry
        if sky.any() and self.lighting is not None:
            colour[sky] = self._sky(self.lighting.air, D[sky], d[sky]) * self.exposure
        if met.any():
            colour[met], amount[met] = self._water(self.water_samples(D[met], d[met], distance[met]))
        seen, radiance, far = self._hulls(np.array([0.0, self.eye_y, 0.0]), d, np.minimum(distance, to_land))
        if self.lighting is not None:
            radiance = self.lighting.haze(radiance, d[seen], far) * self.exposure
        colour[seen] = radiance
        nearest = np.minimum(distance, to_land)
        nearest[seen] = far
        for crest in self.crests:
            self._crest(crest, D, d, nearest, colour)
        return np.minimum(colour, BRIGHTEST), amount

    def _sky(self, air: light.Air, D: Floats, d: Floats) -> Floats:
        """Radiance (r, 3) of the sky along rays D of directions d."""
        if air.above is None:
            return air.sky(d) + light.sun_disc(air, d)
        step = self.grid.steps[1]
        return air.above.whole(d, math.sqrt(dot(step, step)) / np.sqrt(dot(D, D)))

    def _water(self, samples: WaterSamples) -> Pair:
        """Colour (r, 3) and foam amount (r,) of samples of the water."""
        foam, lighting = self.scene.foam, self.lighting
        a, f = self._foam(samples)
        amount = np.minimum(a, 1.0)
        if lighting is None:
            return np.repeat(amount[:, None], 3, axis=1), amount
        place = np.stack((samples.x, samples.height, samples.z), axis=-1)
        sun = lighting.sunlight(place, samples.footprints)
        on_water = on_foam = sun
        if foam is not None and f is not None and foam.thickness > 0.0:
            left, factor = self._foam_shadow(lighting.air.sun, a, f, samples)
            on_water, on_foam = left * sun, factor * sun
        coast, at = self.surface.coast, (samples.x, samples.z, samples.height, samples.d, samples.normal)
        bed = self.seabed if coast is None else coast
        hit = light.WaterHit(
            samples,
            self.surface.relief.bounds,
            # What is under the water, if its floor is not level and uniform.
            floor=None if bed is None else bed.seen(*at, samples.footprints),
            saturation=f,
            sun=sun,
            sun_past_foam=on_water,
            mirrored=lambda r, spread: self._mirror(lighting, place, r, spread),
            glint=lighting.glint,
        )
        return self._shown(lighting, hit, a, on_foam), amount

    def _shown(self, lighting: Lighting, hit: light.WaterHit, a: Floats, sun: Floats) -> Floats:
        """Colour (r, 3) of water and of an amount a (r,) of foam on it, ``sun`` (r,) of its sunlight left."""
        foam, at, air = self.scene.foam, hit.at, lighting.air
        colour = light.water(air, self.scene.water, hit)
        if foam is not None and hit.saturation is not None:
            white = light.foam(air, foam.albedo, at.foam_normal, sun)
            if foam.scattering is not None:
                layer = (air, foam.scattering, foam.albedo, at.foam_normal, at.d, hit.saturation, sun)
                glow, opaque = light.foam_layer(*layer)
                white = glow + (1.0 - opaque)[:, None] * colour
            colour = self._blend(colour, white, a)
        return lighting.haze(colour, at.d, at.distance) * self.exposure

    def _crest(self, crest: PlungingCrest, D: Floats, d: Floats, nearest: Floats, colour: Floats) -> None:
        """Write the colour (r, 3) of a crest, and how far it is, where rays meet it before ``nearest`` (r,), m."""
        distance, part = crest.trace(np.array([0.0, self.eye_y, 0.0]), d)
        rows, lighting = np.flatnonzero(distance < nearest), self.lighting
        D, d, distance = D[rows], d[rows], distance[rows]
        nearest[rows] = distance
        place = distance[:, None] * d + np.array([0.0, self.eye_y, 0.0])
        look, t = CrestLook(crest, place, part[rows]), distance / np.sqrt(dot(D, D))
        sides = [intersect.footprint(t, D, look.normal, step, (0, 1, 2)) for step in self.grid.steps]
        fine, drawn_out = ((look.on(sides[0], by), look.on(sides[1], by)) for by in (1.0, look.drawn))
        a = none = np.zeros(rows.size)
        if (foam := self.scene.foam) is not None:
            if left := foam.source(BreakerSaturation):
                f = crest.left(left, look.level[0], look.level[2], None, even=True)
                look.saturation = np.maximum(look.saturation, np.minimum(f, 1.0 if foam.look == "filtered" else CAP))
            a = self._mask_amount(look.saturation, look.streaks[0], look.streaks[2], drawn_out, to_rest=(none, none))
        if lighting is None:
            colour[rows] = np.minimum(a, 1.0)[:, None]
            return
        tilt, sun = look.off(self.surface.slopes(look.level[0], look.level[2])[2]), lighting.sunlight(place, fine)
        normals = unit(look.normal - tilt), unit(look.normal - 0.5 * tilt + look.soft)
        seen = light.WaterHit(
            WaterSamples(d, distance, place[:, 0], place[:, 2], place[:, 1], fine, *normals),
            Bounds(),
            floor=look.through(lighting.air, self.scene.water, d),
            saturation=None if self.scene.foam is None else look.saturation,
            sun=sun,
            sun_past_foam=sun,
            mirrored=lambda r, spread: look.mirrored(d) * lighting.air.mirrored(r, spread),
            glint=lighting.glint,
        )
        colour[rows] = self._shown(lighting, seen, a, sun)

    def _land(self, coast: Coast, D: Floats, d: Floats, distance: Floats) -> Pair:
        """Colour (r, 3) and foam amount (r,) where rays D meet land, ``distance`` metres away."""
        foam, lighting = self.scene.foam, self.lighting
        x, z = d[:, 0] * distance, d[:, 2] * distance
        q_x, q_z = coast.place(x, z)
        height, g_x, g_z, _ = coast.ground(q_x, q_z)
        N = intersect.normal(g_x, g_z)
        footprints = self.footprints(distance / np.sqrt(dot(D, D)), D, N)
        amount = np.zeros_like(x)
        surf = None if foam is None else foam.source(SurfSaturation)
        if foam is not None and self.assets is not None and surf is not None and surf.line > 0.0:
            filtered = foam.look == "filtered"
            left = coast.swash_foam(surf, x, z, height, footprints if filtered and self.filtering else None)
            f = np.minimum(left, 1.0 if filtered else CAP)
            still = np.zeros_like(x), np.zeros_like(x)
            amount = np.minimum(self._mask_amount(f, x, z, footprints, to_rest=still), 1.0)
        if lighting is None:
            return np.repeat(amount[:, None], 3, axis=1), amount
        sun = lighting.sunlight(np.stack((x, height, z), axis=-1), footprints)
        colour = light.land(lighting.air, coast.soil(q_x, q_z, footprints, still=False), d, unit(N), sun)
        if foam is not None:
            white = light.foam(lighting.air, foam.albedo, unit(N), sun)
            colour = colour + (white - colour) * amount[:, None]
        return lighting.haze(colour, d, distance) * self.exposure, amount

    def _below(self, D: Floats, d: Floats) -> Pair:
        """Colour (r, 3) and foam amount (r,) along rays D of a camera under the surface; every ray ends in water."""
        distance = intersect.first_crossing(self.surface.relief, self.eye_y, d)
        colour, amount = np.zeros_like(d), np.zeros(d.shape[0])
        if self.seabed is None or self.lighting is None:
            # Without light: white foam, black water.
            up = np.isfinite(distance)
            if up.any():
                a, _ = self._foam(self.water_samples(D[up], d[up], distance[up], side=-1.0))
                amount[up] = np.minimum(a, 1.0)
            return np.repeat(amount[:, None], 3, axis=1), amount
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
        return np.minimum(colour * self.exposure, BRIGHTEST), amount

    def _underside(self, bed: Seabed, D: Floats, d: Floats, distance: Floats) -> Pair:
        """Colour (r, 3), not exposed, and foam amount (r,) of the surface that rays D meet from below."""
        foam, samples = self.scene.foam, self.water_samples(D, d, distance, side=-1.0)
        place = samples.x, samples.z, samples.height
        radiance = bed.underside(*place, d, samples.normal, distance, samples.footprints)
        a, _ = self._foam(samples)
        if foam is not None:
            white = FOAM_THROUGH * light.foam(bed.air, foam.albedo, samples.foam_normal)
            radiance = self._blend(radiance, white, a)
        return self._through_water(bed, radiance, d, distance), np.minimum(a, 1.0)

    def _through_water(self, bed: Seabed, radiance: Floats, d: Floats, distance: Floats) -> Floats:
        """Radiance (r, 3) that reaches the camera along rays d (r, 3) through (r,) m of water."""
        glow = bed.glow(np.full(distance.shape, -self.eye_y), -d[:, 1], distance)
        return radiance * np.exp(-bed.extinction * distance[:, None]) + glow

    def _blend(self, colour: Floats, white: Floats, a: Floats) -> Floats:
        """Foam (r, 3) blended over water (r, 3) by its amount (r,)."""
        if self.scene.foam is not None and self.scene.foam.look == "listing":
            return np.clip(self.exposure * (colour + white * a[:, None]), 0.0, 1.0) / self.exposure
        return colour * (1.0 - a[:, None]) + white * a[:, None]

    def _mirror(self, lighting: Lighting, place: Floats, r: Floats, spread: Pair) -> Floats:
        """Radiance that arrives from directions r (r, 3) at places (r, 3) on the water: sky, and what occludes it.
        ``spread``: standard deviations (r,) of the directions about r from which the sky's light comes, rad."""
        coast, reflection = self.surface.coast, lighting.settings.reflection
        if reflection == "cubemap" and coast is not None:
            return self._around(lighting, coast, r, spread)
        seen = lighting.air.mirrored(r, spread)
        if reflection == "sky" and self.boulders is not None:
            return self.boulders.mirrored(lighting.air, place, r, spread[0], seen)
        if reflection != "planar":
            return seen
        to_land = np.full(r.shape[0], np.inf)
        if coast is not None:
            ashore = self._mirrored_land(lighting, coast, place, r, to_land)
            seen[np.isfinite(to_land)] = ashore
        met, radiance, far = self._hulls(place, r, to_land, mirrored=True)
        seen[met] = lighting.haze(radiance, r[met], far)
        return seen

    def _mirrored_land(self, lighting: Lighting, coast: Coast, place: Floats, r: Floats, far: Floats) -> Floats:
        """Radiance (n, 3) of land that rays r (r, 3) from places (r, 3) meet; writes how far, m, to ``far`` (r,)."""
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

    def _around(self, lighting: Lighting, coast: Coast, r: Floats, spread: Pair) -> Floats:
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
