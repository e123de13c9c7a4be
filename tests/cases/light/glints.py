"""Test scenes of glitter, sparkles, glare and light through crests: hard cases, and scenes that cannot show them."""

import math
from typing import get_args

from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, Light, ParametricWave, Ripples, Scene, Sparkles, Water

_DOWN = Light(sun_elevation=-0.1)

_INVISIBLE_GLITTER = (Scene(light=_DOWN), Scene(light=Light(sun_elevation=-math.pi / 2)))

_HARD_GLITTER = (
    HardCase(
        "the brightest path of the sun",
        Scene(light=Light(sun_elevation=0.05, exposure=10.0), water=Water(roughness=0.01, ripples=Ripples(slope=0.05))),
        guard="glitter is at most 1e4 (light/glitter.glsl@beckmann), the frame at most 65504 (surface/main.glsl@main)",
        camera=Camera(position=(0.0, 2.0, 0.0), yaw=math.pi / 2, pitch=-0.05, fov=0.3),
        without={
            "surface/main.glsl": {"min(light, BRIGHTEST)": "light"},
            "light/sky.glsl": {
                "min(exposure() * (sky_light(d) + sun_disc(d)), BRIGHTEST)": "exposure() * (sky_light(d) + sun_disc(d))"
            },
            "light/glitter.glsl": {
                "return min(u_sun_irradiance *": "return max(u_sun_irradiance *",
                "slopes / (4.0 * cv)), 1e4)": "slopes / (4.0 * cv)), 0.0)",
            },
        },
    ),
    HardCase(
        "the lake's highlight at its sharpest",
        Scene(
            light=Light(
                sun_elevation=0.1,
                sun_azimuth=math.pi,
                specular="blinn_phong",
                specular_power=2000.0,
                specular_perturb=0.0,
            ),
            water=Water(ripples=Ripples(slope=0.6)),
        ),
        guard="n·h is clamped to [0, 1] before the power (light/glitter.glsl@blinn_phong)",
        camera=Camera(position=(0.0, 2.0, 0.0), yaw=math.pi / 2, pitch=-0.1),
        without={"light/glitter.glsl": {"clamp(dot(n, h) / max(length(h), 1e-6), 0.0, 1.0)": "dot(n, h) / length(h)"}},
    ),
)

_SUNSET = Light(sun_elevation=0.12, sun_azimuth=-math.pi / 2, exposure=-1.0, sparkles=Sparkles())

_WATER = Water(ripples=Ripples(slope=0.2), roughness=0.12)

_VIEW = Camera(position=(0.0, 4.0, 0.0), pitch=-0.1, fov=0.6)


def _light(**fields: object) -> Light:
    return _SUNSET.model_copy(update=fields)


_INVISIBLE_SPARKLES = (
    Scene(light=Light(sun_elevation=-0.1, sparkles=Sparkles())),
    Scene(light=Light(sun_elevation=-math.pi / 2, sparkles=Sparkles(rate=0.1, life=0.02), specular="blinn_phong")),
)

_HARD_SPARKLES = (
    reduced("sparkles at any time", Scene(light=_SUNSET, water=_WATER), "age and epoch", _VIEW, (-1e9, 0.0, 1e9)),
    HardCase(
        "sparkles so many that they run together",
        Scene(light=_light(sparkles=Sparkles(size=0.02, rate=10000.0, life=10.0)), water=_WATER),
        guard="where nearly every cell contains a sparkle, the glint is smooth (light/glitter.glsl@sparkles)",
        camera=_VIEW,
        without={
            "light/glitter.glsl": {
                " * (1.0 - smoothstep(0.5, 2.0, u_sparkle_density * w * side * side * l1 * l1 * l1))": ""
            }
        },
    ),
    HardCase(
        "sparkles of a sun that sets through the horizon",
        Scene(waves=(ParametricWave(amplitude=0.3, wavelength=7.0),), light=_light(sun_elevation=0.0), water=_WATER),
        guard="the glint is at least 1e-20 of the sun (light/glitter.glsl@sparkles)",
        camera=_VIEW,
        without={
            "light/glitter.glsl": {
                "float w = max((glint.r": "float w = ((glint.r",
                "max(u_sun_irradiance.r + u_sun_irradiance.g + u_sun_irradiance.b, 1e-20), 1e-20)": (
                    "(u_sun_irradiance.r + u_sun_irradiance.g + u_sun_irradiance.b))"
                ),
            }
        },
    ),
    HardCase(
        "sparkles smaller than a hundredth of a pixel",
        Scene(light=_light(sparkles=Sparkles(size=2e-4)), water=_WATER),
        guard="a sparkle is at least 1.5 pixels wide, and dimmed in proportion (light/glitter.glsl@sparkles)",
        camera=Camera(position=(0.0, 4.0, 0.0), pitch=-0.5, fov=2.6),
        without={"light/glitter.glsl": {"clamp(least, u_sparkle_radius, 0.25)": "u_sparkle_radius"}},
    ),
)

_VARIANTS = tuple(
    Scene(light=Light(specular=specular, sparkles=Sparkles()))
    for specular in get_args(Light.model_fields["specular"].annotation)
)
"""In place of either glint."""

_INVISIBLE_SUBSURFACE = (
    Scene(),
    Scene(waves=(ParametricWave(),), water=Water(translucency=0.0)),
    Scene(waves=(ParametricWave(),), light=Light(sun_elevation=-0.3)),
    Scene(waves=(ParametricWave(),), water=Water(absorption_length=(0.5, 0.5, 0.5))),
)

CASES = {
    "sun glitter": Cases(invisible=_INVISIBLE_GLITTER, hard=_HARD_GLITTER),
    "sparkles": Cases(invisible=_INVISIBLE_SPARKLES, hard=_HARD_SPARKLES, variants=_VARIANTS),
    "glare": Cases(
        always_visible="any share that is not 0 spreads some light",
        variants=(Scene(light=Light(glare=0.1)), Scene(light=Light(tone="photographic"))),
    ),
    "crest light": Cases(invisible=_INVISIBLE_SUBSURFACE),
}
