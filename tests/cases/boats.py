"""Test scenes of boats and their wakes: hard cases, and scenes that name them but in which they are invisible."""

import math

from support.cases import Cases, HardCase, reduced
from support.scenes import Boat, Camera, Foam, Light, ParametricWave, Scene, Shore, SlopeSaturation, Surf, Water

_NEAR = Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.6, speed=0.0)

_BEACH = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0, surf=Surf(height=1.5))

_HARD_BOAT = (
    HardCase(
        "a boat on a breaking crest",
        Scene(
            waves=(ParametricWave(amplitude=6.0, wavelength=12.0, exponent=6.0, direction=1.2),),
            boats=(_NEAR.model_copy(update={"smoothing": 0.0, "length": 4.0, "bearing": 1.45}),),
        ),
        guard="a boat tilts by at most 45 degrees (boats/pose.glsl@pass)",
        times=(0.0, 0.7, 1.4),
        camera=Camera(position=(0.0, 9.0, 16.0), pitch=-0.2),
        without={"boats/pose.glsl": {"slope /= max(length(slope), 1.0);": ""}},
    ),
    HardCase(
        "a boat on dry land",
        Scene(
            shore=_BEACH,
            boats=(Boat(centre=(-10.0, 0.0), radius=9.0, bearing=0.5, speed=0.0, length=6.0),),
            light=Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0),
            water=Water(scattering=0.01),
        ),
        guard="ground above the keel supports the boat (boats/pose.glsl@aground)",
        camera=Camera(position=(-30.0, 7.0, 9.0), yaw=1.4, pitch=-0.2),
        without={"boats/pose.glsl": {"max(waves(p).x, shore_floor(shore_place(p)).x + draught)": "waves(p).x"}},
    ),
    reduced(
        "a boat ten thousand kilometres away, after thirty years",
        Scene(
            waves=(ParametricWave(amplitude=0.3, wavelength=9.0),),
            boats=(_NEAR.model_copy(update={"centre": (-9999990.0, 9999980.0), "speed": 3.0}),),
        ),
        "bearing and vector from the centre of the course",
        Camera(position=(-9999990.0, 9.0, 10000000.0), pitch=-0.2),
    ),
    HardCase(
        "eye in a boat",
        Scene(boats=(Boat(centre=(0.0, -50.0), radius=50.0, length=30.0, bearing=1.57, speed=0.0),)),
        guard="intersections behind the camera are discarded (boats/hull.glsl@hull)",
        camera=Camera(position=(0.0, 1.0, 1.0), pitch=-0.2),
        without={
            "boats/hull.glsl": {"max(enter.w, least)": "enter.w", "leave > least": "true", ") > least": ") > -1e9"}
        },
    ),
)

_FAST = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0, wake=0.3)

_ABOVE = Camera(position=(0.0, 30.0, -20.0), pitch=-math.pi / 2)

_INVISIBLE = (
    Scene(boats=(_FAST.model_copy(update={"speed": 0.0}),)),
    Scene(boats=(_FAST.model_copy(update={"wake": 0.0}),)),
)

_HARD_WAKE = (
    HardCase(
        "the edge of a wake, where both systems meet",
        Scene(boats=(_FAST,), foam=Foam(saturation=(SlopeSaturation(),), look="textured")),
        guard="a wake has height only where the square root in its phase exceeds 0 (boats/wake.glsl@pattern)",
        camera=_ABOVE,
        without={"boats/wake.glsl": {"at.x <= 0.0 || square <= 0.0": "at.x <= 0.0"}},
    ),
)

CASES = {
    "boats": Cases(always_visible="a boat stands over the water and before it", hard=_HARD_BOAT),
    "boat shadows": Cases(always_visible="a boat takes the sun from the water beside it"),
    "wakes": Cases(invisible=_INVISIBLE, hard=_HARD_WAKE),
}
