"""Sun, moon and stars, sky and haze. docs/formulae.md, sections 6 and 9."""

import math
from functools import lru_cache

import numpy as np

from seafoam.effects.effect import Bound, Contribution, part_effect
from seafoam.effects.light import atmosphere, overcast
from seafoam.effects.light.atmosphere import ASYMMETRY, NODES, RAYLEIGH, SUN_POWER, air_mass, lamp, mie_depth
from seafoam.effects.shader import HASH, PERLIN_2, SlotFile, Source
from seafoam.framegraph.rules import Constant, Uniform, array, number, rounded, significant, vector
from seafoam.ocean.arrays import Floats, read_only, smooth
from seafoam.ocean.sky import skylight
from seafoam.quality import Quality
from seafoam.scene import Direction, Light, Moon, Scene, Sky
from seafoam.sums import summed

_SERIES = tuple(f"{part}{tint}{rim}" for rim in ("", "_rim") for part in ("even", "haze") for tint in ("", "_tint"))
_UNIFORMS = ("lamp", "level", *_SERIES)
ILLUMINATION = ("light/shade.glsl@irradiance", "light/shade.glsl@haze")
"""Irradiance of sun and sky, and the haze in front of what they light; after the sky's files."""
_TONES = {"filmic": "output/tone.glsl@filmic", "photographic": "output/tone.glsl@photographic"}
_DISC_SOLID_ANGLE = 6.8e-5
"""Solid angle of the sun's disc, sr."""
_MAX_DISC = 3000.0
"""Radiance at which the disc is clamped, well within the range of half floats."""
STAR_POWER = 1.0
"""Brightness of the brightest stars at night."""


def glow_source(lamp: str) -> Source:
    """Return the GLSL of ``LAMP_glow(vec3 d)`` and ``LAMP_glow_rim(vec2 level, vec3 d)``."""
    names = tuple((f"u_glow_{name}", f"u_{lamp}_glow_{name}") for name in _UNIFORMS)
    functions = tuple((name, f"{lamp}_{name}") for name in ("glow", "glow_light", "glow_rim"))
    return Source("light/sky.glsl@glow", (*names, *functions))


def glow_uniforms(lamp: str, toward: Direction, glow: skylight.Glow) -> dict[str, Uniform]:
    level = math.hypot(toward[0], toward[2])
    azimuth = (toward[0] / level, toward[2] / level) if level > 0.0 else (1.0, 0.0)
    series = {
        "even": (skylight.EVEN, glow.even.green),
        "even_tint": (skylight.EVEN_TINT, glow.even.tint),
        "haze": (skylight.HAZE, glow.haze.green),
        "haze_tint": (skylight.HAZE_TINT, glow.haze.tint),
    }
    return {
        f"u_{lamp}_glow_lamp": vector(rounded(toward)),
        f"u_{lamp}_glow_level": vector(rounded(azimuth)),
        **{f"u_{lamp}_glow_{name}": _array(values) for name, (_, values) in series.items()},
        **{f"u_{lamp}_glow_{name}_rim": _array(_along_the_horizon(*both)) for name, both in series.items()},
    }


def _along_the_horizon(exponents: skylight.Exponents, coefficients: Floats) -> Floats:
    """Coefficients of the powers of s where x is 1."""
    every = np.array([j for _, j in exponents])
    return np.stack([coefficients[every == j].sum(axis=0) for j in range(every.max() + 1)])


def _array(values: Floats) -> Uniform:
    """An array of floats, or of vec2 of values (n, 2)."""
    rules = (Constant(value=rounded(values.ravel().tolist())),)
    return array("float" if values.ndim == 1 else "vec2", rules, len(values))


def _view_air_mass(y: Floats | float) -> Floats | float:
    return 1.0 / (y + 0.09)


def _rgb(values: Floats) -> Floats:
    return read_only(np.array(rounded(values)))


def sun_irradiance(light: Light) -> Floats:
    """Return E_s, the lamp's irradiance (3,) on a surface that faces it, less the mean absorption of clouds."""
    clear = 1.0 if light.sky is None else 1.0 - overcast.cloud_mean(light.sky.clouds)
    return _rgb(clear * atmosphere.direct(light))


