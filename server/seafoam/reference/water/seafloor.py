"""Section 11: a level floor seen along refracted rays, caustics on it by photon tracing, and the view from below.

The caustic map's texels and the bilinear interpolation between them are part of the model; the reference uses the map
of the ``reference`` quality. Photons enter on a regular grid over a tile; each is distributed by the uniform cubic
B-spline over the texels around the point where it lands.
"""

import math
from functools import lru_cache

import numpy as np

from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves.ripples import ripple_cascades, tiles
from seafoam.reference.light.light import BACKSCATTER, ENTERS, GLITTER_MOST, Air, Floor, air, fresnel, lit_floor
from seafoam.reference.noise import chained, share
from seafoam.reference.sampling import bilinear, spline
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats, Footprints, Pair, Sunlight, Vec2, dot, unit
from seafoam.reference.waves.parametric import afloat, reduced
from seafoam.scene import Ripples, Scene, Water

MAP = 512  # texels along a side of the caustic map
PHOTONS = 1024
"""Photons along a side of the tile: the map's root mean square error is a thousandth of the mean light."""
COLOURS = (-0.0033, 0.0, 0.0042)
"""Refractive index of red, green and blue minus that of green (Daimon and Masumura 2007)."""
LEAST_FALL = 0.25
LEAST_SUN = 0.05
JOINT = 0.05
TILE_KEY = 0x9E3779B9
JOINT_ALBEDO = 0.72
TILES_APART = 256
NARROWEST = 1e-3
FOAM_THROUGH = 0.5
FARTHEST = 1e6  # upper limit of distances to the floor, m


def refracted(d: Floats, n: Floats, index: float = WATER_INDEX) -> Floats:
    """Directions in water of d (..., 3) in air, refracted at normals n (..., 3); unit vectors."""
    c = np.maximum(-dot(d, n), 0.0)[..., None]
    return d / index + (c / index - np.sqrt(1.0 - (1.0 - c * c) / index**2)) * n


def landing(air_: Air, depth: float, h_x: Floats, h_z: Floats, index: float) -> tuple[Floats, Floats, Floats]:
    """Where sunlight that enters at slopes (h_x, h_z) lands, (x, z) m from its entry; and the transmitted share."""
    n = unit(np.stack((-h_x, np.ones_like(h_x), -h_z), axis=-1))
    ray = refracted(np.broadcast_to(-air_.sun, n.shape), n, index)
    path = depth / np.maximum(-ray[..., 1], LEAST_FALL)
    share = np.maximum(dot(n, air_.sun), 0.0) / (n[..., 1] * max(float(air_.sun[1]), LEAST_SUN))
    return ray[..., 0] * path, ray[..., 2] * path, share


def tile_slopes(ripples: Ripples, time: float, count: int) -> Pair:
    """Slopes of tiling ripples at the nodes of a tile's grid, (count, count) each, rows along z."""
    drawn = [wave for cascade in ripple_cascades(ripples, True) for wave in cascade]
    nodes = np.arange(count) * (tiles(True)[0] / count)
    phase = np.array([reduced((wave.omega, time), plus=wave.phase) for wave in drawn])
    kx, kz = np.array([wave.kx for wave in drawn]), np.array([wave.kz for wave in drawn])
    slope = np.array([wave.slope for wave in drawn]) / np.hypot(kx, kz)
    # cos(phase - kx x - kz z) is a sum of products of functions of x and of z.
    along = np.exp(-1j * np.outer(kx, nodes))
    across = np.exp(1j * (phase[:, None] - np.outer(kz, nodes)))
    both = [-((across * (slope * k)[:, None]).T @ along).real for k in (kx, kz)]
    return both[0], both[1]


@lru_cache(maxsize=8)
def photon_map(scene: Scene, time: float, texels: int = MAP, photons: int = PHOTONS) -> Floats:
    """Irradiance of the floor over that under level water, (texels, texels, 3), rows along z.

    Texel (0, 0) is at the tile's corner, displaced as green light under level water is.
    """
    light, ripples, depth = scene.light, scene.water.ripples, scene.water.depth or 0.0
    assert light is not None
    assert light.caustics is not None
    assert ripples is not None
    lighting = air(light)
    h_x, h_z = tile_slopes(ripples, time, photons)
    flat_x, flat_z = (float(part[0]) for part in landing(lighting, depth, np.zeros(1), np.zeros(1), WATER_INDEX)[:2])
    start = np.arange(photons) * (texels / photons)
    per_metre = texels / tiles(True)[0]
    sheets: list[Floats] = []
    for bent in COLOURS:
        if light.caustics.dispersion == 0.0 and sheets:
            sheets.append(sheets[0])
            continue
        x, z, share = landing(lighting, depth, h_x, h_z, WATER_INDEX + light.caustics.dispersion * bent)
        u = start[None, :] + (x - flat_x) * per_metre
        v = start[:, None] + (z - flat_z) * per_metre
        sheets.append(_splat(u.ravel(), v.ravel(), share.ravel() * (texels / photons) ** 2, texels))
    return np.stack(sheets, axis=-1)


