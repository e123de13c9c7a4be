"""Hard cases of light.subsurface, and scenes that call for it and cannot show it."""

import math

from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.water import Ripples, Water
from seafoam.scene.waves import ParametricWave
from support.cases import Cases, HardCase

_INVISIBLE = (
    Scene(),
    Scene(waves=(ParametricWave(),), water=Water(translucency=0.0)),
    Scene(waves=(ParametricWave(),), light=Light(sun_elevation=-0.3)),
    Scene(waves=(ParametricWave(),), water=Water(absorption_length=(0.5, 0.5, 0.5))),
)

_HARD = (
    HardCase(
        name="crests of a millionth of a metre",
        scene=Scene(
            waves=(ParametricWave(amplitude=1e-6, wavelength=3.0),),
            light=Light(sun_elevation=0.1),
            water=Water(ripples=Ripples()),
        ),
        guard="the height relative to the greatest height, with 1/height in float64 (effects/light/subsurface.py)",
        without="no difference here; 0/0 is NaN where the water is level",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
    ),
    HardCase(
        name="the thickest crest in the clearest water",
        scene=Scene(
            waves=(ParametricWave(amplitude=50.0, wavelength=300.0),) * 4,
            light=Light(sun_elevation=0.05),
            water=Water(translucency=2.0, absorption_length=(1000.0, 1000.0, 0.01)),
        ),
        guard="absorption lengths are at least 0.01 m (scene/water.py); the square of the relative height is at "
        "most 1 (light/shade.glsl@translucent)",
        without="no difference: the light is at most 9, well within half floats",
        camera=Camera(position=(0.0, 210.0, 0.0), yaw=math.pi / 2, pitch=-0.2),
    ),
    HardCase(
        name="no crest at all",
        scene=Scene(
            waves=(ParametricWave(amplitude=0.0),), water=Water(translucency=2.0), light=Light(sun_elevation=0.1)
        ),
        guard="1/height counts as 0 if the water is level (effects/light/subsurface.py)",
        without="0 times 1/0: NaN in every sample toward the sun",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
    ),
)

CASES = {"crest light": Cases(invisible=_INVISIBLE, hard=_HARD)}
