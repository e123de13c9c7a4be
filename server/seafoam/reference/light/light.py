"""Sections 6 and 7: sun, sky, water body, foam and haze, tone curves, and the sRGB curve of displays.

Colours are linear RGB along the last axis, directions unit vectors (x, y, z) along the last axis.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from seafoam.ocean.constants import WATER_INDEX
from seafoam.reference.light import atmosphere
from seafoam.reference.light.clouds import FORWARD
from seafoam.reference.shore.soil import Soil
from seafoam.reference.types import Bounds, Floats, Pair, Vec3, WaterSamples, dot, henyey_greenstein, smoothstep, unit
from seafoam.scene import FoamScattering, Light, ToneCurve, Water

AIR_MASS_OFFSET, VIEW_AIR_MASS_OFFSET = 0.03, 0.09
"""Of M = 1/(max(y, 0) + offset), the air mass of the sun's light and of view rays of height y, less at the horizon."""
SUN_POWER = 20.0
SUN_RISE = 0.02
TWILIGHT = 12.0
NIGHT = 0.002
FLAT_SHARE = 0.04
SUN_SOLID_ANGLE = 6.8e-5
DISC_INNER = 0.0045
DISC_OUTER = 0.0055
ENTERS = 0.95  # share of the light from above that enters the water
BACKSCATTER = 0.4
CREST_PATH = 6.0
LAKE_COLOUR: Floats = np.array([0.98, 0.97, 0.7])
LAKE_STRENGTH = 0.6
GLITTER_MOST = 1e4
FOAM_FORWARD = 0.75
"""Asymmetry of the phase function of foam, a lumpy layer of bubbles that scatters the sun's light forward."""
LUMPS_LEAST = 1e-3  # least mean cosine of lumps


@dataclass(frozen=True)
class Air:
    """A light, evaluated for its sun: all that is independent of rays."""

    sun: Floats  # S, (3,) unit vector to the sun
    mie: float
    depth: Floats  # τ, (3,) optical depth at the zenith
    sun_irradiance: Floats  # E_s, (3,)
    air_light: Floats  # E_a, (3,)
    above: atmosphere.LayeredSky | None = None  # the layered sky of section 9, if the scene has one

    def sky(self, d: Floats) -> Floats:
        """Radiance toward d, without the sun's disc; (..., 3). Directions below the horizon have its air mass."""
        if self.above is not None:
            return self.above.seen(d)
        gamma = dot(d, self.sun)[..., None]
        air_mass = 1.0 / (np.maximum(d[..., 1], 0.0) + VIEW_AIR_MASS_OFFSET)[..., None]
        rayleigh = atmosphere.RAYLEIGH * (3.0 / (16.0 * math.pi)) * (1.0 + gamma * gamma)
        mie = self.mie * henyey_greenstein(FORWARD, gamma)
        scattered = (rayleigh + mie) / self.depth + FLAT_SHARE
        return self.air_light * scattered * (1.0 - np.exp(-self.depth * air_mass))

    def mirrored(self, d: Floats, spread: Pair) -> Floats:
        """The sky toward directions about d (r, 3), blurred as :data:`Mirror` says if it is layered; (r, 3)."""
        return self.sky(d) if self.above is None else self.above.mirrored(d, spread)

    @property
    def sky_irradiance(self) -> Floats:
        """E_sky, (3,): the sky's light on level ground."""
        if self.above is not None:
            return self.above.irradiance
        return _sky_irradiance(tuple(self.sun.tolist()), self.mie)


def air(light: Light, time: float = 0.0, eye: Vec3 = (0.0, 0.0, 0.0)) -> Air:
    """The air under a light at a time (s) around a camera position (m)."""
    plain = _air(atmosphere.to_sun(light), atmosphere.mie_depth(light))
    if light.sky is None:
        return plain
    above = atmosphere.LayeredSky(light, light.sky, time, eye)
    return replace(plain, sun=above.lit_by, sun_irradiance=above.direct, above=above)


def sun_disc(air: Air, d: Floats) -> Floats:
    """Radiance of the sun's disc toward d; (..., 3)."""
    away = d - air.sun
    inside = 1.0 - smoothstep(DISC_INNER**2, DISC_OUTER**2, dot(away, away))
    return np.minimum(air.sun_irradiance / SUN_SOLID_ANGLE, atmosphere.DISC_MOST) * inside[..., None]