def brightest_sun(light: Light) -> Floats:
    """Return the greatest irradiance (3,) of the lamp anywhere: in the gaps between clouds that throw shadows."""
    return _rgb(overcast.gap_light(None if light.sky is None else light.sky.clouds) * sun_irradiance(light))


def sun_disc(light: Light) -> Floats:
    """Return the radiance (3,) of the sun's disc, at most :data:`_MAX_DISC`; in a layered sky it keeps its colour."""
    if light.sky is None:
        return _rgb(np.minimum(sun_irradiance(light) / _DISC_SOLID_ANGLE, _MAX_DISC))
    # The shader applies the clouds where they cover the disc; the moon's disc is drawn separately.
    if atmosphere.moon_is_lamp(light):
        return np.zeros(3)
    passed = atmosphere.direct(light) / SUN_POWER
    # Of a range that a picture can hold: a disc as red as it is dim.
    return _rgb(_MAX_DISC * math.sqrt(max(passed)) * passed)


def air_light(light: Light) -> Floats:
    """Return E_a, the irradiance (3,) of the light that the air scatters."""
    y = math.sin(light.sun[1])
    dimmed = np.exp(-0.5 * (RAYLEIGH + mie_depth(light)) * air_mass(y))
    return _rgb(SUN_POWER * dimmed * math.exp(12.0 * min(y, 0.0)) + atmosphere.NIGHT)


def air_parts(light: Light) -> dict[str, Floats]:
    """Return the terms (3,) of the sky's radiance that do not depend on direction, for ``light/sky.glsl@analytic``."""
    mie, air = mie_depth(light), air_light(light)
    depth = RAYLEIGH + mie
    whole = air / depth
    return {
        "rayleigh": 3.0 / (16.0 * math.pi) * RAYLEIGH * whole,
        "mie": (1.0 - ASYMMETRY * ASYMMETRY) / (4.0 * math.pi) * mie * whole,
        "even": 0.04 * air,
        "depth": depth,
        "horizon": 1.0 - np.exp(-depth * _view_air_mass(0.0)),
    }


@lru_cache(maxsize=64)
def sky_irradiance(light: Light) -> Floats:
    """Return E_sky, the irradiance (3,) of the whole sky on level water, by the midpoint rule (96 × 96 directions)."""
    if light.sky is not None:
        return _rgb(overcast.irradiance(light))
    sun, parts = lamp(light), air_parts(light)
    steps = (np.arange(NODES) + 0.5) / NODES
    # Equal steps in sin² of the elevation contain the cosine of incidence: cos dΩ = ½ d(y²) dφ.
    y = np.sqrt(steps)[:, None]
    gamma = (np.sqrt(1.0 - y * y) * math.hypot(sun[0], sun[2]) * np.cos(math.pi * steps) + y * sun[1])[..., None]
    mie = np.maximum(1.0 + ASYMMETRY * ASYMMETRY - 2.0 * ASYMMETRY * gamma, (1.0 - ASYMMETRY) ** 2) ** -1.5
    rings = (parts["even"] + (1.0 + gamma * gamma) * parts["rayleigh"] + mie * parts["mie"]).mean(axis=1)
    return _rgb(math.pi * (rings * (1.0 - np.exp(-parts["depth"] * _view_air_mass(y)))).mean(axis=0))


