"""Hard cases of foam.relief, and scenes that call for it and cannot show it."""

import math

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FrontSaturation, HeightSaturation
from seafoam.scene.light import Light
from seafoam.scene.living import FoamLife
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave

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
        name="foam under a low sun",
        scene=Scene(light=Light(sun_elevation=0.1, sun_azimuth=2.0), foam=_FOAM),
        guard="the sun's height at least 1/4 in the length of shades (foam/relief.glsl)",
        without="shades of 0.5 m instead of 0.2: 23 % of samples off by more than 2 levels, 2.2 in the mean",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
    ),
    HardCase(
        name="foam under a sun overhead",
        scene=Scene(light=Light(sun_elevation=math.pi / 2), foam=_FOAM),
        guard="shades shorter than a footprint fade out, their length in that at least 1e-6 m (foam/relief.glsl)",
        without="not faded, foam shades itself: 9 % of samples off by more than 2 levels, 0.9 in the mean; a "
        "length of 0: nothing on llvmpipe",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
    ),
    HardCase(
        name="foam with the eye all but on it",
        scene=Scene(
            light=Light(),
            foam=_FOAM.model_copy(update={"thickness": 1.0, "mask_tile": 0.05}),
        ),
        guard="sides of the footprint at least 1e-6 m before they are widened (foam/relief.glsl)",
        without="half a thickness over 0 is infinite, and so is the footprint: 0.13 levels in every sample",
        camera=Camera(position=(0.0, 1e-25, 0.0), pitch=-math.pi / 2),
    ),
)

CASES = {"foam relief": Cases(invisible=_INVISIBLE, hard=_HARD)}
