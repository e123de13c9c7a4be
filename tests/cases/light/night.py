"""Hard cases of light.night, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.scenes import Camera, Light, Moon, Ripples, Scene, Sky, Water

_OPPOSITE = Moon(azimuth=0.3 - math.pi, elevation=0.4, size=5.0)

_BEFORE = Moon(azimuth=0.3, elevation=0.4, size=5.0)

_MOON_INVISIBLE = (Scene(light=Light(sun_elevation=-0.3, sky=Sky(moon=Moon(elevation=-0.2)))),)

_MOON_HARD = (
    HardCase(
        "moon and sun opposite",
        Scene(
            light=Light(sun_azimuth=0.3, sun_elevation=-0.4, exposure=1.0, sky=Sky(moon=_OPPOSITE)),
            water=Water(ripples=Ripples()),
        ),
        guard="the depth of the sphere at its rim is the root of at least 0 (light/night.glsl@moon_disc)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.3 - math.pi / 2, pitch=0.35, fov=0.2),
        unseen="llvmpipe's max(NaN, 0) is 0",
    ),
    HardCase(
        "the moon before the sun",
        Scene(light=Light(sun_azimuth=0.3, sun_elevation=0.4, exposure=-6.0, sky=Sky(moon=_BEFORE))),
        guard="the irradiance of points that face away from the sun is at least 0 (light/night.glsl@moon_disc)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.3 + math.pi / 2, pitch=0.4, fov=0.3),
        without={"light/night.glsl": {"sqrt(max(dot(normal, u_moon_sun), 0.0))": "sqrt(dot(normal, u_moon_sun))"}},
    ),
)

_STARS_INVISIBLE = (Scene(light=Light(sun_elevation=0.1, sky=Sky(stars=1.0))),)

_STARS_HARD = (
    HardCase(
        "stars at the corner of the cube",
        Scene(light=Light(sun_elevation=-1.0, exposure=6.0, sky=Sky(stars=10.0))),
        guard="cell indices are limited to the last of a face (light/night.glsl@stars)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 4, pitch=0.6154797, fov=0.6),
        unseen="no sample looks along the edge of a face",
    ),
    HardCase(
        "stars in the widest view",
        Scene(light=Light(sun_elevation=-1.0, exposure=6.0, sky=Sky(stars=10.0))),
        guard="a star is at most 3e-3 rad wide (light/night.glsl@stars)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.5, pitch=0.8, fov=2.6),
        without={"light/night.glsl": {"clamp(1.5 * pixel, 7e-4, 3e-3)": "max(1.5 * pixel, 7e-4)"}},
    ),
)

CASES = {
    "moon": Cases(invisible=_MOON_INVISIBLE, hard=_MOON_HARD),
    "stars": Cases(invisible=_STARS_INVISIBLE, hard=_STARS_HARD),
}
