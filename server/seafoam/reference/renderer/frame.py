"""A frame of a scene: rays through pixels, the surface under them, foam, light, and the average."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from seafoam.masks import Mask, mask_by_name
from seafoam.ocean.stokes import foam_drift, foam_life
from seafoam.reference import sampling
from seafoam.reference.boats import boat as fleets
from seafoam.reference.foam import cells, living, looks
from seafoam.reference.foam.drift import Copy, copies, drift_saturation
from seafoam.reference.foam.saturation import CAP, FRONT_CONSTANTS, History, saturation
from seafoam.reference.light import light, sparkles
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer import intersect
from seafoam.reference.renderer.relief import Part, Relief
from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray import spray
from seafoam.reference.types import Bools, Floats, dot, smoothstep, unit
from seafoam.reference.water.seafloor import FARTHEST, FOAM_THROUGH, Bed, bed_of, under_of
from seafoam.reference.waves.gusts import GustField
from seafoam.reference.waves.parametric import RippleSet, WaveSet, ripple_set, wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import fold_saturation, sea_surface
from seafoam.scene.camera import Camera
from seafoam.scene.foam import DriftSaturation, Foam, FoldSaturation, FrontSaturation, SurfSaturation
from seafoam.scene.models import Scene
from seafoam.textures import foam_texture

Mode = Literal["same-samples", "converged"]

CHUNK = 32768
"""Rays at a time: their arrays stay in the processor's cache."""
JITTER_SEED = 20110
AROUND_HEIGHT = 1.0
AROUND_BLUR = 0.012
"""Where the surroundings are looked at from (m), and how much of them ripples blur (rad)."""
BRIGHTEST = 65504.0
"""The greatest half float; a frame holds no more."""
LOWEST_SHADE = 0.25
"""Sine of the sun's elevation under which shades of foam grow no longer."""
OCTAVES_MOST = 4
FOAM_SHADE = 0.6
"""Share of the sun that foam takes from what lies behind it."""
TEXTURED_LOOKS = ("textured", "halftone_textured", "listing")


@dataclass(frozen=True, eq=False)
class Assets:
    """The images that foam reads."""

    thresholds: Floats
    """m of the mask, (size, size), row v and column u."""
    spans: list[Floats]
    """Chain of (low, width): where the thresholds of a level's texels lie; level l is (size/2^l, size/2^l, 2)."""
    quantiles: Floats
    """Tables of Q, see :func:`sampling.quantile`, (1 + levels, 65): of the B-spline mask, then of each level."""
    ramps: Floats
    """Tables of an octave's ramp, (2 + levels, 65): of the B-spline mask, of each level, width over the former."""
    texture: list[Floats]
    """Box-averaged chain of the foam texture t in [0, 1]."""
    older: tuple[Assets, ...] = ()
    """The same of the masks of older foam."""

    @staticmethod
    def of(mask: Mask, texture: Floats, older: Sequence[Mask] = ()) -> Assets:
        """From a mask, a foam texture (size, size) in [0, 1] and masks of older foam."""
        return Assets(
            older=tuple(Assets.of(one, texture) for one in older if one.ranks.shape == mask.ranks.shape),
            thresholds=sampling.thresholds(mask.ranks),
            spans=[level.astype(np.float64) for level in mask.spans],
            quantiles=mask.quantiles,
            ramps=mask.ramps,
            texture=sampling.box_chain(np.asarray(texture, np.float64)),
        )

    @staticmethod
    def for_scene(scene: Scene) -> Assets | None:
        """The images of a scene's foam; None without foam. Raises ``KeyError`` or ``ValueError`` for a bad mask."""
        if scene.foam is None:
            return None
        life = foam_life(scene)
        older = [mask_by_name(name) for name in life.masks] if life is not None else []
        return Assets.of(mask_by_name(scene.foam.mask), foam_texture(), older)


@dataclass(frozen=True, eq=False)
class Frame:
    """A picture in linear light, rows from the top."""

    rgb: Floats
    """(H, W, 3), averaged over the samples, exposed, not tone mapped."""
    alpha: Floats
    """(H, W), mean foam amount in [0, 1]; 0 in the sky."""
    amount: Floats
    """(H·n, W·n), foam amount of each sample, at most 1; in converged mode of each cell's one jittered sample."""
    hit: Bools
    """(H·n, W·n), whether a sample met the surface."""
    depression: Floats
    """(H, W), angle of each pixel's middle ray below the horizon, rad."""
    samples: int
    """n, samples along each side of a pixel."""


