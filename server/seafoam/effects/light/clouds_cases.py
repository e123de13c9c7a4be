"""Hard cases of light.clouds, and scenes that call for it and cannot show it."""

import math

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.sky import Clouds, Sky

_THIN = Sky(clouds=Clouds(thickness=0.0))

_INVISIBLE = (Scene(light=Light(sky=_THIN)), Scene(light=Light(sky=Sky(clouds=Clouds(cover=0.0)))))

_HARD = (
    HardCase(
        name="clouds anywhere, at any time",
        scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
        guard="the eye's place in the noise reduced in float64 (framegraph/evaluation.py)",
        without="in float32: 45 % of samples off by more than 2 levels at 1e9 s, 1.4 % at 0 s",
        times=(-1e9, 0.0, 1e9),
        camera=Camera(position=(1e7, 3.0, -1e7), pitch=0.3),
    ),
    HardCase(
        name="the layer's way from the horizon to overhead",
        scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=200.0, size=300.0, cover=0.5)))),
        guard="the way to the layer by a quotient, not by a difference of two great numbers (light/clouds/layer.glsl)",
        without="0.9 % of samples off by more than 2 levels, the worst by 9",
        camera=Camera(position=(0.0, 2.0, 0.0), pitch=0.7, fov=1.5),
    ),
    HardCase(
        name="eye above the clouds",
        scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
        guard="no clouds from nine tenths of their height up (light/clouds/layer.glsl)",
        without="the root of a negative number: 21 % of samples off by more than 2 levels",
        camera=Camera(position=(0.0, 9e4, 0.0), pitch=0.1),
    ),
    HardCase(
        name="lamp overhead",
        scene=Scene(light=Light(sun_elevation=math.pi / 2, exposure=-2.5, sky=Sky(clouds=Clouds(cover=0.7)))),
        guard="its level direction divided by at least 1e-6 (light/clouds/layer.glsl)",
        without="0/0: 42 % of samples off by more than 2 levels",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.5),
    ),
    HardCase(
        name="a hundred thousand little clouds",
        scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=15000.0, size=500.0, cover=0.5)))),
        guard="octaves that are too fine to be told apart give way to their mean (lib/noise/perlin_3.glsl)",
        without="80 % of samples off by more than 2 levels: noise finer than a sample",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.2),
    ),
)

CASES = {"clouds": Cases(invisible=_INVISIBLE, hard=_HARD)}
