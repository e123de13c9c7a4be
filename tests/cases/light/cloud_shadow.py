"""Hard cases of light.cloud_shadow, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import IN_FLOAT32
from support.scenes import Boat, Camera, Clouds, Light, Scene, Shore, Sky

_CLOUDS = Clouds(size=300.0, height=400.0, depth=100.0, shadows=1.0)


def _scene(elevation: float, **fields: object) -> Scene:
    clouds = _CLOUDS.model_copy(update=fields)
    return Scene(light=Light(sun_elevation=elevation, sun_azimuth=0.8, exposure=-2.0, sky=Sky(clouds=clouds)))


_INVISIBLE = (_scene(0.5, cover=0.0), _scene(0.5, thickness=0.0), _scene(-0.5))

_HARD = (
    HardCase(
        "shadows of clouds anywhere, at any time",
        _scene(0.5),
        guard="the camera's position in the noise is reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 0.0, 1e9),
        camera=Camera(position=(1e7, 30.0, -1e7), pitch=-0.2),
        without=IN_FLOAT32,
    ),
    HardCase(
        "shadows of clouds under a sun that touches the horizon",
        _scene(1e-3),
        guard="the way to the clouds is that over a round earth (effects/light/clouds.py)",
        camera=Camera(position=(0.0, 30.0, 0.0), pitch=-0.2),
        unseen="such a sun has next to no light",
    ),
    HardCase(
        "shadows of clouds that leave next to no light",
        _scene(0.5, cover=1.0, thickness=50.0, softness=0.05),
        guard="a column's transmittance is divided by at least 1e-4 (effects/light/clouds.py)",
        camera=Camera(position=(0.0, 30.0, 0.0), pitch=-0.2),
        unseen="not needed: the thickest overcast leaves more",
    ),
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
        without={
            "light/clouds.glsl": {
                "float under = 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x)": "float under = 1.0"
            }
        },
    ),
    HardCase(
        "shadows of clouds, of a hill and of a boat on each other",
        _scene(0.3).model_copy(
            update={
                "boats": (Boat(centre=(-38.0, 0.0), radius=14.0, speed=0.0, length=9.0),),
                "shore": Shore(kind="island", size=160.0, radius=25.0, depth=6.0, height=14.0, slope=0.3, shadows=True),
            }
        ),
        guard="none needed: the shares of the sun multiply, and none is above its greatest (planner/slots.py)",
        camera=Camera(position=(-60.0, 9.0, -20.0), yaw=0.3, pitch=-0.15, fov=math.pi / 3),
        unseen="not needed: no factor is above 1",
    ),
)

CASES = {"shadows of clouds": Cases(invisible=_INVISIBLE, hard=_HARD)}
