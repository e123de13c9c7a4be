"""Test scenes of mirrors: hard cases, and scenes that call for them and cannot show them."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Boat, Camera, Clouds, Light, ParametricWave, Ripples, Scene, Shore, Sky, Water

_INVISIBLE_CUBEMAP = (Scene(light=Light(sun_elevation=-1.2, exposure=-3.0, reflection="cubemap")),)

_HARD_CUBEMAP = (
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
        without={"reflection/mirror.glsl": {"AROUND_HEIGHT + max(shore_floor(eye).x, 0.0)": "AROUND_HEIGHT"}},
    ),
)

_BOAT = Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.6, speed=0.0)

_MIRROR = Light(reflection="planar")

_INVISIBLE_PLANAR = (Scene(light=_MIRROR), Scene(light=_MIRROR, waves=(ParametricWave(),)))

_HARD_PLANAR = (
    HardCase(
        "a mirror under the eye and straight down",
        Scene(light=_MIRROR, boats=(_BOAT,), water=Water(ripples=Ripples())),
        guard="only points in front of the mirrored camera are read (reflection/mirror.glsl@planar)",
        camera=Camera(position=(0.0, 4.0, -2.0), pitch=-1.5708),
        without={"reflection/mirror.glsl": {"if (depth < 1e-3)": "if (false)"}},
        missed_by=guards("ground", "functions_are_guarded[mirror of what is behind]"),
    ),
    HardCase(
        "a mirror at grazing, eye among crests",
        Scene(light=_MIRROR, boats=(_BOAT,), waves=(ParametricWave(amplitude=0.8, wavelength=7.0, direction=1.2),)),
        guard="reflected rays start where the camera's ray meets the water, not at the still-water level "
        "(surface/main.glsl@main)",
        camera=Camera(position=(0.0, 0.4, 12.0), pitch=0.0),
        without={"surface/main.glsl": {"vec3(p.x, u_eye_height + tau * ray.y, p.y)": "vec3(p.x, 0.0, p.y)"}},
    ),
)

CASES = {
    "cube map": Cases(invisible=_INVISIBLE_CUBEMAP, hard=_HARD_CUBEMAP),
    "planar reflection": Cases(invisible=_INVISIBLE_PLANAR, hard=_HARD_PLANAR),
}
