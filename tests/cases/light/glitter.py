"""Hard cases of light.glitter, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import BRIGHTEST, guards
from support.scenes import Camera, Light, ParametricWave, Ripples, Scene, Water

_DOWN = Light(sun_elevation=-0.1)

_INVISIBLE = (Scene(light=_DOWN), Scene(light=Light(sun_elevation=-math.pi / 2)))

_HARD = (
    HardCase(
        "into the sun on the horizon",
        Scene(light=Light(sun_elevation=0.0, exposure=10.0), water=Water(roughness=0.01)),
        guard="the half vector h is divided by at least 1e-6 (light/glitter.glsl@beckmann)",
        camera=Camera(position=(0.0, 1.0, 0.0), yaw=math.pi / 2, pitch=0.0, fov=0.01),
        unseen="llvmpipe's max(NaN, x) is x",
    ),
    HardCase(
        "facets seen edge-on",
        Scene(
            waves=(ParametricWave(amplitude=2.0, wavelength=3.0, exponent=8.0),),
            light=Light(sun_elevation=0.02, sun_azimuth=math.pi),
            water=Water(roughness=0.01),
        ),
        guard="n·h is at least 1e-3 (light/glitter.glsl@beckmann)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=-0.3),
        without={"light/glitter.glsl": {"max(dot(n, h), 1e-3)": "dot(n, h)"}},
        missed_by=guards("light", "facets_that_face_away_reflect_no_sun"),
    ),
    HardCase(
        "the brightest path of the sun",
        Scene(light=Light(sun_elevation=0.05, exposure=10.0), water=Water(roughness=0.01, ripples=Ripples(slope=0.05))),
        guard="glitter is at most 1e4 (light/glitter.glsl@beckmann), the frame at most 65504 (surface/main.glsl)",
        camera=Camera(position=(0.0, 2.0, 0.0), yaw=math.pi / 2, pitch=-0.05, fov=0.3),
        without={
            **BRIGHTEST,
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

CASES = {"sun glitter": Cases(invisible=_INVISIBLE, hard=_HARD)}
