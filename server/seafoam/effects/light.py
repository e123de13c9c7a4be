"""Sun, sky and haze. docs/formulae.md, section 6."""

import math

from seafoam.effects.contribution import Contribution, Effect, SlotFile, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.models import Light, Scene

Rgb = tuple[float, float, float]

_RAYLEIGH: Rgb = (0.055, 0.108, 0.215)
_E0 = 20.0
_G = 0.76


def _rgb(values: list[float]) -> Rgb:
    red, green, blue = (significant(value) for value in values)
    return red, green, blue


def _mie(light: Light) -> float:
    return 0.01 + 0.04 * (light.turbidity - 1.0)


def _air_mass(y: float) -> float:
    return 1.0 / (max(y, 0.0) + 0.03)


def _view_air_mass(y: float) -> float:
    return 1.0 / (y + 0.09)


def sun_direction(light: Light) -> Rgb:
    """Unit vector toward the sun."""
    level = math.cos(light.sun_elevation)
    return level * math.cos(light.sun_azimuth), math.sin(light.sun_elevation), level * math.sin(light.sun_azimuth)


def sun_irradiance(light: Light) -> Rgb:
    """E_s: the sun's irradiance on a surface that faces it."""
    y = math.sin(light.sun_elevation)
    t = min(max((y + 0.02) / 0.04, 0.0), 1.0)
    up = t * t * (3.0 - 2.0 * t)
    return _rgb([_E0 * math.exp(-(tau + _mie(light)) * _air_mass(y)) * up for tau in _RAYLEIGH])


def sun_disc(light: Light) -> Rgb:
    """Radiance of the sun's disc, held at 3000, well inside half floats."""
    return _rgb([min(value / 6.8e-5, 3000.0) for value in sun_irradiance(light)])


def air_light(light: Light) -> Rgb:
    """E_a: irradiance of the light that the air scatters."""
    y = math.sin(light.sun_elevation)
    return _rgb(
        [
            _E0 * math.exp(-0.5 * (tau + _mie(light)) * _air_mass(y)) * math.exp(12.0 * min(y, 0.0)) + 0.002
            for tau in _RAYLEIGH
        ]
    )


def sky_irradiance(light: Light) -> Rgb:
    """E_sky: irradiance of the whole sky on level water, by the midpoint rule (96 × 96 directions)."""
    sun = sun_direction(light)
    air = air_light(light)
    mie_depth = _mie(light)
    count = 96
    total = [0.0, 0.0, 0.0]
    for i in range(count):
        # Even steps in sin² of the elevation angle weigh by the cosine of incidence: dΩ cos = ½ d(y²) dφ.
        y = math.sqrt((i + 0.5) / count)
        level = math.sqrt(1.0 - y * y)
        mass = _view_air_mass(y)
        ring = [0.0, 0.0, 0.0]
        for j in range(count):
            phi = (j + 0.5) * math.pi / count
            gamma = level * math.hypot(sun[0], sun[2]) * math.cos(phi) + y * sun[1]
            rayleigh = 3.0 / (16.0 * math.pi) * (1.0 + gamma * gamma)
            mie = (1.0 - _G * _G) / (4.0 * math.pi * max(1.0 + _G * _G - 2.0 * _G * gamma, (1.0 - _G) ** 2) ** 1.5)
            for channel, tau in enumerate(_RAYLEIGH):
                ring[channel] += (tau * rayleigh + mie_depth * mie) / (tau + mie_depth) + 0.04
        for channel, tau in enumerate(_RAYLEIGH):
            total[channel] += ring[channel] / count * (1.0 - math.exp(-(tau + mie_depth) * mass))
    return _rgb([math.pi * air[channel] * total[channel] / count for channel in range(3)])


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light``."""
    light = scene.light
    if light is None:
        return None
    return Contribution(
        why=f"sun {math.degrees(light.sun_elevation):.0f}° over the horizon, sky, haze",
        slots=(
            SlotFile("sky", "sky/analytic.glsl", needs=("sky/exposure.glsl",)),
            SlotFile("shade", "shade/lit.glsl", needs=("shade/fresnel.glsl", "shade/sun.glsl")),
            SlotFile("tone", "tone/filmic.glsl"),
        ),
        uniforms={
            "u_sun_direction": vector(_rgb(list(sun_direction(light)))),
            "u_sun_irradiance": vector(sun_irradiance(light)),
            "u_sky_irradiance": vector(sky_irradiance(light)),
            "u_air_light": vector(air_light(light)),
            "u_rayleigh_depth": vector(_RAYLEIGH),
            "u_mie_depth": number(significant(_mie(light))),
            "u_visibility": number(light.visibility, "/light/visibility"),
            "u_exposure": number(light.exposure, "/light/exposure"),
        },
    )


EFFECT = Effect(
    "sun and sky",
    contribute,
    always_visible="it is the light that everything else is seen by; without it a scene is drawn white on black",
)
