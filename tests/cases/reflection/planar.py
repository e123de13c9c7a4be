"""Hard cases of reflection.planar, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Boat, Camera, Light, ParametricWave, Ripples, Scene, Water

_BOAT = Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.6, speed=0.0)

_MIRROR = Light(reflection="planar")

_INVISIBLE = (Scene(light=_MIRROR), Scene(light=_MIRROR, waves=(ParametricWave(),)))

_HARD = (
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
        "(surface/main.glsl)",
        camera=Camera(position=(0.0, 0.4, 12.0), pitch=0.0),
        without={"surface/main.glsl": {"vec3(p.x, u_eye_height + tau * ray.y, p.y)": "vec3(p.x, 0.0, p.y)"}},
    ),
)

CASES = {"planar reflection": Cases(invisible=_INVISIBLE, hard=_HARD)}
