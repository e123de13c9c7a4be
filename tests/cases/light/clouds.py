"""Hard cases of light.clouds, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import IN_FLOAT32
from support.scenes import Camera, Cirrus, Clouds, Light, Scene, Sky

_THIN = Sky(clouds=Clouds(thickness=0.0))

_INVISIBLE = (Scene(light=Light(sky=_THIN)), Scene(light=Light(sky=Sky(clouds=Clouds(cover=0.0)))))

_NO_STREAKS = (
    Scene(light=Light(sky=Sky(cirrus=Cirrus(cover=0.0)))),
    Scene(light=Light(sky=Sky(cirrus=Cirrus(thickness=0.0)))),
)

_HARD_STREAKS = (
    HardCase(
        "high clouds anywhere, at any time",
        Scene(light=Light(exposure=-2.0, sky=Sky(cirrus=Cirrus(cover=0.7)))),
        guard="the camera's position in the noise is reduced in float64, along the streaks and across "
        "(framegraph/evaluation.py)",
        times=(-1e9, 0.0, 1e9),
        camera=Camera(position=(1e7, 3.0, -1e7), pitch=0.3),
        without=IN_FLOAT32,
    ),
)

_HARD = (
    HardCase(
        "clouds anywhere, at any time",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
        guard="the camera's position in the noise is reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 0.0, 1e9),
        camera=Camera(position=(1e7, 3.0, -1e7), pitch=0.3),
        without=IN_FLOAT32,
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
        "lamp overhead",
        Scene(light=Light(sun_elevation=math.pi / 2, exposure=-2.5, sky=Sky(clouds=Clouds(cover=0.7)))),
        guard="the lamp's horizontal direction is divided by at least 1e-6 (light/clouds.glsl@layer)",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.5),
        unseen="not needed: the azimuth of a lamp overhead is a unit vector in float64, whatever its heading",
    ),
    HardCase(
        "rain all around, looked up to from below",
        Scene(
            light=Light(
                exposure=-2.0, sky=Sky(clouds=Clouds(cover=0.95, thickness=20.0, height=400.0, depth=5000.0, rain=10.0))
            )
        ),
        guard="the level part of a look is at least 0.001 of it (light/clouds.glsl@rain)",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=1.4, fov=1.5),
        unseen="no sample looks straight up",
    ),
    HardCase(
        "a hundred thousand little clouds",
        Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=15000.0, size=500.0, cover=0.5)))),
        guard="octaves that a sample does not resolve are replaced by their mean (lib/noise.glsl@perlin_3)",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.2),
        without={
            "light/clouds.glsl": {
                "float kept = 1.0 - smoothstep(0.15, 0.6, width);\n        if": "float kept = 1.0;\n        if"
            }
        },
    ),
)

CASES = {
    "clouds": Cases(invisible=_INVISIBLE, hard=_HARD),
    "high clouds": Cases(invisible=_NO_STREAKS, hard=_HARD_STREAKS),
}
