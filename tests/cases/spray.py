"""Test scenes of spray: hard cases, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase, reduced
from support.scenes import Burst, Camera, Light, ParametricWave, Scene, Sea, Shore, Spray, Surf

ROCK = Shore(
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

ON_ROCKS = Camera(position=(-33.0, 4.6, 15.0), yaw=1.12, pitch=0.03, fov=0.62)

_DECK = Camera(position=(0.0, 18.0, 0.0), yaw=-0.25, pitch=-0.13)

_INVISIBLE = (
    Scene(spray=Spray()),
    Scene(waves=(ParametricWave(amplitude=0.1),), spray=Spray()),
    Scene(sea=Sea(wind=0.0), spray=Spray()),
    Scene(sea=Sea(), spray=Spray(crests=0.0)),
    Scene(shore=ROCK.model_copy(update={"surf": Surf(height=0.0)}), spray=Spray(), light=None),
)

_HARD = (
    HardCase(
        "spray under the camera",
        Scene(shore=ROCK, spray=Spray(size=0.1, mist=0.5), light=_LIGHT),
        guard="drops fade out from 1 m to 0.3 m from the camera (spray/drawn.glsl@vertex)",
        times=(0.9, 1.6),
        camera=Camera(position=(-13.3, 2.5, 2.1), pitch=-math.pi / 2, fov=2.0),
        without={"spray/drawn.glsl": {" * smoothstep(0.3, 1.0, depth) * (1.0 - around)": ""}},
    ),
    reduced(
        "spray of waves ten thousand kilometres away, after thirty years",
        Scene(waves=_WAVES, spray=Spray(threshold=0.5), light=_LIGHT),
        "drop ages and the camera position",
        Camera(position=(1e7, 5.0, -1e7), pitch=-0.15),
    ),
    reduced(
        "spray on rocks ten thousand kilometres away, after thirty years",
        Scene(shore=ROCK.model_copy(update={"place": (-9999900.0, 9999900.0)}), spray=Spray(life=6.0), light=_LIGHT),
        "periods and the camera position",
        ON_ROCKS.model_copy(update={"position": (-9999933.0, 4.6, 9999915.0)}),
    ),
    HardCase(
        "spray from crests and troughs, where waves have no slope",
        Scene(waves=_WAVES, spray=Spray(threshold=0.1, life=0.2, size=0.1), light=_LIGHT),
        guard="squared slope of at least 0.02 (spray/births.glsl@breaking)",
        camera=Camera(position=(0.0, 5.0, 0.0), pitch=-0.15),
        without={"spray/births.glsl": {"max(dot(fronts.yz, fronts.yz), 0.02)": "dot(fronts.yz, fronts.yz)"}},
    ),
    HardCase(
        "a burst upon a burst, and a sea that throws drops beside them",
        Scene(
            sea=Sea(model="gerstner", wind=12.0),
            spray=Spray(bursts=(Burst(height=150.0, radius=0.1), Burst(every=3.0), Burst(birth=-1.0)), reach=100.0),
            light=_LIGHT,
        ),
        guard="optical depths add up; light is their mean, divided where there is any (spray/air.glsl@thick)",
        times=(1.4,),
        camera=_DECK,
        without={"spray/air.glsl": {"sum.a < 1e-4": "false"}},
    ),
)

CASES = {"spray": Cases(invisible=_INVISIBLE, hard=_HARD)}
