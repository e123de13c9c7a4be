"""Sun, sky and haze. docs/formulae.md, section 6."""

import math
from collections.abc import Iterable
from functools import lru_cache

from seafoam.effects.effect import Contribution, Effect
from seafoam.effects.light import atmosphere, overcast
from seafoam.effects.light.atmosphere import ASYMMETRY, RAYLEIGH, SUN_POWER, Rgb, air_mass, mie_depth
from seafoam.effects.light.glow import glow_source, glow_uniforms
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number, significant, vector
from seafoam.ocean.sky import skylight
from seafoam.quality import Quality
from seafoam.scene.light import Light, direction
from seafoam.scene.models import Scene

ILLUMINATION = ("light/shade.glsl@irradiance", "light/shade.glsl@haze")
"""Irradiance of sun and sky, and the haze in front of what they light; after the sky's files."""
_TONES = {
    "filmic": "output/tone.glsl@filmic",
    "photographic": "output/tone.glsl@photographic",
}
_DISC_SOLID_ANGLE = 6.8e-5
"""Solid angle of the sun's disc, sr."""
_MAX_DISC = 3000.0
"""Radiance at which the disc is clamped, well within the range of half floats."""


def _rgb(values: Iterable[float]) -> Rgb:
    red, green, blue = map(significant, values)
    return red, green, blue


def _view_air_mass(y: float) -> float:
    return 1.0 / (y + 0.09)


def lamp_angles(light: Light) -> tuple[float, float]:
    """Return azimuth and elevation of the lamp, rad: the sun, or the moon if the sun is well below the horizon."""
    if light.sky is not None and light.sky.moon is not None and atmosphere.moon_is_lamp(light):
        return light.sky.moon.azimuth, light.sky.moon.elevation
    return light.sun


def sun_direction(light: Light) -> Rgb:
    """Return the unit vector toward the lamp, sun or moon."""
    return direction(*lamp_angles(light))


def sun_irradiance(light: Light) -> Rgb:
    """Return E_s, the lamp's irradiance on a surface that faces it, less the mean absorption of clouds."""
    clear = 1.0 if light.sky is None else 1.0 - overcast.cloud_mean(light.sky.clouds)
    return _rgb(clear * value for value in atmosphere.direct(light))


def brightest_sun(light: Light) -> Rgb:
    """Return the greatest irradiance of the lamp anywhere: in the gaps between clouds that throw shadows."""
    gap = overcast.gap_light(None if light.sky is None else light.sky.clouds)
    return _rgb(gap * value for value in sun_irradiance(light))


def sun_disc(light: Light) -> Rgb:
    """Return the radiance of the sun's disc, at most :data:`_MAX_DISC`; under a layered sky it keeps its colour."""
    if light.sky is not None:
        # The shader applies the clouds where they cover the disc; the moon's disc is drawn separately.
        if atmosphere.moon_is_lamp(light):
            return 0.0, 0.0, 0.0
        passed = [value / SUN_POWER for value in atmosphere.direct(light)]
        # Of a range that a picture can hold: a disc as red as it is dim.
        return _rgb(_MAX_DISC * math.sqrt(max(passed)) * share for share in passed)
    irradiance = sun_irradiance(light)
    return _rgb(min(value / _DISC_SOLID_ANGLE, _MAX_DISC) for value in irradiance)


def air_light(light: Light) -> Rgb:
    """Return E_a, the irradiance of the light that the air scatters."""
    y = math.sin(light.sun[1])
    mass, twilight = air_mass(y), math.exp(12.0 * min(y, 0.0))
    return _rgb(
        SUN_POWER * math.exp(-0.5 * (tau + mie_depth(light)) * mass) * twilight + atmosphere.NIGHT for tau in RAYLEIGH
    )