def render(
    scene: Scene,
    *,
    time: float,
    width: int,
    height: int,
    samples: int = 1,
    camera: Camera | None = None,
    mode: Mode = "same-samples",
    assets: Assets | None = None,
) -> Frame:
    """Render a scene at a time (s) with ``samples``² samples a pixel.

    ``same-samples`` sets them on the grid of section 1 and filters as the page says; ``converged`` jitters one in each
    cell of the grid, always in the same places, and puts the limit in place of the filtered look and level 0 in place
    of every texture level. ``camera`` stands in for the scene's. Waves and ripples are never slope-filtered.
    """
    if assets is None:
        assets = Assets.for_scene(scene)
    chosen = scene.camera if camera is None else camera
    view = cameras.view(chosen, width, height)
    shader = _Shader(scene, time, view, width, height, samples, mode, assets)
    pixels = width * height
    rgb = np.empty((pixels, 3))
    alpha = np.empty(pixels)
    amount = np.empty((height, samples, width, samples))
    hit = np.empty((height, samples, width, samples), np.bool_)
    kept = (height, samples, width, samples) if shader.spray is not None else (0, 0, 0, 0)
    picture, clip_x, clip_y = np.empty((*kept, 3)), np.empty(kept), np.empty(kept)
    cell = np.arange(samples)
    jitter = np.random.default_rng(JITTER_SEED)
    step = max(1, CHUNK // samples**2)
    for start in range(0, pixels, step):
        index = np.arange(start, min(start + step, pixels))
        row, column = index[:, None, None] // width, index[:, None, None] % width
        places = (index.size, samples, samples)
        offset = jitter.random((*places, 2)) if mode == "converged" else np.full((*places, 2), 0.5)
        down = row * samples + cell[:, None] + offset[..., 0]
        along = column * samples + cell + offset[..., 1]
        X = 2.0 * along / (samples * width) - 1.0
        Y = 1.0 - 2.0 * down / (samples * height)
        colour, a, met = shader.shade(X.ravel(), Y.ravel())
        where = (row, cell[:, None], column, cell)
        if shader.spray is not None:
            picture[where], clip_x[where], clip_y[where] = colour.reshape(*places, 3), X, Y
        rgb[index] = colour.reshape(index.size, samples**2, 3).mean(axis=1)
        alpha[index] = a.reshape(index.size, samples**2).mean(axis=1)
        amount[where] = a.reshape(places)
        hit[where] = met.reshape(places)
    grid = (height * samples, width * samples)
    if shader.spray is not None:
        laid = picture.reshape(*grid, 3)
        spray.lay_over(laid, clip_x.reshape(grid), clip_y.reshape(grid), shader.spray)
        rgb[:] = laid.reshape(height, samples, width, samples, 3).mean(axis=(1, 3)).reshape(pixels, 3)
    return Frame(
        rgb=rgb.reshape(height, width, 3),
        alpha=alpha.reshape(height, width),
        amount=amount.reshape(grid),
        hit=hit.reshape(grid),
        depression=cameras.depression(view, width, height),
        samples=samples,
    )


class _Shader:
    """Everything of a frame that no sample changes."""

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
        self.air = None if scene.light is None else light.air(scene.light, time, eye)
        self.sun: light.Glint | None = None
        if scene.light is not None and self.air is not None:
            step = max(math.sqrt(float(side @ side)) for side in (self.delta_x, self.delta_y))
            self.sun = sparkles.sun(scene.light, self.air, time, step if self.filtering else 0.0)
        self.waves = wave_set(scene, time, self.origin)
        self.sea = sea_surface(scene, time, self.origin)
        self.wakes = fleets.wake_set(scene, time, self.origin) if scene.boats else None
        parts: tuple[Part, ...] = (self.waves, ring_set(scene, time, self.origin))
        if self.wakes is not None:
            parts = (*parts, self.wakes)
        open_sea = Relief(parts if self.sea is None else (*parts, self.sea))
        self.coast = None if scene.shore is None else Coast(scene.shore, time, self.origin, open_sea)
        self.relief: Part = open_sea if self.coast is None else self.coast
        coast = self.coast
        ground = None if coast is None else lambda x, z: coast.ground(*coast.place(x, z))[0]
        self.fleet = fleets.fleet(scene, time, self.origin, self.relief.height, ground) if scene.boats else None
        self.gusts = GustField(scene.water.chop, time, self.origin)
        repeats = scene.light is not None and scene.light.caustics is not None
        self.ripples: RippleSet = ripple_set(scene.water.chop, time, self.origin, repeats)
        self.bed = bed_of(scene, self.air, time, self.origin)
        at_eye = float(self.relief.height(np.zeros(1), np.zeros(1))[0])
        self.covered = self.eye_y < at_eye
        self.under = scene.water.view_below and self.covered
        self.below = under_of(scene, self.air, time, self.origin, self.coast) if self.under else None
        sources = () if scene.foam is None else scene.foam.saturation
        self.fronts: dict[str, WaveSet] = {
            source.constants: wave_set(scene, time, self.origin, FRONT_CONSTANTS[source.constants].spatial)
            for source in sources
            if isinstance(source, FrontSaturation)
        }

        self.spray = self._spray(time, height * samples)

    def _spray(self, time: float, rows: int) -> spray.Discs | None:
        of, coast = self.scene.spray, self.coast
        if of is None or self.covered:
            return None
        if coast is None:
            drops, life = spray.from_waves(of, self.scene, self.waves, time, self.origin), of.life
        else:
            drops, life = spray.from_rocks(of, coast, time), spray.life_on_rocks(of, coast)
        lit = self.scene.light
        shown = spray.Shown(self.air, 1.0 if lit is None else lit.visibility, self._exposure)
        return spray.discs(of, drops, life, self.view, rows, self.relief, coast, shown)

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
            colour[sky] = beyond * self._exposure
        if met.any():
            colour[met], amount[met] = self._surface(D[met], d[met], distance[met])
        if self.fleet is not None:
            nearer = np.minimum(distance, to_land) if self.coast is not None else distance
            self._boats(self.fleet, d, nearer, colour)
        return np.minimum(colour, BRIGHTEST), amount, met | dry

    def _below(self, bed: Bed, D: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
        """What rays D of an eye under the surface see: colour (r, 3), foam amount (r,); every ray ends in water."""
        scene = self.scene
        distance = intersect.first_crossing(self.relief, self.eye_y, d)
        here = np.zeros(d.shape[0])
        to_floor = bed.reach(here, here, here + self.eye_y, d)
        amount = np.zeros(d.shape[0])
        colour = np.zeros_like(d)
        length = np.sqrt(dot(D, D))
        floor = ~np.isfinite(distance) | (to_floor < distance)
        if floor.any():
            tau = to_floor[floor] / length[floor]
            N = np.tile((0.0, 1.0, 0.0), (tau.size, 1))
            feet = (
                intersect.footprint(tau, D[floor], N, self.delta_x),
                intersect.footprint(tau, D[floor], N, self.delta_y),
            )
            here = np.zeros(tau.size)
            colour[floor] = bed.below(here, here, here + self.eye_y, d[floor], to_floor[floor], feet)
        up = ~floor
        if up.any():
            s = distance[up]
            x, z = d[up, 0] * s, d[up, 2] * s
            H = self.relief.height(x, z)
            (met_x, met_z), (h_x, h_z), (c_x, c_z) = self._slopes(x, z)
            feet = (
                intersect.footprint(s / length[up], D[up], -intersect.normal(met_x, met_z), self.delta_x),
                intersect.footprint(s / length[up], D[up], -intersect.normal(met_x, met_z), self.delta_y),
            )
            n = unit(intersect.normal(h_x + c_x, h_z + c_z))
            light_up = bed.ceiling(x, z, H, d[up], n, s, feet)
            if scene.foam is not None and self.assets is not None and scene.light is not None:
                N = -intersect.normal(met_x, met_z)
                a, _ = self._foam(scene.foam, self.assets, x, z, H, s / length[up], D[up], N)
                stiff = unit(intersect.normal(h_x + 0.5 * c_x, h_z + 0.5 * c_z))
                white = FOAM_THROUGH * light.foam(bed.air, scene.foam.albedo, stiff)
                light_up = self._laid(light_up, white, a)
                amount[up] = np.minimum(a, 1.0)
            glow = bed.glow(np.full(s.shape, -self.eye_y), -d[up, 1], s)
            colour[up] = light_up * np.exp(-bed.extinction * s[:, None]) + glow
        if self.fleet is not None:
            self._sunk(self.fleet, bed, d, np.where(up, distance, to_floor), colour)
        return np.minimum(colour * self._exposure, BRIGHTEST), amount, np.ones(d.shape[0], np.bool_)

    def _below_flat(self, D: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
        """The same without light: white foam in the ceiling, black water."""
        distance = intersect.first_crossing(self.relief, self.eye_y, d)
        amount = np.zeros(d.shape[0])
        up = np.isfinite(distance)
        if up.any() and self.scene.foam is not None and self.assets is not None:
            s = distance[up]
            x, z = d[up, 0] * s, d[up, 2] * s
            N = -intersect.normal(*self.relief.gradient(x, z))
            tau = s / np.sqrt(dot(D[up], D[up]))
            H = self.relief.height(x, z)
            a, _ = self._foam(self.scene.foam, self.assets, x, z, H, tau, D[up], N)
            amount[up] = np.minimum(a, 1.0)
        return np.repeat(amount[:, None], 3, axis=1), amount, np.ones(d.shape[0], np.bool_)

    def _sunk(self, fleet: fleets.Fleet, bed: Bed, d: Floats, nearer: Floats, colour: Floats) -> None:
        """Draws what of boats is under water over ``colour`` (r, 3), not exposed, through the water between."""
        eye = np.array([0.0, self.eye_y, 0.0])
        hit = fleet.trace(eye, d)
        seen = np.flatnonzero(hit.t < nearer)
        if seen.size:
            own = fleets.Hit(hit.t[seen], hit.normal[seen], hit.place[seen], hit.part[seen], hit.boat[seen])
            found = fleet.light(bed.air, eye, d[seen], own) * np.exp(-bed.extinction * own.t[:, None])
            colour[seen] = found + bed.glow(np.full(own.t.shape, -self.eye_y), -d[seen, 1], own.t)

    def _laid(self, colour: Floats, white: Floats, a: Floats) -> Floats:
        """Foam (r, 3) laid over water (r, 3) by its amount (r,)."""
        if self.scene.foam is not None and self.scene.foam.look == "listing":
            return np.clip(self._exposure * (colour + white * a[:, None]), 0.0, 1.0) / self._exposure
        return colour * (1.0 - a[:, None]) + white * a[:, None]

    def _slopes(self, x: Floats, z: Floats) -> tuple[tuple[Floats, Floats], ...]:
        """Slopes at (x, z) that rays meet, that light sees, and of what has no height; (r,) each."""
        met_x, met_z = self.relief.gradient(x, z)
        c_x, c_z = self.ripples.gradient(x, z)
        if self.gusts.gusts is not None:
            gust = self.gusts(x, z)
            c_x, c_z = gust * c_x, gust * c_z
        if self.sea is None:
            return (met_x, met_z), (met_x, met_z), (c_x, c_z)
        # Rays meet the bilinear sea; light sees its spline.
        (seen_x, seen_z), (own_x, own_z), (s_x, s_z) = (
            self.sea.shading(x, z),
            self.sea.gradient(x, z),
            self.sea.detail(x, z),
        )
        return (met_x, met_z), (met_x + (seen_x - own_x), met_z + (seen_z - own_z)), (c_x + s_x, c_z + s_z)

    def _boats(self, fleet: fleets.Fleet, d: Floats, nearer: Floats, colour: Floats) -> None:
        """Draws boats over ``colour`` (r, 3) where rays d meet them before anything else, ``nearer`` metres away."""
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
        colour[seen] = hazed * self._exposure

    def _mirror(self, place: Floats, r: Floats) -> Floats:
        """Radiance that comes from r (r, 3) into places (r, 3) on the water: the sky, and what stands before it."""
        assert self.air is not None
        assert self.scene.light is not None
        if self.scene.light.reflection == "cubemap" and self.coast is not None:
            return self._around(r)
        seen = self.air.mirrored(r)
        if self.scene.light.reflection != "planar":
            return seen
        to_land = np.full(r.shape[0], np.inf)
        if self.coast is not None:
            ashore = self._mirrored_land(self.coast, place, r, to_land)
            seen[np.isfinite(to_land)] = ashore
        if self.fleet is None:
            return seen
        hit = self.fleet.trace(place, r)
        met = np.flatnonzero(np.isfinite(hit.t) & (hit.t < to_land))
        if met.size:
            own = fleets.Hit(hit.t[met], hit.normal[met], hit.place[met], hit.part[met], hit.boat[met])
            found = self.fleet.light(self.air, place[met], r[met], own)
            seen[met] = light.haze(self.air, self.scene.light.visibility, found, r[met], own.t)
        return seen

    def _mirrored_land(self, coast: Coast, place: Floats, r: Floats, way: Floats) -> Floats:
        """Radiance (n, 3) of the land that rays r (r, 3) meet from places (r, 3); sets its ``way`` (r,), m."""
        low, high = coast.within(r, place[:, 0], place[:, 2])
        inside = np.flatnonzero(low < high)
        start = place[inside] + low[inside, None] * r[inside]
        found = low[inside] + coast.crossing(start[:, 0], start[:, 1], start[:, 2], r[inside], FARTHEST)
        at = place[inside] + found[:, None] * r[inside]
        ground = coast.ground(*coast.place(at[:, 0], at[:, 2]))[0]
        met = (found < high[inside]) & (ground > 0.0)
        way[inside[met]] = found[met]
        return self._land_light(coast, at[met], r[inside[met]], found[met])

    def _land_light(self, coast: Coast, at: Floats, d: Floats, far: Floats) -> Floats:
        """Radiance (n, 3) of land at places (n, 3) toward −d, ``far`` metres away, in the air."""
        assert self.air is not None
        assert self.scene.light is not None
        q_x, q_z = coast.place(at[:, 0], at[:, 2])
        ground, g_x, g_z, _ = coast.ground(q_x, q_z)
        wide = np.column_stack((AROUND_BLUR * far, np.zeros(far.size)))
        albedo = coast.albedo(q_x, q_z, wide, wide)
        seen = light.land(self.air, albedo, coast.wet(ground), d, unit(intersect.normal(g_x, g_z)))
        return light.haze(self.air, self.scene.light.visibility, seen, d, far)

    def _land(self, coast: Coast, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Colour (r, 3) and foam amount (r,) where rays D meet land, ``distance`` metres away."""
        scene = self.scene
        x, z = d[:, 0] * distance, d[:, 2] * distance
        q_x, q_z = coast.place(x, z)
        height, g_x, g_z, _ = coast.ground(q_x, q_z)
        N = intersect.normal(g_x, g_z)
        tau = distance / np.sqrt(dot(D, D))
        feet = (intersect.footprint(tau, D, N, self.delta_x), intersect.footprint(tau, D, N, self.delta_y))
        amount = np.zeros_like(x)
        lines = [] if scene.foam is None else [one for one in scene.foam.saturation if isinstance(one, SurfSaturation)]
        if scene.foam is not None and self.assets is not None and lines and lines[0].line > 0.0:
            filtered = scene.foam.look == "filtered"
            left = coast.left(lines[0], x, z, height, feet if filtered and self.filtering else None)
            f = np.minimum(left, 1.0 if filtered else CAP)
            still = np.zeros_like(x), np.zeros_like(x)
            amount = np.minimum(self._lying(scene.foam, self.assets, f, x, z, *feet, way=still), 1.0)
        if self.air is None or scene.light is None:
            return np.repeat(amount[:, None], 3, axis=1), amount
        colour = light.land(self.air, coast.albedo(q_x, q_z, *feet), coast.wet(height), d, unit(N))
        if scene.foam is not None:
            white = light.foam(self.air, scene.foam.albedo, unit(N))
            colour = colour + (white - colour) * amount[:, None]
        return light.haze(self.air, scene.light.visibility, colour, d, distance) * self._exposure, amount

    def _around(self, r: Floats) -> Floats:
        """Sky and land toward r (n, 3), seen from a metre over water or ground, right under the eye; (n, 3)."""
        coast, air = self.coast, self.air
        assert coast is not None
        assert air is not None
        assert self.scene.light is not None
        here = coast.place(np.zeros(1), np.zeros(1))
        height = AROUND_HEIGHT + max(0.0, float(coast.ground(*here)[0][0]))
        distance = intersect.land_crossing(coast.land, height, r, *coast.within(r))
        met = np.isfinite(distance)
        colour = np.empty_like(r)
        colour[~met] = air.mirrored(r[~met])
        if met.any():
            d, far = r[met], distance[met]
            colour[met] = self._land_light(coast, far[:, None] * d, d, far)
        return colour

    @property
    def _exposure(self) -> float:
        return 1.0 if self.scene.light is None else 2.0**self.scene.light.exposure

    def _surface(self, D: Floats, d: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Colour (r, 3) and foam amount (r,) where rays D meet the surface, ``distance`` metres away."""
        scene, air = self.scene, self.air
        x, z = d[:, 0] * distance, d[:, 2] * distance
        H = self.relief.height(x, z)
        met, (h_x, h_z), (c_x, c_z) = self._slopes(x, z)
        N = intersect.normal(*met)
        a, f, past = np.zeros_like(x), None, None
        if scene.foam is not None and self.assets is not None:
            tau = distance / np.sqrt(dot(D, D))
            a, f = self._foam(scene.foam, self.assets, x, z, H, tau, D, N)
            if scene.foam.thickness > 0.0 and air is not None:
                past = self._past_foam(scene.foam, self.assets, air, a, f, x, z, tau, D, N)
        if air is None or scene.light is None:
            colour = np.repeat(np.minimum(a, 1.0)[:, None], 3, axis=1)
        else:
            n = unit(intersect.normal(h_x + c_x, h_z + c_z))
            bed = None
            if self.coast is not None:
                tau = distance / np.sqrt(dot(D, D))
                feet = (intersect.footprint(tau, D, N, self.delta_x), intersect.footprint(tau, D, N, self.delta_y))
                bed = self.coast.bed(x, z, H, d, n, *feet)
            lit = None
            if self.bed is not None and scene.water.depth is not None:
                tau = distance / np.sqrt(dot(D, D))
                feet = (intersect.footprint(tau, D, N, self.delta_x), intersect.footprint(tau, D, N, self.delta_y))
                lit = self.bed.seen(x, z, H, d, n, feet)
            place = np.stack((x, H, z), axis=-1)
            colour = light.water(
                air,
                scene.water,
                (self.relief.trough, self.relief.top),
                d,
                n,
                H,
                bed,
                mirrored=lambda r: self._mirror(place, r),
                sun=self.sun,
                lit=lit,
                saturation=f,
                past=None if past is None else past[0],
            )
            if scene.foam is not None:
                stiff = unit(intersect.normal(h_x + 0.5 * c_x, h_z + 0.5 * c_z))
                white = light.foam(air, scene.foam.albedo, stiff, None if past is None else past[1])
                colour = self._laid(colour, white, a)
            colour = light.haze(air, scene.light.visibility, colour, d, distance) * self._exposure
        return colour, np.minimum(a, 1.0)

    def _foam(
        self, foam: Foam, assets: Assets, x: Floats, z: Floats, H: Floats, tau: Floats, D: Floats, N: Floats
    ) -> tuple[Floats, Floats]:
        """At r places the look's foam amount, in [0, 3] for ``listing``, else in [0, 1], and f; (r,) each."""
        foot_x = intersect.footprint(tau, D, N, self.delta_x)
        foot_y = intersect.footprint(tau, D, N, self.delta_y)
        filtered = foam.look == "filtered"
        coast, wakes = self.coast, self.wakes
        feet = (foot_x, foot_y) if filtered and self.filtering else None
        f = saturation(
            foam.saturation,
            foam.combine,
            self.fronts,
            lambda x, z: self._slopes(x, z)[1],
            x,
            z,
            H,
            cap=1.0 if filtered else CAP,
            footprints=feet,
            eye_height=self.eye_y,
            level=self.waves.level,
            folds=[
                fold_saturation(self.scene, source, self.sea, x, z)
                for source in foam.saturation
                if isinstance(source, FoldSaturation)
            ],
            surf=None if coast is None else lambda source, x, z, H: coast.foam(source, x, z, H, feet),
            drift=self._drifting,
            wake=None if wakes is None else lambda source, x, z, cap: wakes.foam(source, x, z, cap, feet),
            history=History(foam_drift(self.scene), self._carries),
        )
        return self._lying(foam, assets, f, x, z, foot_x, foot_y), f

    def _past_foam(
        self,
        foam: Foam,
        assets: Assets,
        air: light.Air,
        amount: Floats,
        f: Floats,
        x: Floats,
        z: Floats,
        tau: Floats,
        D: Floats,
        N: Floats,
    ) -> tuple[Floats, Floats]:
        """What foam beside r places leaves of the sun to their water, and times how much it lights their foam."""
        feet = [intersect.footprint(tau, D, N, delta) for delta in (self.delta_x, self.delta_y)]
        sides = [np.maximum(np.hypot(foot[:, 0], foot[:, 1]), 1e-6) for foot in feet]
        way = foam.thickness / max(float(air.sun[1]), LOWEST_SHADE) * air.sun[[0, 2]]
        near = 1.0 - smoothstep(0.25, 1.0, np.maximum(*sides) / max(float(np.hypot(*way)), 1e-6))
        near = FOAM_SHADE * np.where(f > 0.0, near, 0.0)
        soft_x, soft_y = (
            foot * np.maximum(1.0, 0.5 * foam.thickness / side)[:, None] for foot, side in zip(feet, sides, strict=True)
        )
        there = self._lying(foam, assets, f, x, z, soft_x, soft_y, (way[0], way[1]), octaves=1)
        beside = near * np.minimum(there, 1.0)
        return 1.0 - beside, 1.0 + near * np.minimum(amount, 1.0) - beside

    def _lying(
        self,
        foam: Foam,
        assets: Assets,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        beside: tuple[float, float] = (0.0, 0.0),
        way: tuple[Floats, Floats] | None = None,
        octaves: int = OCTAVES_MOST,
    ) -> Floats:
        """The look's foam amount at r places of the water, or (x, z) m beside them, wherever its mask lies; (r,).

        ``way``: to where it rests, m; absent: as the waves carry it. ``octaves``: of the mask at most.
        """
        if foam_life(self.scene) is not None:
            rests = self._carry(x, z) if way is None else way
            return self._living(foam, assets, f, x, z, foot_x, foot_y, beside, rests, octaves)
        x, z = x + beside[0], z + beside[1]
        carried = self._carried(foam, x, z)
        if not carried:
            return self._look(foam, assets, f, x, z, foot_x, foot_y, octaves)
        free = np.ones_like(x)
        for copy in carried:
            part = cells.part(f, copy.weight)
            turned = copy.turned(foot_x), copy.turned(foot_y)
            amount = self._look(foam, assets, part, copy.x, copy.z, *turned, octaves)
            free *= np.where(copy.weight > 0.0, 1.0 - amount, 1.0)
        return 1.0 - free

    def _living(
        self,
        foam: Foam,
        assets: Assets,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        beside: tuple[float, float],
        way: tuple[Floats, Floats],
        octaves: int,
    ) -> Floats:
        """The same where foam lives: carried, gathered, its masks by its age."""
        held = np.clip(f, 0.0, 1.0)
        s = looks.faded(held, foam.fade) if foam.octaves > 1 else held
        # Between samples nothing tells rows apart that the filter takes out: the truth has all of them.
        s = living.gathered(self.scene, self.time, self.origin, s, x, z)
        l_x, l_z = x + way[0] + beside[0], z + way[1] + beside[1]
        u, v = _turned(l_x, l_z, foam, (0.0, 0.0))
        at = living.drifted(self.scene, self.time, self.origin)
        feet = _turned_steps(foot_x, foam), _turned_steps(foot_y, foam)
        t = self._texture(foam, assets, l_x, l_z, foot_x, foot_y)
        free = np.ones_like(x)
        masks = (assets, *assets.older)
        for one in living.shares(len(masks), s, held):
            own = np.flatnonzero(one.weight > 0.0)
            covered = coverage(
                foam,
                masks[one.mask],
                one.s[own],
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

    @property
    def _carries(self) -> bool:
        life = foam_life(self.scene)
        return life is not None and life.carried

    def _carry(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """From (x, z) to where the water that is there rests, m; (r,) each."""
        way_x, way_z = np.zeros_like(x), np.zeros_like(x)
        if not self._carries:
            return way_x, way_z
        for part in (self.waves, self.sea):
            if part is not None:
                more_x, more_z = part.carry(x, z)
                way_x, way_z = way_x + more_x, way_z + more_z
        return (way_x, way_z) if self.coast is None else self.coast.carry((way_x, way_z), x, z)

    def _look(
        self,
        foam: Foam,
        assets: Assets,
        f: Floats,
        x: Floats,
        z: Floats,
        foot_x: Floats,
        foot_y: Floats,
        octaves: int,
    ) -> Floats:
        """The look's foam amount at r places of its mask and texture under footprints (r, 2) m; (r,)."""
        filtered = foam.look == "filtered"
        t = self._texture(foam, assets, x, z, foot_x, foot_y)
        if foam.look == "textured":
            return looks.textured(f, t)
        feet = _turned_steps(foot_x, foam), _turned_steps(foot_y, foam)
        if foam.cells and foam_life(self.scene) is None:
            free = np.ones_like(x)
            for corner in cells.corners(*cells.counted(x, z, foam, self.origin), filtered):
                own = np.flatnonzero(corner.weight > 0.0)
                turned = corner.turned(feet[0])[own], corner.turned(feet[1])[own]
                part = cells.part(f[own], corner.weight[own]) if filtered else f[own]
                here = corner.u[own], corner.v[own]
                free[own] *= 1.0 - self._amount(foam, assets, part, t[own], *here, turned, octaves)
            return 1.0 - free
        return self._amount(foam, assets, f, t, *_turned(x, z, foam, self.origin), feet, octaves)

    def _carried(self, foam: Foam, x: Floats, z: Floats) -> list[Copy]:
        """The copies of the mask that a flow carries; none where it lies still."""
        sources = [one for one in foam.saturation if isinstance(one, DriftSaturation) and one.amount > 0.0]
        if not sources or self.scene.drift is None or foam.look != "filtered":
            return []
        return copies(self.scene, sources[0], foam.mask_tile, self.time, self.origin, x, z)

    def _drifting(self, source: DriftSaturation, x: Floats, z: Floats) -> Floats:
        return drift_saturation(self.scene, source, self.time, self.origin, x, z)

    def _amount(
        self,
        foam: Foam,
        assets: Assets,
        f: Floats,
        t: Floats,
        u: Floats,
        v: Floats,
        feet: tuple[Floats, Floats],
        octaves: int,
    ) -> Floats:
        """The amount of a masked look at places (u, v) of the mask, footprints ``feet`` in its tiles; (r,)."""
        if foam.look == "filtered":
            covered = coverage(foam, assets, f, u, v, *feet, filtering=self.filtering, octaves=octaves)
            return looks.thinned(covered, t, foam.texture)
        m = sampling.nearest(assets.thresholds, u, v)
        if foam.look == "halftone":
            return looks.halftone(f, m)
        if foam.look == "fading":
            return looks.fading(f, m)
        return looks.halftone_textured(f, m, t) if foam.look == "halftone_textured" else looks.listing(f, m, t)

    def _texture(self, foam: Foam, assets: Assets, x: Floats, z: Floats, foot_x: Floats, foot_y: Floats) -> Floats:
        if foam.look not in TEXTURED_LOOKS and not (foam.look == "filtered" and foam.texture > 0.0):
            return np.ones_like(x)
        first = self._texture_copy(foam.texture_tile, False, assets, x, z, foot_x, foot_y)
        if foam.texture_second is None:
            return first
        return 0.5 * (first + self._texture_copy(foam.texture_second, True, assets, x, z, foot_x, foot_y))

    def _texture_copy(
        self, tile: float, swapped: bool, assets: Assets, x: Floats, z: Floats, foot_x: Floats, foot_y: Floats
    ) -> Floats:
        u = _tiles(self.origin[0], tile) + x / tile
        v = _tiles(self.origin[1], tile) + z / tile
        if swapped:
            u, v = v, u
        if not self.filtering:
            return sampling.bilinear(assets.texture[0], u, v)
        level = sampling.footprint_level(foot_x / tile, foot_y / tile, assets.texture[0].shape[0])
        return sampling.trilinear(assets.texture, u, v, level)


def coverage(
    foam: Foam,
    assets: Assets,
    s: Floats,
    u: Floats,
    v: Floats,
    foot_u: Floats,
    foot_v: Floats,
    *,
    filtering: bool,
    shares: bool = False,
    octaves: int = OCTAVES_MOST,
) -> Floats:
    """The share that the filtered look covers at places (u, v) of its mask, 1 a tile, saturation s in [0, 1]; (r,).

    With ``filtering`` under footprints (r, 2), else in the limit of infinitely many samples. ``shares``: s is what is
    covered in the mean already, not the saturation that the fade makes it of. ``octaves``: no more of the foam's.
    """
    if foam.octaves == 1:
        if filtering:
            return covered(assets, s, u, v, foot_u, foot_v, foam.fade)
        b = sampling.bspline(assets.thresholds, u, v).value
        return looks.converged_coverage(s, b, assets.quantiles[0], foam.fade)
    left = s if shares else looks.faded(s, foam.fade)
    for number in range(min(foam.octaves, octaves)):
        if filtering:
            size = np.hypot(foot_u, foot_v) * assets.thresholds.shape[0]
            shown = looks.octave_shown(size) if number else np.ones_like(s)
            own = covered(assets, left, u, v, foot_u, foot_v, None)
            left = left + shown * (own - left)
        else:
            b = sampling.bspline(assets.thresholds, u, v).value
            threshold, width = (sampling.quantile(assets.ramps[row], left) for row in (0, -1))
            left = looks.converged_octave(left, b, threshold, width)
        u, v = looks.octave(u, v)
        foot_u, foot_v = (np.stack(looks.octave(foot[:, 0], foot[:, 1]), axis=-1) for foot in (foot_u, foot_v))
    return left


def covered(
    assets: Assets, s: Floats, u: Floats, v: Floats, foot_u: Floats, foot_v: Floats, fade: float | None
) -> Floats:
    """A(s) of the mask at places (u, v), 1 a tile, under footprints (r, 2); (r,). ``fade`` None: an octave's ramp."""
    # The sides of the box that has the footprint's variance along the mask's axes.
    size = np.hypot(foot_u, foot_v) * assets.thresholds.shape[0]
    minified, magnified = np.zeros_like(s), np.zeros_like(s)
    w = looks.minification(size)
    far, near = np.flatnonzero(w > 0.0), np.flatnonzero(w < 1.0)
    tables, ramp = (assets.ramps[1:-1], looks.OCTAVE_RAMP) if fade is None else (assets.quantiles[1:], fade)
    minified[far] = looks.minified_coverage(s[far], u[far], v[far], size[far], assets.spans, tables, ramp)
    b, e = looks.spline_over_footprint(
        sampling.bspline(assets.thresholds, u[near], v[near]), foot_u[near], foot_v[near]
    )
    if fade is None:
        threshold, width = (sampling.quantile(assets.ramps[row], s[near]) for row in (0, -1))
    else:
        threshold = sampling.quantile(assets.quantiles[0], s[near])
        width = looks.spline_fade(assets.quantiles[0], s[near], fade)
    magnified[near] = looks.magnified_coverage(b, e, threshold, width)
    return looks.filtered_coverage(s, minified, magnified, size, whole=fade is None or fade == 0.0)


def _tiles(position: float, tile: float) -> float:
    """Place of a position in its tile, in (−1, 1) tiles, exact before the division."""
    return math.fmod(position, tile) / tile


def _turned(x: Floats, z: Floats, foam: Foam, origin: tuple[float, float]) -> tuple[Floats, Floats]:
    """Mask coordinates (u, v) of places x, z from the origin; (r,) each, 1 a tile."""
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    tile = foam.mask_tile
    u = (x * cosine + z * sine) / tile + _tiles(origin[0] * cosine + origin[1] * sine, tile)
    v = (z * cosine - x * sine) / tile + _tiles(origin[1] * cosine - origin[0] * sine, tile)
    return u, v


def _turned_steps(foot: Floats, foam: Foam) -> Floats:
    """A footprint (r, 2) m in mask coordinates; (r, 2), 1 a tile."""
    cosine, sine = math.cos(foam.mask_angle), math.sin(foam.mask_angle)
    x, z = foot[:, 0], foot[:, 1]
    result: Floats = np.stack((x * cosine + z * sine, z * cosine - x * sine), axis=-1) / foam.mask_tile
    return result