def fresnel(c: Floats) -> Floats:
    """Unpolarised Fresnel reflectance of water, index 1.34, at the cosine c in [0, 1]; in [0, 1]."""
    q = np.sqrt(WATER_INDEX**2 - 1.0 + c * c)
    first = (q - c) / (q + c)
    second = (c * (q + c) - 1.0) / (c * (q - c) + 1.0)
    return 0.5 * first * first * (1.0 + second * second)


def sky_light(air: Air, up: Floats) -> Floats:
    """E_sky(½ + ½ n.y) on ground whose unit normal has the vertical component ``up`` (...,); (..., 3)."""
    return air.sky_irradiance * (0.5 + 0.5 * up)[..., None]


Share = Floats | float  # a share of the sunlight at each of r places (r,), or one of all
Mirror = Callable[[Floats, Pair], Floats]
"""Light (r, 3) from directions about (r, 3), of standard deviations (r,) up and down, and aside, rad."""
Glint = Callable[[Floats, Floats, Floats, float], Floats]
"""Reflection of the sun (r, 3) from d, n, cv and σ², the arguments of :func:`glint`."""


Floor = Callable[[Floats, Floats, Floats], Floats]
"""Light (r, 3) of the ground under places on the water and of the water before it, from the extinction (3,) 1/m, the
light (r, 3) of water without end, and the irradiance (r, 3) that enters."""


def plain_floor(path: Floats, albedo: Floats) -> Floor:
    """A floor that light reaches as through level water, ``path`` (r,) m down and back; albedo (r, 3) or (3,)."""

    def seen(extinction: Floats, deep: Floats, down: Floats) -> Floats:
        left = np.exp(-extinction * path[:, None])
        return deep * (1.0 - left) + albedo * down / math.pi * left

    return seen


def lit_floor(radiance: Floats, path: Floats, depth: Floats) -> Floor:
    """A floor at a depth (r,) m with its own lighting, (r, 3), ``path`` (r,) m below along the ray."""

    def seen(extinction: Floats, deep: Floats, down: Floats) -> Floats:
        scattered = deep * (1.0 - np.exp(-extinction * (path + depth)[:, None]))
        return scattered + radiance * np.exp(-extinction * path[:, None])

    return seen


@dataclass(frozen=True, eq=False)
class WaterHit:
    """Where r rays meet the water, and the light that reaches these places."""

    at: WaterSamples
    bounds: Bounds  # of the whole surface
    floor: Floor | None  # None: level, at the depth of the scene's water, or none if it has no depth
    saturation: Floats | None  # (r,) of foam, whose bubbles make the water milky
    sun: Floats  # (r,) what all that throws shadows leaves of the sun
    sun_past_foam: Floats  # (r,) what foam beside a place leaves too
    mirrored: Mirror  # light that is reflected
    glint: Glint


def water(air: Air, body: Water, hit: WaterHit) -> Floats:
    """Radiance of the water toward the camera, before haze; (r, 3)."""
    d, n, sigma2 = hit.at.d, hit.at.normal, body.roughness**2
    nv = np.maximum(-dot(n, d), 0.0)
    cv = np.sqrt(nv * nv + sigma2 * (1.0 - nv * nv))
    mirror = fresnel(cv)[:, None]
    entering = ENTERS * (_direct(air, n, hit.sun_past_foam) + sky_light(air, n[:, 1]))
    within = _body(body, entering, cv, hit)
    if hit.saturation is not None and body.aeration > 0.0:
        within = _aerated(body, entering, cv, within, hit.saturation)
    sun = _column(hit.sun)
    inner = (1.0 - mirror) * (within + sun * _crest(air, body, hit))
    # A slope turns the reflected ray by twice its angle; across the plane of incidence less, as the look is flatter.
    spread = np.full(cv.shape, math.sqrt(2.0 * sigma2)), math.sqrt(2.0 * sigma2) * cv
    return inner + mirror * hit.mirrored(_reflected(d, n, sigma2), spread) + sun * hit.glint(d, n, cv, sigma2)


def foam(air: Air, albedo: float, N: Floats, sun: Share = 1.0) -> Floats:
    """Radiance of foam of unit normals N (r, 3), before haze, ``sun`` of its sunlight left; (r, 3)."""
    return albedo / math.pi * (_direct(air, N, sun) + sky_light(air, N[:, 1]))


def lumpy_cosine(c: Floats, roughness: float) -> Floats:
    """Mean cosine, 0 where negative, over lumps of the root mean square slope ``roughness`` about the cosine c."""
    return np.maximum(0.5 * (c + np.sqrt(c * c + 2.0 / math.pi * roughness**2)), LUMPS_LEAST)