def _draw(scene: Scene, light: Light, quality: Quality) -> Contribution:
    if light.sky is None:
        sky: tuple[SlotFile, ...] = (SlotFile("sky", "light/sky.glsl@analytic", needs=("light/sky.glsl@exposure",)),)
        air = {f"u_air_{name}": vector(rounded(value)) for name, value in air_parts(light).items()}
    else:
        glow = atmosphere.glows(light)["sun"]
        dusk = glow[0][1] > skylight.DEEP_NIGHT
        layers = glow_source("sun") if dusk else "light/night.glsl@night"
        sky = (
            SlotFile("layered", layers, needs=("light/sky.glsl@exposure", "light/sky.glsl@layered")),
            SlotFile("sky", "light/sky.glsl@whole"),
            SlotFile("sky main", "light/sky.glsl@main_layered"),
        )
        air = {
            "u_haze_depth": number(light.sky.haze),
            "u_rayleigh_depth": vector(rounded(RAYLEIGH)),
            "u_mie_depth": number(significant(mie_depth(light))),
            **(glow_uniforms("sun", *glow) if dusk else {}),
        }
    shading = ("lib/refraction.glsl", *ILLUMINATION, "light/shade.glsl@optics")
    return Contribution(
        why=f"sun {math.degrees(light.sun[1]):.0f}° above the horizon, sky, haze",
        slots=(*sky, SlotFile("shade", "light/shade.glsl@lit", needs=shading), SlotFile("tone", _TONES[light.tone])),
        uniforms={
            "u_sun_direction": vector(rounded(lamp(light))),
            "u_sun_irradiance": vector(rounded(sun_irradiance(light))),
            "u_sky_irradiance": vector(rounded(sky_irradiance(light))),
            **air,
            "u_visibility": number(light.visibility, "/light/visibility"),
            "u_exposure": number(light.exposure, "/light/exposure"),
        },
    )


def _moon(scene: Scene, light: Light, sky: Sky, model: Moon, quality: Quality) -> Contribution:
    toward = atmosphere.moon(light)
    assert toward is not None
    sun = atmosphere.sun(light)
    right = (-math.sin(model.azimuth), 0.0, math.cos(model.azimuth))
    rise, level = math.sin(model.elevation), math.cos(model.elevation)
    up = (-rise * math.cos(model.azimuth), level, -rise * math.sin(model.azimuth))
    radius = atmosphere.MOON_RADIUS * model.size
    face = atmosphere.MOON_FACE * atmosphere.MOON_POWER * model.brightness * atmosphere.MOON_TINT
    axes = (right, up, tuple(-value for value in toward))
    glows = atmosphere.glows(light)
    lit = 100.0 * math.sqrt(atmosphere.moon_phase(light))
    return Contribution(
        why=f"moon {math.degrees(model.elevation):.0f}° above the horizon, {lit:.0f} % illuminated",
        slots=(
            *((SlotFile("moon", glow_source("moon")),) if "moon" in glows else ()),
            SlotFile("moon disc", "light/night.glsl@moon_disc", needs=PERLIN_2),
        ),
        uniforms={
            "u_moon_direction": vector(rounded(toward)),
            **(glow_uniforms("moon", *glows["moon"]) if "moon" in glows else {}),
            "u_moon_right": vector(rounded(right)),
            "u_moon_up": vector(rounded(up)),
            "u_moon_radius": number(significant(radius)),
            "u_moon_sun": vector(rounded(summed(a * b for a, b in zip(sun, axis, strict=True)) for axis in axes)),
            "u_moon_radiance": vector(rounded(face * np.exp(-0.5 * atmosphere.path(light, toward[1])))),
        },
        bound=Bound.zero_if(toward[1] < -max(0.02, 2.0 * radius), "the moon is below the horizon"),
    )


def _stars(scene: Scene, light: Light, sky: Sky, brightness: float, quality: Quality) -> Contribution:
    dark = smooth(0.05, 0.2, -atmosphere.sun(light)[1])
    return Contribution(
        why="stars",
        slots=(SlotFile("stars", "light/night.glsl@stars", needs=("lib/texels.glsl@cube_face", HASH)),),
        uniforms={
            "u_star_path": vector(rounded(atmosphere.RAYLEIGH + atmosphere.mie_depth(light))),
            "u_star_brightness": number(significant(STAR_POWER * brightness * dark)),
        },
        bound=Bound.zero_if(dark == 0.0, "the sun is above the horizon"),
    )


EFFECT = part_effect("sun and sky", _draw, "/light", fields=("/light/day", "/light/sky"))
MOON = part_effect("moon", _moon, "/light/sky/moon")
STARS = part_effect("stars", _stars, "/light/sky/stars")
