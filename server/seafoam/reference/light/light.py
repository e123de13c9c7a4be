"""Section 6: sun, sky, water body, foam and haze.

Colours are linear RGB along the last axis, directions unit vectors (x, y, z) along the last axis.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING

import numpy as np

from seafoam.reference.light.atmosphere import LayeredSky, layered_sky, sun_angles, two_looks
from seafoam.reference.types import Floats, dot, smoothstep, unit
from seafoam.scene.light import Light
from seafoam.scene.water import Water

if TYPE_CHECKING:
    from seafoam.reference.shore.soil import Soil

RAYLEIGH = np.array([0.055, 0.108, 0.215])
MIE_LEAST = 0.01
MIE_PER_TURBIDITY = 0.04
AIR_MASS_OFFSET = 0.03
VIEW_AIR_MASS_OFFSET = 0.09
SUN_POWER = 20.0
SUN_RISE = 0.02
TWILIGHT = 12.0
NIGHT = 0.002
FLAT_SHARE = 0.04
FORWARD = 0.76
SUN_SOLID_ANGLE = 6.8e-5
DISC_MOST = 3000.0
DISC_INNER = 0.0045
DISC_OUTER = 0.0055
INDEX = 1.34
ENTERS = 0.95
"""Share of the light from above that enters the water."""
BACKSCATTER = 0.4
CREST_PATH = 6.0
LAKE_COLOUR = np.array([0.98, 0.97, 0.7])
LAKE_STRENGTH = 0.6
GLITTER_MOST = 1e4
CONTRAST = 3.912
SKY_NODES = 192
SKY_TURNS = 384


@dataclass(frozen=True)
class Air:
    """A light, evaluated for its sun: all that is independent of rays."""

    sun: Floats
    """S, (3,) unit vector to the sun."""
    mie: float
    depth: Floats
    """τ, (3,) optical depth at the zenith."""
    sun_irradiance: Floats
    """E_s, (3,)."""
    air_light: Floats
    """E_a, (3,)."""
    above: LayeredSky | None = None
    """The layered sky of section 9, if the scene has one."""

    def sky(self, d: Floats) -> Floats:
        """sky(d) without the disc; (..., 3). Directions below the horizon have the horizon's air mass."""
        return sky(self, d) if self.above is None else self.above.seen(d)

    def mirrored(self, d: Floats, spread: tuple[Floats, Floats], unresolved: Floats | None = None) -> Floats:
        """The sky reflected by water toward directions about d (r, 3), with standard deviations (r,) up and down, and
        aside, rad; (r, 3).

        ``unresolved`` (r,): the deviation up and down by slopes that a sample does not resolve alone, by which the
        plain sky is blurred; default: 0, as in frames of the reference, which resolve all.
        """
        if self.above is not None:
            return self.above.mirrored(d, spread)
        if unresolved is None:
            return sky(self, d)
        high, low = two_looks(d, unresolved)
        result: Floats = 0.5 * (sky(self, high) + sky(self, low))
        return result

    @property
    def sky_irradiance(self) -> Floats:
        """E_sky, (3,): the sky's light on level ground."""
        if self.above is not None:
            return self.above.irradiance
        return _sky_irradiance(tuple(self.sun.tolist()), self.mie)


def air_mass(y: Floats) -> Floats:
    """M(y) = 1/(max(y, 0) + 0.03) of the height y of a unit direction."""
    result: Floats = 1.0 / (np.maximum(y, 0.0) + AIR_MASS_OFFSET)
    return result


def view_air_mass(y: Floats) -> Floats:
    """M_v(y) = 1/(max(y, 0) + 0.09): air mass along view rays, less at the horizon than for the sun's light."""
    result: Floats = 1.0 / (np.maximum(y, 0.0) + VIEW_AIR_MASS_OFFSET)
    return result