def foam_layer(
    air: Air, scattering: FoamScattering, albedo: float, n: Floats, d: Floats, f: Floats, sun: Share = 1.0
) -> Pair:
    """Radiance (r, 3) before haze of foam of saturation f (r,) and normals n along rays d, and its opacity (r,)."""
    toward_eye = lumpy_cosine(-dot(n, d), scattering.roughness)
    toward_sun = lumpy_cosine(dot(n, air.sun), scattering.roughness)
    depth = scattering.optical_depth * np.clip(f, 0.0, 1.0)
    opacity = depth / (depth + 2.0 * toward_eye)
    phase = henyey_greenstein(FOAM_FORWARD, d @ air.sun)
    matt = (1.0 - scattering.forward) / math.pi
    scattered = toward_sun * (matt + scattering.forward * phase / (toward_sun + toward_eye)) * sun
    light = air.sun_irradiance * scattered[:, None] + sky_light(air, n[:, 1]) / math.pi
    result: Floats = albedo * opacity[:, None] * light
    return result, opacity


def land(air: Air, soil: Soil, d: Floats, level: Floats, sun: Share = 1.0) -> Floats:
    """Radiance of land before haze along d; (r, 3). ``level``: normals without detail. Unit vectors (r, 3)."""
    nv = np.maximum(-dot(level, d), 0.0)
    cv = np.sqrt(nv * nv + soil.roughness2 * (1.0 - nv * nv))
    mirror = soil.film * fresnel(cv)
    bare = foam(air, 1.0, soil.normal, sun) * soil.albedo
    result: Floats = bare + mirror[:, None] * (air.sky(_reflected(d, level, soil.roughness2)) - bare)
    if soil.glints:
        result = result + (soil.film * sun)[:, None] * glint(air, d, level, cv, soil.roughness2)
    return result


def haze(air: Air, visibility: float, L: Floats, d: Floats, distance: Floats) -> Floats:
    """L (r, 3) seen through (r,) m of air along d (r, 3): blended toward the sky at the horizon, or deep haze; (r, 3).

    For vertical rays, which have no horizon ahead, the horizon's direction is the zero vector.
    """
    if air.above is None:
        through = np.exp(-atmosphere.CONTRAST * distance / visibility)[:, None]
        behind = air.sky(unit(d * np.array([1.0, 0.0, 1.0])))
    else:
        through, behind = air.above.passed(distance), air.above.before(d)
    return L * through + behind * (1.0 - through)


def _air(sun: Floats, mie: float) -> Air:
    depth = atmosphere.RAYLEIGH + mie
    height = sun[1]
    path = depth * (1.0 / (np.maximum(height, 0.0) + AIR_MASS_OFFSET))
    return Air(
        sun=sun,
        mie=mie,
        depth=depth,
        sun_irradiance=SUN_POWER * np.exp(-path) * smoothstep(-SUN_RISE, SUN_RISE, height),
        air_light=SUN_POWER * np.exp(-0.5 * path) * math.exp(TWILIGHT * min(float(height), 0.0)) + NIGHT,
    )


@lru_cache(maxsize=64)
def _sky_irradiance(sun: tuple[float, ...], mie: float) -> Floats:
    return atmosphere.over_hemisphere(_air(np.array(sun), mie).sky)


def _column(share: Share) -> Floats:
    return np.asarray(share, np.float64)[..., None]


def _direct(air: Air, n: Floats, sun: Share) -> Floats:
    """Irradiance (r, 3) of the sun on surfaces of unit normals n (r, 3)."""
    return air.sun_irradiance * np.maximum(dot(n, air.sun), 0.0)[:, None] * _column(sun)


def _body(body: Water, down: Floats, cv: Floats, hit: WaterHit) -> Floats:
    """L_body: light scattered back by the water and its floor from the irradiance ``down`` (r, 3); (r, 3)."""
    extinction = 1.0 / np.array(body.absorption_length) + body.scattering
    deep: Floats = BACKSCATTER * body.scattering / extinction * down / math.pi
    floor = hit.floor
    if floor is None:
        if body.depth is None:
            return deep
        path = np.maximum(body.depth + hit.at.height, 0.0) * (1.0 + 1.0 / _refracted_cosine(cv))
        floor = plain_floor(path, np.array(body.floor_albedo))
    return floor(extinction, deep, down)


def _refracted_cosine(c: Floats) -> Floats:
    return np.sqrt(1.0 - (1.0 - c * c) / WATER_INDEX**2)


