"""Foam where rays meet water or ground."""

from dataclasses import replace

import numpy as np

from seafoam.ocean.waves.stokes import foam_life
from seafoam.reference import sampling
from seafoam.reference.foam import coverage as cover
from seafoam.reference.foam import looks
from seafoam.reference.foam.coverage import OCTAVES_MOST, Assets, MaskPoints, coverage, mask_points, tiles
from seafoam.reference.foam.drift import Copy, copies
from seafoam.reference.renderer.sources import saturation
from seafoam.reference.renderer.state import ReferenceState
from seafoam.reference.types import Floats, Footprints, Indices, Pair, Vec2, WaterSamples, smoothstep
from seafoam.scene import DriftSaturation, Foam

LOWEST_SHADE = 0.25  # sine of the sun's elevation below which shadows of foam have constant length
FOAM_SHADE = 0.6  # share of the sun's light that foam blocks
TEXTURED_LOOKS = ("textured", "halftone_textured", "listing")


class FoamStage(ReferenceState):
    """Saturation and amount of foam, for scenes with foam."""

    @property
    def foam(self) -> Foam:
        assert self.scene.foam is not None
        return self.scene.foam

    @property
    def images(self) -> Assets:
        assert self.assets is not None
        return self.assets

    def _hulls(self, o: Floats, d: Floats, nearer: Floats, *, mirrored: bool = False) -> tuple[Indices, Floats, Floats]:
        """Which of the rays d (r, 3) from o meet boats, or unless ``mirrored`` stones, less than ``nearer`` (r,) m
        away; their radiance (n, 3), 0 without light, and distances (n,), m."""
        far, radiance = nearer.copy(), np.zeros_like(d)
        solids = (self.fleet, None if mirrored else self.boulders)
        for solid in (solid for solid in solids if solid is not None):
            hit = solid.trace(o, d)
            seen = np.flatnonzero(hit.t < far)
            far[seen] = hit.t[seen]
            if self.lighting is not None:
                start, lit = np.broadcast_to(o, d.shape)[seen], self.lighting
                radiance[seen] = solid.light(lit.air, lit.open_sun, start, d[seen], hit.subset(seen))
        met = np.flatnonzero(far < nearer)
        return met, radiance[met], far[met]

    def _foam(self, samples: WaterSamples) -> tuple[Floats, Floats | None]:
        """Foam amount at r samples, in [0, 3] for the look ``listing``, else in [0, 1], and saturation f; (r,) each."""
        if self.scene.foam is None or self.assets is None:
            return np.zeros_like(samples.x), None
        f = saturation(self, self.foam, samples)
        return self._mask_amount(f, samples.x, samples.z, samples.footprints), f

    def _foam_shadow(self, sun: Floats, amount: Floats, f: Floats, samples: WaterSamples) -> Pair:
        """Share of the sun's light that foam toward the sun leaves to the water of r samples, and the factor on their
        foam's light; (r,) each."""
        foam = self.foam
        lengths = [np.maximum(np.hypot(side[:, 0], side[:, 1]), 1e-6) for side in samples.footprints]
        offset = foam.thickness / max(float(sun[1]), LOWEST_SHADE) * sun[[0, 2]]
        near = 1.0 - smoothstep(0.25, 1.0, np.maximum(*lengths) / max(float(np.hypot(*offset)), 1e-6))
        near = FOAM_SHADE * np.where(f > 0.0, near, 0.0)
        soft_x, soft_y = (
            side * np.maximum(1.0, 0.5 * foam.thickness / length)[:, None]
            for side, length in zip(samples.footprints, lengths, strict=True)
        )
        casting = self._mask_amount(f, samples.x, samples.z, (soft_x, soft_y), offset=(offset[0], offset[1]), octaves=1)
        blocked = near * np.minimum(casting, 1.0)
        return 1.0 - blocked, 1.0 + near * np.minimum(amount, 1.0) - blocked

    def _mask_amount(
        self,
        f: Floats,
        x: Floats,
        z: Floats,
        footprints: Footprints,
        offset: Vec2 = (0.0, 0.0),
        to_rest: Pair | None = None,
        octaves: int = OCTAVES_MOST,
    ) -> Floats:
        """Foam amount at r places of the water, or ``offset`` m from them, of at most so many octaves of a mask; (r,).
        ``to_rest``: displacement to the water's rest position, m; by default that of the waves."""
        if foam_life(self.scene) is not None:
            by_x, by_z = self.surface.to_rest(x, z) if to_rest is None else to_rest
            rest = x + by_x + offset[0], z + by_z + offset[1]
            f = np.clip(f, 0.0, 1.0)
            s = looks.ramped(f, self.foam.fade) if self.foam.octaves > 1 else f
            # The converged frame resolves all windrows, so they are not filtered.
            gathered = cover.gathered(self.scene, self.time, self.surface.afloat, s, x, z)
            return self._aging(gathered, f, rest, footprints, octaves)
        x, z = x + offset[0], z + offset[1]
        advected = self._advected(x, z)
        if not advected:
            return self._look(f, x, z, footprints, octaves)
        free = np.ones_like(x)
        for copy in advected:
            part = cover.part(f, copy.weight)
            turned = copy.turned(footprints[0]), copy.turned(footprints[1])
            amount = self._look(part, copy.x, copy.z, turned, octaves)
            free *= np.where(copy.weight > 0.0, 1.0 - amount, 1.0)
        return 1.0 - free

    def _aging(self, s: Floats, f: Floats, rest: Pair, footprints: Footprints, octaves: int) -> Floats:
        """Foam amount of a coverage s of masks by age, where the water's rest position is ``rest``; (r,)."""
        foam = self.foam
        points = mask_points(*rest, footprints, foam, (0.0, 0.0))
        by_u, by_v = cover.drifted(self.scene, self.time, self.surface.afloat)
        points = replace(points, u=points.u + by_u, v=points.v + by_v)
        t = self._texture(*rest, footprints)
        free = np.ones_like(s)
        masks = (self.images, *self.images.older)
        for mask, (weight, share) in zip(masks, cover.shares(len(masks), s, f), strict=True):
            own = np.flatnonzero(weight > 0.0)
            covered = coverage(
                foam, mask, share[own], points.subset(own), filtering=self.filtering, shares=True, octaves=octaves
            )
            free[own] *= 1.0 - looks.thinned(covered, t[own], foam.texture)
        return 1.0 - free

    def _look(self, f: Floats, x: Floats, z: Floats, footprints: Footprints, octaves: int) -> Floats:
        """Foam amount at r places of mask and texture, over footprints; (r,)."""
        foam = self.foam
        t = self._texture(x, z, footprints)
        if foam.look == "textured":
            return looks.hard(foam.look, f, f, t)
        points = mask_points(x, z, footprints, foam, self.surface.afloat)
        if not foam.cells or foam_life(self.scene) is not None:
            return self._amount(f, t, points, octaves)
        filtered = foam.look == "filtered"
        free = np.ones_like(x)
        for corner in cover.corners(*cover.counted(x, z, foam, self.surface.afloat), filtered):
            own = np.flatnonzero(corner.weight > 0.0)
            turned = corner.turned(points.foot_u), corner.turned(points.foot_v)
            part = cover.part(f[own], corner.weight[own]) if filtered else f[own]
            cell = MaskPoints(corner.u, corner.v, *turned).subset(own)
            free[own] *= 1.0 - self._amount(part, t[own], cell, octaves)
        return 1.0 - free

    def _advected(self, x: Floats, z: Floats) -> list[Copy]:
        """The copies of the mask that a flow advects; empty without one."""
        foam = self.foam
        source = foam.source(DriftSaturation)
        if source is None or source.amount == 0.0 or self.scene.drift is None or foam.look != "filtered":
            return []
        return copies(self.scene, source, foam.mask_tile, self.time, self.origin, x, z)

    def _amount(self, f: Floats, t: Floats, points: MaskPoints, octaves: int) -> Floats:
        """Foam amount of a masked look; (r,)."""
        foam = self.foam
        if foam.look == "filtered":
            covered = coverage(foam, self.images, f, points, filtering=self.filtering, octaves=octaves)
            return looks.thinned(covered, t, foam.texture)
        return looks.hard(foam.look, f, sampling.nearest(self.images.thresholds, points.u, points.v), t)

    def _texture(self, x: Floats, z: Floats, footprints: Footprints) -> Floats:
        foam = self.foam
        if foam.look not in TEXTURED_LOOKS and not (foam.look == "filtered" and foam.texture > 0.0):
            return np.ones_like(x)
        texture, afloat, total = self.images.texture, self.surface.afloat, np.zeros_like(x)
        copies_of = [tile for tile in (foam.texture_tile, foam.texture_second) if tile is not None]
        for copy, tile in enumerate(copies_of):
            places = tiles(afloat[0], tile) + x / tile, tiles(afloat[1], tile) + z / tile
            # The second copy is mirrored at a diagonal.
            u, v = places if copy == 0 else places[::-1]
            if self.filtering:
                longer = np.maximum(*(((side / tile) ** 2).sum(axis=1) for side in footprints))
                level = 0.5 * np.log2(np.maximum(longer * float(len(texture[0])) ** 2, 1e-60))
                total += sampling.trilinear(texture, u, v, level)
            else:
                total += sampling.bilinear(texture[0], u, v)
        return total / len(copies_of)