def _splat(u: Floats, v: Floats, weight: Floats, texels: int) -> Floats:
    """Sum of weights, distributed by the cubic B-spline over a periodic grid of texels with centres at i + ½."""
    column, row = np.floor(u - 0.5).astype(np.int64), np.floor(v - 0.5).astype(np.int64)
    along, across = spline(u - 0.5 - column)[0], spline(v - 0.5 - row)[0]
    total = np.zeros(texels * texels)
    for j in range(4):
        line = ((row + j - 1) % texels) * texels
        for i in range(4):
            place = line + (column + i - 1) % texels
            total += np.bincount(place, weights=weight * along[i] * across[j], minlength=texels * texels)
    return total.reshape(texels, texels)


class Seabed:
    """The floor under a light, level or that of a coast, at one time around one origin."""

    def __init__(
        self, scene: Scene, air: Air, time: float, origin: Vec2, sunlight: Sunlight, coast: Coast | None
    ) -> None:
        water, light = scene.water, scene.light
        assert light is not None
        self.air, self.coast = air, coast
        self.water: Water = water
        self.depth = 1e6 if water.depth is None else water.depth
        self.origin = origin
        self.afloat = afloat(scene, time, origin)
        self.extinction = 1.0 / np.array(water.absorption_length) + water.scattering
        self.map: Floats | None = None
        self.unblocked = sunlight
        if light.caustics is not None and water.ripples is not None and water.depth is not None:
            self.map = photon_map(scene, time)
            flat = landing(air, water.depth, np.zeros(1), np.zeros(1), WATER_INDEX)
            self.flat = float(flat[0][0]), float(flat[1][0])

    def seen(self, x: Floats, z: Floats, H: Floats, d: Floats, n: Floats, footprints: Footprints) -> Floor:
        """The floor along rays d (r, 3) refracted at (x, z), where the surface has height H and normals n."""
        ray = refracted(d, n)
        down = np.maximum(self.depth + H, 0.0)
        path = down / np.maximum(-ray[:, 1], LEAST_FALL)
        radiance = self.light(x + path * ray[:, 0], z + path * ray[:, 2], down, footprints)
        return lit_floor(radiance, path, down)

    def light(self, x: Floats, z: Floats, down: Floats, footprints: Footprints) -> Floats:
        """Radiance (r, 3) of the floor at (x, z), m from the origin, at a depth of ``down`` m."""
        if self.coast is not None:
            lit = np.ones((x.size, 3)) * self._reached(x, z, down, footprints)
            return self.lit(self.coast.albedo(*self.coast.place(x, z), footprints), lit, down)
        if self.water.depth is None:
            return np.zeros((x.size, 3))
        sunlight = self.sunlight(x, z) * self._reached(x, z, down, footprints)
        return self.lit(self.albedo(x, z, footprints), sunlight, down)

    def _reached(self, x: Floats, z: Floats, down: Floats, footprints: Footprints) -> Floats:
        """Share (r, 1) of the sunlight that shadows leave to the floor at (x, z), ``down`` m under level water."""
        lean = self.air.sun / (WATER_INDEX * math.sqrt(1.0 - (1.0 - float(self.air.sun[1]) ** 2) / WATER_INDEX**2))
        enters = np.stack((x + down * lean[0], np.zeros_like(x), z + down * lean[2]), axis=-1)
        return self.unblocked(enters, footprints)[:, None]

    def lit(self, albedo: Floats, sunlight: Floats, down: Floats) -> Floats:
        """Radiance (r, 3) of ground of an albedo (r, 3); ``sunlight`` (r, 3) is relative to that under level water."""
        upright = float(self.air.sun[1])
        slant = math.sqrt(1.0 - (1.0 - upright**2) / WATER_INDEX**2)
        sun = self.air.sun_irradiance * max(upright, 0.0) * np.exp(-self.extinction * (down / slant)[:, None])
        sky = self.air.sky_irradiance * np.exp(-self.extinction * down[:, None])
        return ENTERS / math.pi * albedo * (sun * sunlight + sky)

    def sunlight(self, x: Floats, z: Floats) -> Floats:
        """Sunlight over that under level water, (r, 3): the map, bilinear."""
        if self.map is None:
            return np.ones((x.size, 3))
        tile = tiles(True)[0]
        u = (x - self.flat[0] + math.fmod(self.afloat[0], tile)) / tile % 1.0
        v = (z - self.flat[1] + math.fmod(self.afloat[1], tile)) / tile % 1.0
        return np.stack([bilinear(sheet, u, v) for sheet in np.moveaxis(self.map, -1, 0)], axis=-1)

    def albedo(self, x: Floats, z: Floats, footprints: Footprints) -> Floats:
        """Reflectance (r, 3): uniform, or of tiles, with the share of joints in the footprint's bounding box."""
        bare = np.broadcast_to(np.array(self.water.floor_albedo), (x.size, 3))
        side = self.water.floor_tile
        if side is None:
            return bare
        open_share = np.ones_like(x)
        wide = np.zeros_like(x)
        cells = []
        for i, (position, start) in enumerate(((x, self.origin[0]), (z, self.origin[1]))):
            place = position / side + math.fmod(start, TILES_APART * side) / side
            width = np.maximum((np.abs(footprints[0][:, i]) + np.abs(footprints[1][:, i])) / side, NARROWEST)
            open_share *= 1.0 - (_joints(place + 0.5 * width) - _joints(place - 0.5 * width)) / width
            wide = np.maximum(wide, width)
            cells.append(np.floor(place).astype(np.int64) % TILES_APART)
        q = np.clip(wide - 0.5, 0.0, 1.0)
        shade = (share(chained(TILE_KEY, *cells)) - 0.5) * (1.0 - q * q * (3.0 - 2.0 * q))
        limited = np.clip(open_share, 0.0, 1.0)[:, None]
        return JOINT_ALBEDO * (1.0 - limited) + bare * (1.0 + 0.24 * shade)[:, None] * limited

    def glow(self, depth: Floats, fall: Floats, reach: Floats) -> Floats:
        """Light (r, 3) scattered along (r,) m of water from ``depth`` m on, that descend by ``fall`` a metre."""
        lit = ENTERS / math.pi * (self.air.sun_irradiance * max(float(self.air.sun[1]), 0.0) + self.air.sky_irradiance)
        deep = BACKSCATTER * self.water.scattering / self.extinction * lit
        both = np.maximum(1.0 + fall, 1e-12)[:, None]
        gone = -np.expm1(-self.extinction * both * reach[:, None]) / both
        return 2.0 * deep * np.exp(-self.extinction * np.maximum(depth, 0.0)[:, None]) * gone

    def reach(self, x: Floats, z: Floats, y: Floats, d: Floats) -> Floats:
        """Distance to the floor along rays d (r, 3) from (x, z) at heights y, m; (r,), at most FARTHEST."""
        if self.coast is not None:
            return self.coast.crossing(x, y, z, d, FARTHEST)
        if self.water.depth is None:
            return np.full_like(x, FARTHEST)
        return np.minimum(np.maximum(self.depth + y, 0.0) / np.maximum(-d[:, 1], 1e-6), FARTHEST)

    def below(self, x: Floats, z: Floats, y: Floats, d: Floats, reach: Floats, footprints: Footprints) -> Floats:
        """Light (r, 3) of floor and water along rays d (r, 3) from (x, z) at heights y to the floor."""
        down = np.maximum(-y - reach * d[:, 1], 0.0)
        bed = self.light(x + reach * d[:, 0], z + reach * d[:, 2], down, footprints)
        return bed * np.exp(-self.extinction * reach[:, None]) + self.glow(-y, -d[:, 1], reach)

    def underside(
        self, x: Floats, z: Floats, y: Floats, d: Floats, n: Floats, reach: Floats, footprints: Footprints
    ) -> Floats:
        """Light (r, 3) along −d, transmitted or totally reflected by the surface at (x, y, z)."""
        sigma2 = self.water.roughness**2
        nv = np.maximum(dot(n, d), 0.0)
        cv2 = np.minimum(nv * nv + sigma2 * (1.0 - nv * nv), 1.0)
        out2 = 1.0 - WATER_INDEX**2 * (1.0 - cv2)
        out = np.sqrt(np.maximum(out2, 0.0))
        mirror = np.where(out2 > 0.0, fresnel(out), 1.0)[:, None]
        through = WATER_INDEX * d + (out - WATER_INDEX * nv)[:, None] * n
        through[:, 1] = np.sqrt(np.maximum(through[:, 1], 0.0) ** 2 + sigma2)
        through = unit(through)
        away = through - self.air.sun
        spread = 0.5 * (WATER_INDEX - 1.0) ** 2 * sigma2
        lobe = np.exp(-dot(away, away) / (2.0 * spread)) / (2.0 * math.pi * spread)
        sun = self.air.sun_irradiance * np.minimum(lobe, GLITTER_MOST)[:, None]
        back = d - 2.0 * dot(d, n)[:, None] * n
        back[:, 1] = -np.sqrt(np.maximum(-back[:, 1], 0.0) ** 2 + sigma2)
        back = unit(back)
        far = self.reach(x, z, y, back)
        wider = (1.0 + far / np.maximum(reach, 1e-3))[:, None]
        down = self.below(x, z, y, back, far, (footprints[0] * wider, footprints[1] * wider))
        return (1.0 - mirror) * (self.air.sky(through) + sun) + mirror * down


def _joints(x: Floats) -> Floats:
    """Total width of the joints between 0 and x, in tiles."""
    whole = np.floor(x)
    return JOINT * whole + np.maximum(x - whole - (1.0 - JOINT), 0.0)
