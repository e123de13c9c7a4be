"""Sun, sky and haze. docs/formulae.md, section 6."""

import math
from functools import lru_cache

from seafoam.effects.effect import Contribution, Effect, SlotFile
from seafoam.effects.light import atmosphere
from seafoam.framegraph.rules import number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.sky import direction

Rgb = tuple[float, float, float]

ILLUMINATION = ("light/shade/irradiance.glsl", "light/shade/haze.glsl")
"""Irradiance of sun and sky, and the haze before what they light; after the sky's files."""

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


def lamp_angles(light: Light) -> tuple[float, float]:
    """Azimuth and elevation of what lights the water, rad: the sun, or a moon once the sun is well down."""
    if light.sky is not None and light.sky.moon is not None and atmosphere.moon_is_lamp(light):
        return light.sky.moon.azimuth, light.sky.moon.elevation
    return light.sun


def sun_direction(light: Light) -> Rgb:
    """Unit vector toward the lamp, the sun or the moon."""
    return direction(*lamp_angles(light))


def sun_irradiance(light: Light) -> Rgb:
    """E_s: the lamp's irradiance on a surface that faces it, less what clouds take in the mean."""
    if light.sky is not None:
        left = 1.0 - atmosphere.cloud_mean(light.sky.clouds)
        return _rgb([left * value for value in atmosphere.direct(light)])
    y = math.sin(light.sun[1])
    t = min(max((y + 0.02) / 0.04, 0.0), 1.0)
    up = t * t * (3.0 - 2.0 * t)
    return _rgb([_E0 * math.exp(-(tau + _mie(light)) * _air_mass(y)) * up for tau in _RAYLEIGH])


def sun_disc(light: Light) -> Rgb:
    """Radiance of the sun's disc, held at 3000, well inside half floats."""
    if light.sky is not None:
        # Clouds hide the disc where they are; the moon has a face of its own.
        bright = (0.0, 0.0, 0.0) if atmosphere.moon_is_lamp(light) else atmosphere.direct(light)
        return _rgb([min(value / 6.8e-5, 3000.0) for value in bright])
    return _rgb([min(value / 6.8e-5, 3000.0) for value in sun_irradiance(light)])


def air_light(light: Light) -> Rgb:
    """E_a: irradiance of the light that the air scatters."""
    y = math.sin(light.sun[1])
    return _rgb(
        [
            _E0 * math.exp(-0.5 * (tau + _mie(light)) * _air_mass(y)) * math.exp(12.0 * min(y, 0.0)) + 0.002
            for tau in _RAYLEIGH
        ]
    )


def air_parts(light: Light) -> dict[str, list[float]]:
    """Terms of the sky's radiance that hang on no direction, for ``light/sky/analytic.glsl``."""
    mie, air = _mie(light), air_light(light)
    depth = [tau + mie for tau in _RAYLEIGH]
    whole = [e / tau for e, tau in zip(air, depth, strict=True)]
    return {
        "rayleigh": [3.0 / (16.0 * math.pi) * tau * e for e, tau in zip(whole, _RAYLEIGH, strict=True)],
        "mie": [(1.0 - _G * _G) / (4.0 * math.pi) * mie * e for e in whole],
        "even": [0.04 * e for e in air],
        "depth": depth,
        "horizon": [1.0 - math.exp(-tau * _view_air_mass(0.0)) for tau in depth],
    }


@lru_cache(maxsize=64)
def sky_irradiance(light: Light) -> Rgb:
    """E_sky: irradiance of the whole sky on level water, by the midpoint rule (96 × 96 directions)."""
    if light.sky is not None:
        return _rgb(list(atmosphere.irradiance(light)))
    sun = sun_direction(light)
    parts = air_parts(light)
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
            rayleigh = 1.0 + gamma * gamma
            mie = max(1.0 + _G * _G - 2.0 * _G * gamma, (1.0 - _G) ** 2) ** -1.5
            for channel in range(3):
                ring[channel] += (
                    parts["even"][channel] + rayleigh * parts["rayleigh"][channel] + mie * parts["mie"][channel]
                )
        for channel, depth in enumerate(parts["depth"]):
            total[channel] += ring[channel] / count * (1.0 - math.exp(-depth * mass))
    return _rgb([math.pi * value / count for value in total])


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light``."""
    light = scene.light
    if light is None:
        return None
    if light.sky is None:
        sky: tuple[SlotFile, ...] = (SlotFile("sky", "light/sky/analytic.glsl", needs=("light/sky/exposure.glsl",)),)
        air = {f"u_air_{name}": vector(_rgb(value)) for name, value in air_parts(light).items()}
    else:
        toward = atmosphere.sun(light)
        sky = (
            SlotFile("layered", "light/sky/layered.glsl", needs=("light/sky/exposure.glsl",)),
            SlotFile("sky", "light/sky/whole.glsl"),
            SlotFile("sky main", "light/sky/main_layered.glsl"),
        )
        air = {
            "u_haze_depth": number(light.sky.haze),
            "u_rayleigh_depth": vector(_RAYLEIGH),
            "u_mie_depth": number(significant(_mie(light))),
            "u_sky_sun": vector(_rgb(list(toward))),
            "u_sky_sun_path": vector(_rgb(list(atmosphere.path(light, toward[1])))),
            "u_sky_sun_power": number(significant(atmosphere.sun_power(light))),
        }
    return Contribution(
        why=f"sun {math.degrees(light.sun[1]):.0f}° over the horizon, sky, haze",
        slots=(
            *sky,
            SlotFile(
                "shade",
                "light/shade/lit.glsl",
                needs=("lib/refraction.glsl", *ILLUMINATION, "light/shade/optics.glsl"),
            ),
            SlotFile("tone", "output/tone/filmic.glsl"),
        ),
        uniforms={
            "u_sun_direction": vector(_rgb(list(sun_direction(light)))),
            "u_sun_irradiance": vector(sun_irradiance(light)),
            "u_sky_irradiance": vector(sky_irradiance(light)),
            **air,
            "u_visibility": number(light.visibility, "/light/visibility"),
            "u_exposure": number(light.exposure, "/light/exposure"),
        },
    )


EFFECT = Effect("sun and sky", contribute)
