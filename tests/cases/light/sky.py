"""Test scenes of sun, sky, clouds, their shadows and the night: hard cases, and scenes that cannot show them."""

import math

from seafoam.scene import Cirrus, Clouds, Light, Moon, Sky
from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, ParametricWave, Ripples, Scene, Water

_HARD_LIGHT = (
    HardCase(
        "sun at the zenith",
        Scene(light=Light(sun_elevation=math.pi / 2, turbidity=10.0), water=Water(ripples=Ripples())),
        guard="offsets of 0.03 and 0.09 in the air masses (docs/formulae.md, section 6)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
        without={"light/sky.glsl": {"(max(d.y, 0.0) + 0.09)": "max(d.y, 0.0)"}},
    ),
    HardCase(
        "no lamp at all: the sun down, the moon not yet counted",
        Scene(
            light=Light(sun_elevation=-0.06, exposure=2.0, sky=Sky(moon=Moon(), stars=1.0)),
            water=Water(ripples=Ripples()),
        ),
        guard="moonlight starts at 0 at the elevation where sunlight reaches 0 (effects/light/atmosphere.py)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.4, pitch=0.0),
        without={"effects/light/atmosphere.py": {"* dark * smooth(": "* smooth("}},
    ),
    HardCase(
        "fog on the eye",
        Scene(light=Light(visibility=50.0), waves=(ParametricWave(),)),
        guard="Newton steps never leave the slab of the waves (surface/march.glsl@march)",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.5, fov=2.6),
        without={"lib/rays.glsl": {"max(tau - clamp(gap / rate, -limit, limit), least)": "tau - gap / rate"}},
    ),
)

_THIN = Sky(clouds=Clouds(thickness=0.0))

_INVISIBLE_CLOUDS = (Scene(light=Light(sky=_THIN)), Scene(light=Light(sky=Sky(clouds=Clouds(cover=0.0)))))

_NO_STREAKS = (
    Scene(light=Light(sky=Sky(cirrus=Cirrus(cover=0.0)))),
    Scene(light=Light(sky=Sky(cirrus=Cirrus(thickness=0.0)))),
)

_HARD_CLOUDS = (
    reduced(
        "clouds low and high, anywhere, at any time",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(), cirrus=Cirrus(cover=0.7)))),
        "the camera's position in the noise, of high clouds along the streaks and across,",
        Camera(position=(1e7, 3.0, -1e7), pitch=0.3),
    ),
    HardCase(
        "the layer's way from the horizon to overhead",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=200.0, size=300.0, cover=0.5)))),
        guard="the distance to the layer is computed as a quotient, not as a difference of two large numbers "
        "(light/clouds.glsl@layer)",
        camera=Camera(position=(0.0, 2.0, 0.0), pitch=0.7, fov=1.5),
        without={
            "light/clouds.glsl": {"rest / (along + sqrt(along * along + rest))": "sqrt(along * along + rest) - along"}
        },
    ),
    HardCase(
        "eye above the clouds",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
        guard="there are no clouds for a camera above nine tenths of their height (light/clouds.glsl@layer)",
        camera=Camera(position=(0.0, 9e4, 0.0), pitch=0.1),
        without={
            "light/clouds.glsl": {"return 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x)": "return 1.0"}
        },
    ),
    HardCase(
        "a hundred thousand little clouds",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=15000.0, size=500.0, cover=0.5)))),
        guard="octaves that a sample does not resolve are replaced by their mean (lib/noise.glsl@perlin_3)",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.2),
        without={"light/clouds.glsl": {"= 1.0 - smoothstep(0.15, 0.6, width);\n        if": "= 1.0;\n        if"}},
    ),
)

_CLOUDS = Clouds(size=300.0, height=400.0, depth=100.0, shadows=1.0)


def _scene(elevation: float, **fields: object) -> Scene:
    clouds = _CLOUDS.model_copy(update=fields)
    return Scene(light=Light(sun_elevation=elevation, sun_azimuth=0.8, exposure=-2.0, sky=Sky(clouds=clouds)))


_INVISIBLE_CLOUD_SHADOW = (_scene(0.5, cover=0.0), _scene(0.5, thickness=0.0), _scene(-0.5))

_HARD_CLOUD_SHADOW = (
    HardCase(
        "shadows of clouds out to the horizon",
        _scene(0.5, size=50.0, height=200.0, softness=0.05),
        guard="noise finer than a footprint is replaced by its mean (light/clouds.glsl@shadow)",
        camera=Camera(position=(0.0, 60.0, 0.0), yaw=0.8, pitch=-0.1),
        without={"light/clouds.glsl": {"sqrt(side2 + u_cloud_sunward.w * u_cloud_sunward.w)": "u_cloud_sunward.w"}},
    ),
    HardCase(
        "eye above the clouds that throw shadows",
        _scene(0.5),
        guard="a camera above nine tenths of the clouds' height sees no shadows (light/clouds.glsl@shadow)",
        camera=Camera(position=(0.0, 500.0, 0.0), pitch=-0.6),
        without={"light/clouds.glsl": {"= 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x)": "= 1.0"}},
    ),
)

_BEFORE = Moon(azimuth=0.3, elevation=0.4, size=5.0)

_MOON_INVISIBLE = (Scene(light=Light(sun_elevation=-0.3, sky=Sky(moon=Moon(elevation=-0.2)))),)

_MOON_HARD = (
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
        "stars in the widest view",
        Scene(light=Light(sun_elevation=-1.0, exposure=6.0, sky=Sky(stars=10.0))),
        guard="a star is at most 3e-3 rad wide (light/night.glsl@stars)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.5, pitch=0.8, fov=2.6),
        without={"light/night.glsl": {"clamp(1.5 * pixel, 7e-4, 3e-3)": "max(1.5 * pixel, 7e-4)"}},
    ),
)

CASES = {
    "sun and sky": Cases(
        always_visible="all other effects are seen by it; without it a scene is drawn in white on black",
        hard=_HARD_LIGHT,
    ),
    "clouds": Cases(invisible=_INVISIBLE_CLOUDS, hard=_HARD_CLOUDS),
    "high clouds": Cases(invisible=_NO_STREAKS),
    "shadows of clouds": Cases(invisible=_INVISIBLE_CLOUD_SHADOW, hard=_HARD_CLOUD_SHADOW),
    "moon": Cases(invisible=_MOON_INVISIBLE, hard=_MOON_HARD),
    "stars": Cases(invisible=_STARS_INVISIBLE, hard=_STARS_HARD),
}
