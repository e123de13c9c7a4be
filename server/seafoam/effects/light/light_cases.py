"""Hard cases of light.light, and scenes that call for it and cannot show it."""

import math

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.sky import Moon, Sky
from seafoam.scene.water import Chop, Water
from seafoam.scene.waves import ParametricWave

_HARD = (
    HardCase(
        name="sun at the horizon",
        scene=Scene(light=Light(sun_elevation=0.0, turbidity=10.0), water=Water(chop=Chop())),
        guard="the air masses' offsets, 0.03 and 0.09 (docs/formulae.md, section 6)",
        without="sky off by up to 0.8 levels at the horizon",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
    ),
    HardCase(
        name="sun under the horizon",
        scene=Scene(light=Light(sun_elevation=-0.3, turbidity=10.0), water=Water(chop=Chop())),
        guard="the air masses' offsets, 0.03 and 0.09 (docs/formulae.md, section 6)",
        without="sky off by up to 0.03 levels at the horizon",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
    ),
    HardCase(
        name="sun at the zenith",
        scene=Scene(light=Light(sun_elevation=math.pi / 2, turbidity=10.0), water=Water(chop=Chop())),
        guard="the air masses' offsets, 0.03 and 0.09 (docs/formulae.md, section 6)",
        without="1/0 at the horizon; sky off by 15 levels in the mean",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
    ),
    HardCase(
        name="straight up and straight down, no heading",
        scene=Scene(
            light=Light(sun_elevation=math.pi / 2),
            foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="textured"),
        ),
        guard="level directions divided by at least 1e-6 (light/sky/analytic.glsl)",
        without="NaN straight down; no sample of the frame is exactly there, since cos(pi/2) is 6e-17",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=-math.pi / 2, roll=1.0, fov=0.01),
    ),
    HardCase(
        name="the brightest disc, ten stops up",
        scene=Scene(light=Light(sun_elevation=0.1, exposure=10.0)),
        guard="light held at 65504, the greatest half float (light/sky/main.glsl, surface/main.glsl)",
        without="a black sun: SwiftShader stores NaN for what half floats cannot hold; llvmpipe stores 65504",
        camera=Camera(position=(0.0, 5.0, 0.0), yaw=math.pi / 2, pitch=0.1, fov=0.1),
    ),
    HardCase(
        name="ten stops down at night",
        scene=Scene(light=Light(sun_elevation=-math.pi / 2, exposure=-10.0), water=Water(chop=Chop())),
        guard="a floor of 0.002 in the air's light (effects/light/light.py)",
        without="67 % of samples below what half floats hold, 0 there: 2e-5 levels",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
    ),
    HardCase(
        name="sun setting through 0 degrees under a layered sky",
        scene=Scene(light=Light(sun_elevation=0.0, exposure=-1.0, sky=Sky(haze=20.0)), water=Water(chop=Chop())),
        guard="the haze's offset, 0.02 (light/sky/layered.glsl)",
        without="0/0 along the horizon: 85 % of samples off by more than 2 levels",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
    ),
    HardCase(
        name="no lamp at all: the sun down, the moon not yet counted",
        scene=Scene(
            light=Light(sun_elevation=-0.06, exposure=2.0, sky=Sky(moon=Moon(), stars=1.0)),
            water=Water(chop=Chop()),
        ),
        guard="moonlight rises from nothing where the sun's has ended (effects/light/atmosphere.py)",
        without="water and sky jump by 16 levels in the mean as the sun sinks by a hundredth of a degree",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.4, pitch=0.0),
    ),
    HardCase(
        name="fog on the eye",
        scene=Scene(light=Light(visibility=50.0), waves=(ParametricWave(),)),
        guard="Newton never steps back before the slab that holds the waves (surface/march.glsl)",
        without="Newton threw 0.2 % of samples back to the eye: off by 233 levels",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.5, fov=2.6),
    ),
)

CASES = {
    "sun and sky": Cases(
        always_visible="it is the light that everything else is seen by; without it a scene is drawn white on black",
        hard=_HARD,
    )
}
