"""Hard cases of spray.spray, and scenes that name it but in which it is invisible."""

import math

from seafoam.effects.effect import Cases, HardCase
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.spray import Spray
from seafoam.scene.waves import ParametricWave

_ROCK = Shore(
    kind="island",
    size=120.0,
    radius=11.0,
    depth=9.0,
    height=7.0,
    slope=0.9,
    smoothing=3.0,
    surf=Surf(height=2.6, period=8.0),
)

_LIGHT = Light(sun_elevation=0.5, sun_azimuth=-1.5, exposure=-2.0)

_WAVES = (
    ParametricWave(amplitude=1.5, wavelength=20.0, direction=1.6, exponent=2.0),
    ParametricWave(amplitude=0.6, wavelength=9.0, direction=2.1, exponent=1.5),
)

_VIEW = Camera(position=(-33.0, 4.6, 15.0), yaw=1.12, pitch=0.03, fov=0.62)

_INVISIBLE = (
    Scene(spray=Spray()),
    Scene(waves=(ParametricWave(amplitude=0.1),), spray=Spray()),
    Scene(shore=Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0), spray=Spray()),
    Scene(shore=_ROCK.model_copy(update={"surf": Surf(height=0.0)}), spray=Spray(), light=None),
)

_HARD = (
    HardCase(
        name="spray under the camera",
        scene=Scene(shore=_ROCK, spray=Spray(size=0.1, mist=0.5), light=_LIGHT),
        guard="drops fade out from 1 m to 0.3 m from the camera (spray/vertex.glsl)",
        without="discs cover the whole picture: mean error 13 levels",
        times=(0.9, 1.6),
        camera=Camera(position=(-13.3, 2.5, 2.1), pitch=-math.pi / 2, fov=2.0),
    ),
    HardCase(
        name="spray of waves ten thousand kilometres away, after thirty years",
        scene=Scene(waves=_WAVES, spray=Spray(threshold=0.5), light=_LIGHT),
        guard="drop ages and the camera position reduced in float64 (framegraph/evaluation.py)",
        without="in float32: drops start in time steps of 64 s and at positions in steps of 1 m",
        times=(-1e9, 1e9),
        camera=Camera(position=(1e7, 5.0, -1e7), pitch=-0.15),
    ),
    HardCase(
        name="spray on rocks ten thousand kilometres away, after thirty years",
        scene=Scene(
            shore=_ROCK.model_copy(update={"place": (-9999900.0, 9999900.0)}), spray=Spray(life=6.0), light=_LIGHT
        ),
        guard="periods and the camera position reduced in float64 (framegraph/evaluation.py)",
        without="in float32: bursts in time steps of 64 s, eight periods of the surf",
        times=(-1e9, 1e9),
        camera=_VIEW.model_copy(update={"position": (-9999933.0, 4.6, 9999915.0)}),
    ),
    HardCase(
        name="spray from crests and troughs, where waves have no slope",
        scene=Scene(waves=_WAVES, spray=Spray(threshold=0.0, life=0.2, size=0.1), light=_LIGHT),
        guard="squared slope of at least 0.02 (spray/waves.glsl)",
        without="drops leave crests at unlimited speed: up to 3.9 levels off",
        camera=Camera(position=(0.0, 5.0, 0.0), pitch=-0.15),
    ),
    HardCase(
        name="spray against the strongest drag and wind",
        scene=Scene(shore=_ROCK, spray=Spray(drag=0.05, wind=40.0, speed=10.0, life=8.0), light=_LIGHT),
        guard="none needed: exp(-267) is 0 (spray/flight.glsl)",
        without="there is no guard to remove",
        times=(1.2,),
        camera=_VIEW,
    ),
    HardCase(
        name="drops of a thousandth of a sample",
        scene=Scene(shore=_ROCK, spray=Spray(size=0.002, mist=0.0), light=_LIGHT),
        guard="a disc is at least 1.5 samples wide, with opacity reduced by the same factor (spray/vertex.glsl)",
        without="drops are visible only where a sample hits them: up to 0.9 levels off",
        times=(1.2,),
        camera=_VIEW,
    ),
    HardCase(
        name="spray before the brightest sun, ten stops up",
        scene=Scene(shore=_ROCK, spray=Spray(), light=_LIGHT.model_copy(update={"exposure": 10.0})),
        guard="none needed: scattered light of sun and sky is at most 12 000 (spray/lit.glsl)",
        without="there is no guard to remove; the value is 2139 here",
        times=(1.2,),
        camera=_VIEW,
    ),
)

CASES = {"spray": Cases(invisible=_INVISIBLE, hard=_HARD)}
