"""Hard cases of foam.relief, and scenes that name it but in which it is invisible."""

import math

from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation
from seafoam.scene.light import Light
from seafoam.scene.living import FoamLife
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave
from support.cases import Cases, HardCase

_FOAM = Foam(
    saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, thickness=0.05, life=FoamLife()
)

_INVISIBLE = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(
            saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product", thickness=0.1
        ),
    ),
)

_HARD = (
    HardCase(
        "foam under a low sun",
        Scene(light=Light(sun_elevation=0.1, sun_azimuth=2.0), foam=_FOAM),
        guard="sine of the sun's elevation at least 1/4 in the length of shadows (foam/shading.glsl@relief)",
        without="shadows of 0.5 m instead of 0.2 m: 23 % of samples off by more than 2 levels, mean 2.2",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
    ),
    HardCase(
        "foam under a sun overhead",
        Scene(light=Light(sun_elevation=math.pi / 2), foam=_FOAM),
        guard="shadows shorter than a footprint fade out, with a length of at least 1e-6 m as divisor "
        "(foam/shading.glsl@relief)",
        without="not faded, foam shadows itself: 9 % of samples off by more than 2 levels, mean 0.9; a length of 0: "
        "no change on llvmpipe",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
    ),
    HardCase(
        "foam with the eye all but on it",
        Scene(
            light=Light(),
            foam=_FOAM.model_copy(update={"thickness": 1.0, "mask_tile": 0.05}),
        ),
        guard="sides of the footprint at least 1e-6 m before they are widened (foam/shading.glsl@relief)",
        without="half a thickness divided by 0 makes the footprint infinite: 0.13 levels in every sample",
        camera=Camera(position=(0.0, 1e-25, 0.0), pitch=-math.pi / 2),
    ),
)

CASES = {"foam relief": Cases(invisible=_INVISIBLE, hard=_HARD)}
