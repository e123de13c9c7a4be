"""Hard cases of reflection.cubemap, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, Clouds, Light, ParametricWave, Scene, Shore, Sky

_INVISIBLE = (Scene(light=Light(sun_elevation=-1.2, exposure=-3.0, reflection="cubemap")),)

_HARD = (
    HardCase(
        "a mirror with nothing to mirror",
        Scene(light=Light(sun_elevation=-math.pi / 2, exposure=8.0, reflection="cubemap")),
        guard="the search for land is left out of scenes without a shore (reflection/mirror.glsl@open)",
        camera=Camera(position=(0.0, 2.0, 0.0), pitch=-0.2),
        without={
            "effects/light/reflection.py": {
                '("reflection/mirror.glsl@open",)': (
                    '(*SHORE, *lit_land(shore or Shore()), "reflection/mirror.glsl@land_around")'
                )
            }
        },
        error="u_land_detail has no rule",
    ),
    HardCase(
        "the cube map's own corners and edges",
        Scene(
            waves=(ParametricWave(amplitude=1.0, wavelength=3.0, exponent=3.0),),
            light=Light(exposure=-2.0, sun_elevation=0.3, reflection="cubemap", sky=Sky(clouds=Clouds(cover=0.5))),
        ),
        guard="interpolation at the edge of a face uses its last two texels (reflection/cube.glsl@cubemap)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 4, pitch=-0.6),
        without={"reflection/cube.glsl": {"min(ivec2(at), ivec2(CUBE_SIZE - 2))": "ivec2(at)"}},
        missed_by=guards("ground", "functions_are_guarded[texels of a cube]"),
    ),
    HardCase(
        "the middle of the cube map inside a hill",
        Scene(
            shore=Shore(kind="island", size=240.0, radius=40.0, height=30.0, slope=0.4, smoothing=3.0),
            light=Light(exposure=-2.0, reflection="cubemap"),
        ),
        guard="the centre of the cube map is at least a metre above the ground (reflection/mirror.glsl@land_around)",
        camera=Camera(position=(0.0, 60.0, 0.0), pitch=-0.5),
        without={"reflection/mirror.glsl": {"max(AROUND_HEIGHT, shore_floor(eye).x + AROUND_HEIGHT)": "AROUND_HEIGHT"}},
    ),
)

CASES = {"cube map": Cases(invisible=_INVISIBLE, hard=_HARD)}
