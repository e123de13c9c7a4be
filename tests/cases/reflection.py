"""Test scenes of mirrors: hard cases, and scenes that call for them and cannot show them."""

from support.cases import Cases, HardCase
from support.scenes import Boat, Camera, Light, ParametricWave, Scene, Shore

_HARD_CUBEMAP = (
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
        "a mirror at grazing, eye among crests",
        Scene(light=_MIRROR, boats=(_BOAT,), waves=(ParametricWave(amplitude=0.8, wavelength=7.0, direction=1.2),)),
        guard="reflected rays start where the camera's ray meets the water, not at the still-water level "
        "(surface/main.glsl@main)",
        camera=Camera(position=(0.0, 0.4, 12.0), pitch=0.0),
        without={"surface/main.glsl": {"vec3(p.x, u_eye_height + tau * ray.y, p.y)": "vec3(p.x, 0.0, p.y)"}},
    ),
)

CASES = {
    "cube map": Cases(always_visible="the air gives light at night too", hard=_HARD_CUBEMAP),
    "planar reflection": Cases(invisible=_INVISIBLE_PLANAR, hard=_HARD_PLANAR),
}