def _aerated(body: Water, entering: Floats, cv: Floats, clear: Floats, saturation: Floats) -> Floats:
    """L_body under foam of a saturation (r,): a layer of bubbles in front of the light of ``clear`` water; (r, 3)."""
    absorption = 1.0 / np.array(body.absorption_length)
    path = body.plume_depth * np.clip(saturation, 0.0, 1.0) * (1.0 + 1.0 / _refracted_cosine(cv))
    down = entering / math.pi

    def layer(scattering: float) -> Floats:
        """Light scattered back by a layer of water of this scattering coefficient; (r, 3)."""
        extinction = absorption + scattering
        return BACKSCATTER * scattering / extinction * down * (1.0 - np.exp(-extinction * path[:, None]))

    below = (clear - layer(body.scattering)) * np.exp(-body.aeration * path)[:, None]
    return np.maximum(layer(body.scattering + body.aeration) + below, 0.0)


def _crest(air: Air, body: Water, hit: WaterHit) -> Floats:
    """L_t: sunlight transmitted by thin crests; (r, 3)."""
    trough, top = hit.bounds.trough, hit.bounds.top
    if top <= trough:
        return np.zeros_like(hit.at.d)
    toward = np.maximum(hit.at.d[:, 0] * air.sun[0] + hit.at.d[:, 2] * air.sun[2], 0.0)
    share = body.translucency / math.pi * ((hit.at.height - trough) / (top - trough)) ** 2 * toward
    result: Floats = share[:, None] * air.sun_irradiance * np.exp(-CREST_PATH / np.array(body.absorption_length))
    return result


def _reflected(d: Floats, n: Floats, sigma2: float) -> Floats:
    """Directions of reflection, raised by the roughness; (r, 3) unit vectors."""
    r = d - 2.0 * dot(d, n)[:, None] * n
    r[:, 1] = np.sqrt(np.maximum(r[:, 1], 0.0) ** 2 + sigma2)
    return unit(r)


def glint(air: Air, d: Floats, n: Floats, cv: Floats, sigma2: float) -> Floats:
    """L_s: reflection of the sun by roughness below the scale of ripples (Beckmann slopes); (r, 3)."""
    h = unit(air.sun - d)
    nh2 = np.maximum(dot(n, h), 1e-3) ** 2
    slopes = np.exp(-(1.0 - nh2) / (nh2 * sigma2)) / (math.pi * sigma2 * nh2 * nh2 * 4.0 * cv)
    mirrored = fresnel(np.maximum(dot(h, air.sun), 0.0)) * slopes
    # S = d gives h = 0: no facet reflects the sun straight ahead.
    mirrored = np.where((h == 0.0).all(axis=-1), 0.0, mirrored)
    return np.minimum(air.sun_irradiance * mirrored[:, None], GLITTER_MOST)


def blinn_phong(air: Air, power: float, perturb: float, d: Floats, n: Floats, cv: Floats, sigma2: float) -> Floats:
    """The lake's highlight: around a half vector moved by the normal's tilt; (r, 3), independent of roughness."""
    h = unit(air.sun - d + perturb * n * np.array([1.0, 0.0, 1.0]))
    shine: Floats = np.power(np.clip(dot(n, h), 0.0, 1.0), power)
    return air.sun_irradiance / math.pi * LAKE_STRENGTH * LAKE_COLOUR * shine[:, None]


def tone(x: Floats, curve: ToneCurve = "filmic") -> Floats:
    """The tone curve of linear light x ≥ 0 (..., 3), in [0, 1]; of the shape of ``x``. ``curve``: ``light.tone``."""
    if curve == "filmic":
        return np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)
    # Photographic: with a long shoulder.
    squares = (x * x).sum(axis=-1, keepdims=True)
    norm = (x**3).sum(axis=-1, keepdims=True) / np.maximum(squares, 1e-12)
    level = _shoulder(norm)
    hue: Floats = np.maximum(1.0 + 1.2 * (x / np.maximum(norm, 1e-6) - 1.0), 0.0)
    return np.clip(level * hue + level * level * (_shoulder(x) - level * hue), 0.0, 1.0)


def _shoulder(x: Floats) -> Floats:
    return np.minimum(1.01 * x * (x + 0.02) / (x * (x + 0.42) + 0.05), 1.0)


def srgb(x: Floats) -> Floats:
    """The sRGB curve of linear light in [0, 1]; of the shape of ``x``."""
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 0.0031308) ** (1.0 / 2.4) - 0.055)