def air(light: Light, time: float = 0.0, eye: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Air:
    """The air under a light at a time (s) around a camera position (m)."""
    if light.day is None:
        azimuth, elevation = light.sun_azimuth, light.sun_elevation
    else:
        azimuth, elevation = sun_angles(light.day)
    sun = np.array(
        [
            math.cos(elevation) * math.cos(azimuth),
            math.sin(elevation),
            math.cos(elevation) * math.sin(azimuth),
        ]
    )
    plain = _air(sun, MIE_LEAST + MIE_PER_TURBIDITY * (light.turbidity - 1.0))
    above = layered_sky(light, time, eye)
    if above is None:
        return plain
    return replace(plain, sun=above.lit_by, sun_irradiance=above.direct, above=above)


def sky(of: Air, d: Floats) -> Floats:
    """Radiance of the sky toward d, without the sun's disc; (..., 3)."""
    gamma = dot(d, of.sun)[..., None]
    height = d[..., 1][..., None]
    rayleigh = RAYLEIGH * (3.0 / (16.0 * math.pi)) * (1.0 + gamma * gamma)
    mie = of.mie * (1.0 - FORWARD**2) / (4.0 * math.pi * (1.0 + FORWARD**2 - 2.0 * FORWARD * gamma) ** 1.5)
    scattered = (rayleigh + mie) / of.depth + FLAT_SHARE
    result: Floats = of.air_light * scattered * (1.0 - np.exp(-of.depth * view_air_mass(height)))
    return result


def sun_disc(of: Air, d: Floats) -> Floats:
    """Radiance of the sun's disc toward d; (..., 3)."""
    away = d - of.sun
    inside = 1.0 - smoothstep(DISC_INNER**2, DISC_OUTER**2, dot(away, away))
    result: Floats = np.minimum(of.sun_irradiance / SUN_SOLID_ANGLE, DISC_MOST) * inside[..., None]
    return result


def fresnel(c: Floats) -> Floats:
    """Unpolarised Fresnel reflectance of water, index 1.34, at the cosine c in [0, 1]; in [0, 1]."""
    q = np.sqrt(INDEX**2 - 1.0 + c * c)
    first = (q - c) / (q + c)
    second = (c * (q + c) - 1.0) / (c * (q - c) + 1.0)
    result: Floats = 0.5 * first * first * (1.0 + second * second)
    return result


def sky_light(of: Air, up: Floats) -> Floats:
    """E_sky(½ + ½ n.y) on ground whose unit normal has the vertical component ``up`` (...,); (..., 3)."""
    result: Floats = of.sky_irradiance * (0.5 + 0.5 * up)[..., None]
    return result


Mirror = Callable[[Floats, tuple[Floats, Floats]], Floats]
"""Light (r, 3) from directions about (r, 3), of standard deviations (r,) up and down, and aside, rad."""

Glint = Callable[[Floats, Floats, Floats, float], Floats]
"""Reflection of the sun (r, 3) from d, n, cv and σ², the arguments of :func:`glint`."""


def water(
    of: Air,
    body: Water,
    span: tuple[float, float],
    d: Floats,
    n: Floats,
    H: Floats,
    bed: tuple[Floats, Floats] | None = None,
    mirrored: Mirror | None = None,
    sun: Glint | None = None,
    lit: tuple[Floats, Floats, Floats] | None = None,
    saturation: Floats | None = None,
    past: Floats | None = None,
    open_sun: Floats | None = None,
) -> Floats:
    """Radiance of the water toward the camera, before haze; (r, 3).

    d (r, 3) points away from the camera, n (r, 3) is the unit normal with ripples, H (r,) the height, ``span`` the
    least and the greatest height of the surface, m. ``bed``: length of the path through the water to a shore's floor
    and back (r,) m, and the floor's reflectance (r, 3). ``mirrored``: light from directions about (r, 3) above the
    water, of standard deviations (r,); default: the sky's. ``sun``: replaces the smooth glint. ``lit``: a level
    floor with its own lighting: its radiance (r, 3), the length of the path up from it, and its depth, (r,) m.
    ``saturation`` (r,): of the foam, whose bubbles make the water milky. ``past`` (r,): the share of sunlight that
    foam beside the place and all that throws shadows do not block; ``open_sun`` (r,): the latter; default: 1.
    """
    sigma2 = body.roughness**2
    nv = np.maximum(-dot(n, d), 0.0)
    cv = np.sqrt(nv * nv + sigma2 * (1.0 - nv * nv))
    mirror = fresnel(cv)[:, None]
    entering = _entering(of, n, past)
    within = _body(of, body, entering, H, cv, bed, lit)
    if saturation is not None and body.aeration > 0.0:
        within = _aerated(body, entering, cv, within, saturation)
    direct = 1.0 if open_sun is None else open_sun[:, None]
    inner = (1.0 - mirror) * (within + direct * _crest(of, body, span, d, H))
    # A slope turns the reflected ray by twice its angle; across the plane of incidence less, as the look is flatter.
    spread = np.full(cv.shape, math.sqrt(2.0 * sigma2)), math.sqrt(2.0 * sigma2) * cv
    seen = of.mirrored if mirrored is None else mirrored
    glinting = partial(glint, of) if sun is None else sun
    return inner + mirror * seen(_reflected(d, n, sigma2), spread) + direct * glinting(d, n, cv, sigma2)


def foam(of: Air, albedo: float, N: Floats, past: Floats | None = None) -> Floats:
    """Radiance of foam of unit normals N (r, 3), before haze; (r, 3). ``past`` (r,): factor on the sun; default: 1."""
    direct = of.sun_irradiance * np.maximum(dot(N, of.sun), 0.0)[:, None]
    if past is not None:
        direct = direct * past[:, None]
    result: Floats = albedo / math.pi * (direct + sky_light(of, N[:, 1]))
    return result


def land(of: Air, soil: "Soil", d: Floats, level: Floats, past: Floats | None = None) -> Floats:
    """Radiance of land before haze; (r, 3). d and ``level``, the normals without detail: (r, 3) unit vectors.

    ``past`` (r,): factor on the sun; default: 1.
    """
    nv = np.maximum(-dot(level, d), 0.0)
    cv = np.sqrt(nv * nv + soil.roughness2 * (1.0 - nv * nv))
    mirror = soil.film * fresnel(cv)
    bare = foam(of, 1.0, soil.normal, past) * soil.albedo
    result: Floats = bare + mirror[:, None] * (of.sky(_reflected(d, level, soil.roughness2)) - bare)
    if soil.glints:
        glints = soil.film if past is None else soil.film * past
        result = result + glints[:, None] * glint(of, d, level, cv, soil.roughness2)
    return result


def haze(of: Air, visibility: float, L: Floats, d: Floats, distance: Floats) -> Floats:
    """L (r, 3) seen through (r,) m of air along d (r, 3): blended toward the sky at the horizon, or deep haze; (r, 3).

    For vertical rays, which have no horizon ahead, the horizon's direction is the zero vector.
    """
    if of.above is None:
        through = np.exp(-CONTRAST * distance / visibility)[:, None]
        air = sky(of, unit(d * np.array([1.0, 0.0, 1.0])))
    else:
        through, air = of.above.passed(distance), of.above.before(d)
    result: Floats = L * through + air * (1.0 - through)
    return result


def _air(sun: Floats, mie: float) -> Air:
    depth = RAYLEIGH + mie
    height = sun[1]
    path = depth * air_mass(height)
    return Air(
        sun=sun,
        mie=mie,
        depth=depth,
        sun_irradiance=SUN_POWER * np.exp(-path) * smoothstep(-SUN_RISE, SUN_RISE, height),
        air_light=SUN_POWER * np.exp(-0.5 * path) * math.exp(TWILIGHT * min(float(height), 0.0)) + NIGHT,
    )


@lru_cache(maxsize=64)
def _sky_irradiance(sun: tuple[float, ...], mie: float) -> Floats:
    """∫ sky cos over the upper hemisphere: Gauss–Legendre in height, equal steps in azimuth, where it is periodic."""
    nodes, weights = np.polynomial.legendre.leggauss(SKY_NODES)
    # Nodes are squares of heights, because the sky varies fastest at the horizon.
    root, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    y = root * root
    around = np.arange(SKY_TURNS) * (2.0 * math.pi / SKY_TURNS)
    level = np.sqrt(1.0 - y * y)
    d = np.stack(
        (
            level[:, None] * np.cos(around),
            np.repeat(y[:, None], SKY_TURNS, axis=1),
            level[:, None] * np.sin(around),
        ),
        axis=-1,
    )
    rings = sky(_air(np.array(sun), mie), d).sum(axis=1) * (2.0 * math.pi / SKY_TURNS)
    result: Floats = ((2.0 * root * y * weights)[:, None] * rings).sum(axis=0)
    return result


def _body(
    of: Air,
    body: Water,
    down: Floats,
    H: Floats,
    cv: Floats,
    bed: tuple[Floats, Floats] | None,
    lit: tuple[Floats, Floats, Floats] | None,
) -> Floats:
    """L_body: light scattered back by the water and its floor from the irradiance ``down`` (r, 3); (r, 3)."""
    extinction = 1.0 / np.array(body.absorption_length) + body.scattering
    deep = BACKSCATTER * body.scattering / extinction * down / math.pi
    if lit is not None:
        radiance, way, straight = lit
        return deep * (1.0 - np.exp(-extinction * (way + straight)[:, None])) + radiance * np.exp(
            -extinction * way[:, None]
        )
    if bed is not None:
        left = np.exp(-extinction * bed[0][:, None])
        seen: Floats = deep * (1.0 - left) + bed[1] * down / math.pi * left
        return seen
    if body.depth is None:
        return deep
    refracted = np.sqrt(1.0 - (1.0 - cv * cv) / INDEX**2)
    path = np.maximum(body.depth + H, 0.0) * (1.0 + 1.0 / refracted)
    through = np.exp(-extinction * path[:, None])
    result: Floats = deep * (1.0 - through) + np.array(body.floor_albedo) * down / math.pi * through
    return result


def _entering(of: Air, n: Floats, past: Floats | None = None) -> Floats:
    """Irradiance that enters water of unit normals n (r, 3), ``past`` (r,) the unblocked share of the sun; (r, 3)."""
    direct = of.sun_irradiance * np.maximum(dot(n, of.sun), 0.0)[:, None]
    if past is not None:
        direct = direct * past[:, None]
    result: Floats = ENTERS * (direct + sky_light(of, n[:, 1]))
    return result


def _aerated(body: Water, entering: Floats, cv: Floats, clear: Floats, saturation: Floats) -> Floats:
    """L_body under foam of a saturation (r,): a layer of bubbles in front of the light of ``clear`` water; (r, 3)."""
    absorption = 1.0 / np.array(body.absorption_length)
    way = body.plume_depth * np.clip(saturation, 0.0, 1.0) * (1.0 + 1.0 / np.sqrt(1.0 - (1.0 - cv * cv) / INDEX**2))
    down = entering / math.pi

    def layer(scattering: float) -> Floats:
        """Light scattered back by a layer of water of this scattering coefficient; (r, 3)."""
        extinction = absorption + scattering
        sent: Floats = BACKSCATTER * scattering / extinction * down * (1.0 - np.exp(-extinction * way[:, None]))
        return sent

    below = (clear - layer(body.scattering)) * np.exp(-body.aeration * way)[:, None]
    result: Floats = np.maximum(layer(body.scattering + body.aeration) + below, 0.0)
    return result


def _crest(of: Air, body: Water, span: tuple[float, float], d: Floats, H: Floats) -> Floats:
    """L_t: sunlight transmitted by thin crests; (r, 3)."""
    trough, top = span
    if top <= trough:
        return np.zeros_like(d)
    toward = np.maximum(d[:, 0] * of.sun[0] + d[:, 2] * of.sun[2], 0.0)
    share = body.translucency / math.pi * ((H - trough) / (top - trough)) ** 2 * toward
    result: Floats = share[:, None] * of.sun_irradiance * np.exp(-CREST_PATH / np.array(body.absorption_length))
    return result


def _reflected(d: Floats, n: Floats, sigma2: float) -> Floats:
    """Directions of reflection, raised by the roughness; (r, 3) unit vectors."""
    r = d - 2.0 * dot(d, n)[:, None] * n
    r[:, 1] = np.sqrt(np.maximum(r[:, 1], 0.0) ** 2 + sigma2)
    return unit(r)


def glint(of: Air, d: Floats, n: Floats, cv: Floats, sigma2: float) -> Floats:
    """L_s: reflection of the sun by roughness below the scale of ripples (Beckmann slopes); (r, 3)."""
    h = unit(of.sun - d)
    nh2 = np.maximum(dot(n, h), 1e-3) ** 2
    slopes = np.exp(-(1.0 - nh2) / (nh2 * sigma2)) / (math.pi * sigma2 * nh2 * nh2 * 4.0 * cv)
    mirrored = fresnel(np.maximum(dot(h, of.sun), 0.0)) * slopes
    # S = d gives h = 0: no facet reflects the sun straight ahead.
    mirrored = np.where((h == 0.0).all(axis=-1), 0.0, mirrored)
    result: Floats = np.minimum(of.sun_irradiance * mirrored[:, None], GLITTER_MOST)
    return result


def blinn_phong(of: Air, power: float, perturb: float, d: Floats, n: Floats, cv: Floats, sigma2: float) -> Floats:
    """The lake's highlight: around a half vector moved by the normal's tilt; (r, 3), independent of roughness."""
    h = unit(of.sun - d + perturb * n * np.array([1.0, 0.0, 1.0]))
    nh = np.clip(dot(n, h), 0.0, 1.0)
    result: Floats = of.sun_irradiance / math.pi * LAKE_STRENGTH * LAKE_COLOUR * np.power(nh, power)[:, None]
    return result
