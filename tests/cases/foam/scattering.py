"""Hard cases of foam.scattering, and scenes that name it but in which it is invisible."""

import math

from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, FoamScattering, FrontSaturation, HeightSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Water
from seafoam.scene.waves import ParametricWave
from support.cases import Cases, HardCase

_INVISIBLE = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(
            saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)),
            combine="product",
            scattering=FoamScattering(),
        ),
    ),
)


def _foam(layer: FoamScattering) -> Foam:
    return Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),), scattering=layer)


_HARD = (
    HardCase(
        "flat foam seen along its surface against the sun",
        Scene(
            light=Light(sun_elevation=0.0, sun_azimuth=0.0, exposure=-3.0),
            foam=_foam(FoamScattering(optical_depth=0.5, roughness=0.0, forward=1.0)),
            water=Water(roughness=0.05),
        ),
        guard="mean cosines of lumps at least 0.001 (foam/shading.glsl@scattering)",
        without="0/0 where neither sun nor eye sees the front of smooth foam",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=math.pi / 2, pitch=-0.01),
    ),
)

_VARIANTS = (
    Scene(foam=_foam(FoamScattering()), light=Light()),
    Scene(foam=_foam(FoamScattering()).model_copy(update={"thickness": 0.1}), light=Light()),
)

CASES = {"foam scattering": Cases(invisible=_INVISIBLE, hard=_HARD, variants=_VARIANTS)}
