"""Colours of samples: sky, water, land and boats."""

import math

import numpy as np

from seafoam.reference.foam.front import CAP
from seafoam.reference.light import light
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.state import Lighting, WaterSamples
from seafoam.reference.renderer.underwater import BRIGHTEST, UnderwaterStage
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Bools, Floats, dot, unit
from seafoam.scene.foam import Foam, SurfSaturation


class SampleShader(UnderwaterStage):
    """Colour, foam amount and hit of samples at clip positions."""

    def shade(self, X: Floats, Y: Floats) -> tuple[Floats, Floats, Bools]:
        """Colour (r, 3), foam amount (r,) and hit (r,) of samples at clip positions (r,)."""
        D = cameras.rays(self.grid.view, X, Y)
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
        return np.minimum(colour, BRIGHTEST), amount, met | dry

    def _sky(self, air: light.Air, D: Floats, d: Floats) -> Floats:
        """Radiance (r, 3) of the sky along rays D of directions d."""
        if air.above is None:
            return air.sky(d) + light.sun_disc(air, d)
        step = self.grid.steps[1]
        return air.above.whole(d, math.sqrt(dot(step, step)) / np.sqrt(dot(D, D)))

    def _water(self, samples: WaterSamples) -> tuple[Floats, Floats]:
        """Colour (r, 3) and foam amount (r,) of samples of the water."""
        foam, lighting = self.scene.foam, self.lighting
        a, f = np.zeros_like(samples.x), None
        if foam is not None and self.assets is not None:
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
        illumination = light.Illumination(
            sun, on_water, lambda r, spread: self._mirror(lighting, place, r, spread), lighting.glint
        )
        relief = self.surface.relief
        hit = light.WaterHit(
            samples.d, samples.normal, samples.height, (relief.trough, relief.top), self._floor(samples), f
        )
        colour = light.water(lighting.air, self.scene.water, hit, illumination)
        if foam is not None:
            colour = self._foam_over(lighting, foam, colour, samples, a, f, on_foam)
        return lighting.haze(colour, samples.d, samples.distance) * self.exposure, amount

    def _floor(self, samples: WaterSamples) -> light.Floor | None:
        """What is under the water, if its floor is not level and uniform."""
        place = samples.x, samples.z, samples.height, samples.d, samples.normal, samples.footprints
        if self.surface.coast is not None:
            return self.surface.coast.bed(*place)
        return None if self.seabed is None else self.seabed.seen(*place)

    def _foam_over(
        self,
        lighting: Lighting,
        foam: Foam,
        water: Floats,
        samples: WaterSamples,
        a: Floats,
        f: Floats | None,
        sun: Floats,
    ) -> Floats:
        """Foam over the light of the water (r, 3), not exposed, lit by a share of the sun (r,); (r, 3)."""
        if foam.scattering is None or f is None:
            white = light.foam(lighting.air, foam.albedo, samples.foam_normal, sun)
        else:
            normal, d = samples.foam_normal, samples.d
            glow, opaque = light.foam_layer(lighting.air, foam.scattering, foam.albedo, normal, d, f, sun)
            white = glow + (1.0 - opaque)[:, None] * water
        return self._blend(water, white, a)

    def _land(self, coast: Coast, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
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