def air_parts(light: Light) -> dict[str, list[float]]:
    """Return the terms of the sky's radiance that do not depend on direction, for ``light/sky.glsl@analytic``."""
    mie, air = mie_depth(light), air_light(light)
    depth = [tau + mie for tau in RAYLEIGH]
    whole = [e / tau for e, tau in zip(air, depth, strict=True)]
    return {
        "rayleigh": [3.0 / (16.0 * math.pi) * tau * e for e, tau in zip(whole, RAYLEIGH, strict=True)],
        "mie": [(1.0 - ASYMMETRY * ASYMMETRY) / (4.0 * math.pi) * mie * e for e in whole],
        "even": [0.04 * e for e in air],
        "depth": depth,
        "horizon": [1.0 - math.exp(-tau * _view_air_mass(0.0)) for tau in depth],
    }


@lru_cache(maxsize=64)
def sky_irradiance(light: Light) -> Rgb:
    """Return E_sky, the irradiance of the whole sky on level water, by the midpoint rule (96 × 96 directions)."""
    if light.sky is not None:
        return _rgb(overcast.irradiance(light))
    sun = sun_direction(light)
    parts = air_parts(light)
    count = 96
    total = [0.0, 0.0, 0.0]
    for i in range(count):
        # Equal steps in sin² of the elevation contain the cosine of incidence: cos dΩ = ½ d(y²) dφ.
        y = math.sqrt((i + 0.5) / count)
        level = math.sqrt(1.0 - y * y)
        mass = _view_air_mass(y)
        ring = [0.0, 0.0, 0.0]
        for j in range(count):
            phi = (j + 0.5) * math.pi / count
            gamma = level * math.hypot(sun[0], sun[2]) * math.cos(phi) + y * sun[1]
            rayleigh = 1.0 + gamma * gamma
            mie = max(1.0 + ASYMMETRY * ASYMMETRY - 2.0 * ASYMMETRY * gamma, (1.0 - ASYMMETRY) ** 2) ** -1.5
            for channel in range(3):
                ring[channel] += (
                    parts["even"][channel] + rayleigh * parts["rayleigh"][channel] + mie * parts["mie"][channel]
                )
        for channel, depth in enumerate(parts["depth"]):
            total[channel] += ring[channel] / count * (1.0 - math.exp(-depth * mass))
    return _rgb(math.pi * value / count for value in total)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a light."""
    light = scene.light
    if light is None:
        return None
    if light.sky is None:
        sky: tuple[SlotFile, ...] = (SlotFile("sky", "light/sky.glsl@analytic", needs=("light/sky.glsl@exposure",)),)
        air = {f"u_air_{name}": vector(_rgb(value)) for name, value in air_parts(light).items()}
    else:
        glow = atmosphere.glows(light)["sun"]
        dusk = glow[0][1] > skylight.DEEP_NIGHT
        sky = (
            SlotFile(
                "layered",
                glow_source("sun") if dusk else "light/night.glsl@night",
                needs=("light/sky.glsl@exposure", "light/sky.glsl@layered"),
            ),
            SlotFile("sky", "light/sky.glsl@whole"),
            SlotFile("sky main", "light/sky.glsl@main_layered"),
        )
        air = {
            "u_haze_depth": number(light.sky.haze),
            "u_rayleigh_depth": vector(RAYLEIGH),
            "u_mie_depth": number(significant(mie_depth(light))),
            **(glow_uniforms("sun", *glow) if dusk else {}),
        }
    return Contribution(
        why=f"sun {math.degrees(light.sun[1]):.0f}° above the horizon, sky, haze",
        slots=(
            *sky,
            SlotFile(
                "shade",
                "light/shade.glsl@lit",
                needs=("lib/refraction.glsl", *ILLUMINATION, "light/shade.glsl@optics"),
            ),
            SlotFile("tone", _TONES[light.tone]),
        ),
        uniforms={
            "u_sun_direction": vector(_rgb(sun_direction(light))),
            "u_sun_irradiance": vector(sun_irradiance(light)),
            "u_sky_irradiance": vector(sky_irradiance(light)),
            **air,
            "u_visibility": number(light.visibility, "/light/visibility"),
            "u_exposure": number(light.exposure, "/light/exposure"),
        },
    )


EFFECT = Effect("sun and sky", contribute, fields=("/light", "/light/day", "/light/sky"))
