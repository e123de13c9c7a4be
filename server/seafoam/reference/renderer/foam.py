"""Foam where rays meet water or ground."""

from __future__ import annotations

import numpy as np

from seafoam.ocean.stokes import foam_life
from seafoam.reference import sampling
from seafoam.reference.foam import cells, living, looks
from seafoam.reference.foam.coverage import OCTAVES_MOST, coverage, mask_place, tiles, turned_footprint
from seafoam.reference.foam.drift import Copy, copies
from seafoam.reference.light import light
from seafoam.reference.renderer.assets import Assets
from seafoam.reference.renderer.sources import saturation
from seafoam.reference.renderer.state import ReferenceState
from seafoam.reference.types import Floats, smoothstep
from seafoam.scene.foam import DriftSaturation, Foam

LOWEST_SHADE = 0.25
"""Sine of the sun's elevation below which shadows of foam have constant length."""
FOAM_SHADE = 0.6
"""Share of the sun's light that foam blocks."""
TEXTURED_LOOKS = ("textured", "halftone_textured", "listing")


class FoamStage(ReferenceState):
    """Saturation and amount of foam, for scenes with foam."""

    @property
    def foam(self) -> Foam:
        """The scene's foam."""
        assert self.scene.foam is not None
        return self.scene.foam

    @property
    def images(self) -> Assets:
        """Masks and textures of the foam."""
        assert self.assets is not None
        return self.assets

    def _foam(self, x: Floats, z: Floats, H: Floats, t: Floats, D: Floats, N: Floats) -> tuple[Floats, Floats]:
        """Foam amount at r places, in [0, 3] for the look ``listing``, else in [0, 1], and saturation f; (r,) each."""
        foam = self.foam
        foot_x, foot_y = self.footprints(t, D, N)
        f = saturation(self, foam, x, z, H, (foot_x, foot_y))
        return self._lying(f, x, z, foot_x, foot_y), f

    def _past_foam(
        self,
        air: light.Air,
        amount: Floats,
        f: Floats,
        x: Floats,
        z: Floats,
        t: Floats,
        D: Floats,
        N: Floats,
    ) -> tuple[Floats, Floats]:
        """Share of the sun's light that foam beside r places leaves to their water, and the factor on their foam's
        light."""
        foam = self.foam
        feet = self.footprints(t, D, N)
        sides = [np.maximum(np.hypot(foot[:, 0], foot[:, 1]), 1e-6) for foot in feet]
        way = foam.thickness / max(float(air.sun[1]), LOWEST_SHADE) * air.sun[[0, 2]]
        near = 1.0 - smoothstep(0.25, 1.0, np.maximum(*sides) / max(float(np.hypot(*way)), 1e-6))
        near = FOAM_SHADE * np.where(f > 0.0, near, 0.0)
        soft_x, soft_y = (
            foot * np.maximum(1.0, 0.5 * foam.thickness / side)[:, None] for foot, side in zip(feet, sides, strict=True)
        )
        there = self._lying(f, x, z, soft_x, soft_y, (way[0], way[1]), octaves=1)
        beside = near * np.minimum(there, 1.0)
        return 1.0 - beside, 1.0 + near * np.minimum(amount, 1.0) - beside

    def _lying(
        self,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        beside: tuple[float, float] = (0.0, 0.0),
        way: tuple[Floats, Floats] | None = None,
        octaves: int = OCTAVES_MOST,
    ) -> Floats:
        """Foam amount at r places of the water, or (x, z) m beside them, however its mask is moved; (r,).

        ``way``: displacement to where the water rests, m; by default that of the waves. ``octaves``: maximum of the
        mask's.
        """
        if foam_life(self.scene) is not None:
            rests = self.carry(x, z) if way is None else way
            return self._living(f, x, z, foot_x, foot_y, beside, rests, octaves)
        x, z = x + beside[0], z + beside[1]
        carried = self._carried(x, z)
        if not carried:
            return self._look(f, x, z, foot_x, foot_y, octaves)
        free = np.ones_like(x)
        for copy in carried:
            part = cells.part(f, copy.weight)
            turned = copy.turned(foot_x), copy.turned(foot_y)
            amount = self._look(part, copy.x, copy.z, *turned, octaves)
            free *= np.where(copy.weight > 0.0, 1.0 - amount, 1.0)
        return 1.0 - free

    def _living(
        self,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        beside: tuple[float, float],
        way: tuple[Floats, Floats],
        octaves: int,
    ) -> Floats:
        """The same for foam with a history: drifting, in windrows, with masks by age."""
        foam = self.foam
        limited = np.clip(f, 0.0, 1.0)
        s = looks.faded(limited, foam.fade) if foam.octaves > 1 else limited
        # The converged frame resolves all windrows, so they are not filtered.
        s = living.gathered(self.scene, self.time, self.afloat, s, x, z)
        l_x, l_z = x + way[0] + beside[0], z + way[1] + beside[1]
        u, v = mask_place(l_x, l_z, foam, (0.0, 0.0))
        at = living.drifted(self.scene, self.time, self.afloat)
        feet = turned_footprint(foot_x, foam), turned_footprint(foot_y, foam)
        t = self._texture(l_x, l_z, foot_x, foot_y)
        free = np.ones_like(x)
        masks = (self.images, *self.images.older)
        for part in living.shares(len(masks), s, limited):
            own = np.flatnonzero(part.weight > 0.0)
            covered = coverage(
                foam,
                masks[part.mask],
                part.s[own],
                u[own] + at[0],
                v[own] + at[1],
                feet[0][own],
                feet[1][own],
                filtering=self.filtering,
                shares=True,
                octaves=octaves,
            )
            free[own] *= 1.0 - looks.thinned(covered, t[own], foam.texture)
        return 1.0 - free

    def _look(
        self,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        octaves: int,
    ) -> Floats:
        """Foam amount at r places of mask and texture, over footprints (r, 2) m; (r,)."""
        foam = self.foam
        filtered = foam.look == "filtered"
        t = self._texture(x, z, foot_x, foot_y)
        if foam.look == "textured":
            return looks.textured(f, t)
        feet = turned_footprint(foot_x, foam), turned_footprint(foot_y, foam)
        if foam.cells and foam_life(self.scene) is None:
            free = np.ones_like(x)
            for corner in cells.corners(*cells.counted(x, z, foam, self.afloat), filtered):
                own = np.flatnonzero(corner.weight > 0.0)
                turned = corner.turned(feet[0])[own], corner.turned(feet[1])[own]
                part = cells.part(f[own], corner.weight[own]) if filtered else f[own]
                here = corner.u[own], corner.v[own]
                free[own] *= 1.0 - self._amount(part, t[own], *here, turned, octaves)
            return 1.0 - free
        return self._amount(f, t, *mask_place(x, z, foam, self.afloat), feet, octaves)

    def _carried(self, x: Floats, z: Floats) -> list[Copy]:
        """The copies of the mask that a flow advects; empty without one."""
        foam = self.foam
        source = foam.source(DriftSaturation)
        if source is None or source.amount == 0.0 or self.scene.drift is None or foam.look != "filtered":
            return []
        return copies(self.scene, source, foam.mask_tile, self.time, self.origin, x, z)

    def _amount(
        self,
        f: Floats,
        t: Floats,
        u: Floats,
        v: Floats,
        feet: tuple[Floats, Floats],
        octaves: int,
    ) -> Floats:
        """Foam amount of a masked look at mask coordinates (u, v), footprints ``feet`` in tiles; (r,)."""
        foam = self.foam
        if foam.look == "filtered":
            covered = coverage(foam, self.images, f, u, v, *feet, filtering=self.filtering, octaves=octaves)
            return looks.thinned(covered, t, foam.texture)
        m = sampling.nearest(self.images.thresholds, u, v)
        if foam.look == "halftone":
            return looks.halftone(f, m)
        if foam.look == "fading":
            return looks.fading(f, m)
        return looks.halftone_textured(f, m, t) if foam.look == "halftone_textured" else looks.listing(f, m, t)

    def _texture(self, x: Floats, z: Floats, foot_x: Floats, foot_y: Floats) -> Floats:
        foam = self.foam
        if foam.look not in TEXTURED_LOOKS and not (foam.look == "filtered" and foam.texture > 0.0):
            return np.ones_like(x)
        first = self._texture_copy(foam.texture_tile, False, x, z, foot_x, foot_y)
        if foam.texture_second is None:
            return first
        return 0.5 * (first + self._texture_copy(foam.texture_second, True, x, z, foot_x, foot_y))

    def _texture_copy(self, tile: float, swapped: bool, x: Floats, z: Floats, foot_x: Floats, foot_y: Floats) -> Floats:
        texture = self.images.texture
        u = tiles(self.afloat[0], tile) + x / tile
        v = tiles(self.afloat[1], tile) + z / tile
        if swapped:
            u, v = v, u
        if not self.filtering:
            return sampling.bilinear(texture[0], u, v)
        level = sampling.footprint_level(foot_x / tile, foot_y / tile, texture[0].shape[0])
        return sampling.trilinear(texture, u, v, level)
