"""Hard cases of boats.shadow."""

from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water
from support.cases import Cases, HardCase

_HARD = (
    HardCase(
        "shadow of a boat under a low sun over a floor",
        Scene(
            boats=(Boat(centre=(-13.4, -18.1), radius=14.0, bearing=0.3, speed=0.0, length=9.0),),
            light=Light(sun_elevation=0.25, sun_azimuth=0.6, exposure=-2.0),
            water=Water(depth=1.5, floor_tile=1.0, scattering=0.05, absorption_length=(4.0, 20.0, 30.0)),
        ),
        guard="quadratic coefficients of at least 1e-7 in rays to the sun (boats/hull.glsl@hull)",
        without="no change on llvmpipe: no ray to the sun is parallel to an axis of the boat",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=-0.2),
    ),
)

CASES = {"boat shadows": Cases(always_visible="a boat takes the sun from the water beside it", hard=_HARD)}
