"""Hard cases of light.sparkles, and scenes that call for it and cannot show it."""

import math
from typing import get_args

from support.cases import Cases, HardCase
from support.hard.mutations import BRIGHTEST, IN_FLOAT32
from support.scenes import Camera, Light, ParametricWave, Ripples, Scene, Sparkles, Water

_SUNSET = Light(sun_elevation=0.12, sun_azimuth=-math.pi / 2, exposure=-1.0, sparkles=Sparkles())

_WATER = Water(ripples=Ripples(slope=0.2), roughness=0.12)

_VIEW = Camera(position=(0.0, 4.0, 0.0), pitch=-0.1, fov=0.6)


def _light(**fields: object) -> Light:
    return _SUNSET.model_copy(update=fields)


_INVISIBLE = (
    Scene(light=Light(sun_elevation=-0.1, sparkles=Sparkles())),
    Scene(light=Light(sun_elevation=-math.pi / 2, sparkles=Sparkles(rate=0.1, life=0.02), specular="blinn_phong")),
)

_HARD = (
    HardCase(
        "sparkles at any time",
        Scene(light=_SUNSET, water=_WATER),
        guard="age and epoch are reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 0.0, 1e9),
        camera=_VIEW,
        without=IN_FLOAT32,
    ),
    HardCase(
        "sparkles straight down, under the sun at the zenith",
        Scene(light=_light(sun_elevation=math.pi / 2), water=_WATER),
        guard="cells lie on an octahedron, which has no pole (light/glitter.glsl@sparkles)",
        camera=Camera(position=(0.0, 4.0, 0.0), pitch=-math.pi / 2),
        unseen="no guard but a choice: cells that have no pole",
    ),
    HardCase(
        "one sparkle for the whole sun",
        Scene(light=_light(sparkles=Sparkles(size=2e-4, rate=0.3, life=0.3, share=1.0), exposure=10.0), water=_WATER),
        guard="light is at most 65504 (surface/main.glsl)",
        times=(0.0, 0.13),
        camera=_VIEW.model_copy(update={"fov": 0.02}),
        without=BRIGHTEST,
    ),
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

CASES = {"sparkles": Cases(invisible=_INVISIBLE, hard=_HARD, variants=_VARIANTS)}
