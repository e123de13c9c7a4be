"""Test scenes of spray: hard cases, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import TIME_AND_PLACE, guards
from support.scenes import Burst, Camera, Light, ParametricWave, Scene, Sea, Shore, Spray, Surf

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

_SEA = Sea(wind=22.0, fetch=250000.0, wind_direction=1.45, seed=9)

_DECK = Camera(position=(0.0, 18.0, 0.0), yaw=-0.25, pitch=-0.13)

_INVISIBLE = (
    Scene(spray=Spray()),
    Scene(waves=(ParametricWave(amplitude=0.1),), spray=Spray()),
    Scene(sea=Sea(wind=0.0), spray=Spray()),
    Scene(sea=Sea(), spray=Spray(crests=0.0)),
    Scene(shore=_ROCK.model_copy(update={"surf": Surf(height=0.0)}), spray=Spray(), light=None),
)

_HARD = (
    HardCase(
        "spray under the camera",
        Scene(shore=_ROCK, spray=Spray(size=0.1, mist=0.5), light=_LIGHT),
        guard="drops fade out from 1 m to 0.3 m from the camera (spray/drawn.glsl@vertex)",
        times=(0.9, 1.6),
        camera=Camera(position=(-13.3, 2.5, 2.1), pitch=-math.pi / 2, fov=2.0),
        without={"spray/drawn.glsl": {" * smoothstep(0.3, 1.0, depth) * (1.0 - around)": ""}},
    ),
    HardCase(
        "spray of waves ten thousand kilometres away, after thirty years",
        Scene(waves=_WAVES, spray=Spray(threshold=0.5), light=_LIGHT),
        guard="drop ages and the camera position reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9),
        camera=Camera(position=(1e7, 5.0, -1e7), pitch=-0.15),
        without=TIME_AND_PLACE,
    ),
    HardCase(
        "spray on rocks ten thousand kilometres away, after thirty years",
        Scene(shore=_ROCK.model_copy(update={"place": (-9999900.0, 9999900.0)}), spray=Spray(life=6.0), light=_LIGHT),
        guard="periods and the camera position reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9),
        camera=_VIEW.model_copy(update={"position": (-9999933.0, 4.6, 9999915.0)}),
        without=TIME_AND_PLACE,
    ),
    HardCase(
        "spray from crests and troughs, where waves have no slope",
        Scene(waves=_WAVES, spray=Spray(threshold=0.1, life=0.2, size=0.1), light=_LIGHT),
        guard="squared slope of at least 0.02 (spray/births.glsl@breaking)",
        camera=Camera(position=(0.0, 5.0, 0.0), pitch=-0.15),
        without={"spray/births.glsl": {"max(dot(fronts.yz, fronts.yz), 0.02)": "dot(fronts.yz, fronts.yz)"}},
    ),
    HardCase(
        "drops of a thousandth of a sample",
        Scene(shore=_ROCK, spray=Spray(size=0.002, mist=0.0), light=_LIGHT),
        guard="a drop is at least 1.5 samples wide, and hides as much of them (spray/drawn.glsl@vertex)",
        times=(1.2,),
        camera=_VIEW,
        without={"spray/drawn.glsl": {"max(size, 0.75)": "size"}},
        missed_by=guards("waves", "drops_are_the_references"),
    ),
    HardCase(
        "spray before the brightest sun, ten stops up",
        Scene(shore=_ROCK, spray=Spray(), light=_LIGHT.model_copy(update={"exposure": 10.0})),
        guard="the light of a drop is at most 64, so that half floats hold sums of a thousand (spray/drawn.glsl@lit)",
        times=(1.2,),
        camera=_VIEW,
        without={"spray/drawn.glsl": {"SPRAY_BRIGHTEST = 64.0": "SPRAY_BRIGHTEST = 1e30"}},
        missed_by=guards("waves", "sums_of_drops_stay_below_the_greatest_half_float"),
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
