"""Test scenes of where foam is: hard cases, and scenes that name a source but in which it is invisible."""

import math

from seafoam.scene.foam import (
    Foam,
    FrontSaturation,
    HeightSaturation,
    SlopeSaturation,
    SurfSaturation,
    WakeSaturation,
    WhitecapSaturation,
)
from seafoam.scene.waves import ParametricWave, Sea
from support.cases import Cases, HardCase
from support.scenes import Boat, Camera, Scene, Shore, Surf

_INVISIBLE_HEIGHT = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.5, full=1.0)), look="halftone"),
    ),
)

_INVISIBLE_SLOPE = (
    Scene(foam=Foam(saturation=(SlopeSaturation(),), look="halftone")),
    Scene(
        waves=(ParametricWave(amplitude=0.0),),
        foam=Foam(saturation=(HeightSaturation(base=-0.2, full=1.0), SlopeSaturation(blur=1.0)), look="filtered"),
    ),
)

_BEACH = Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0)

_FOAM_SURF = Foam(saturation=(SurfSaturation(),), mask="clump")

_INVISIBLE_SURF = (
    Scene(foam=_FOAM_SURF),
    Scene(shore=_BEACH.model_copy(update={"surf": Surf(height=0.0)}), foam=_FOAM_SURF),
)

_FOAM_WAKE_FOAM = Foam(saturation=(WakeSaturation(),), mask="clump")

_BOAT = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0)

_INVISIBLE_WAKE_FOAM = (
    Scene(foam=_FOAM_WAKE_FOAM),
    Scene(foam=_FOAM_WAKE_FOAM, boats=(_BOAT.model_copy(update={"speed": 0.0}),)),
)

_HARD_WAKE_FOAM = (
    HardCase(
        "white water along a heeled hull, from its keel line to far abeam",
        Scene(
            boats=(_BOAT.model_copy(update={"heel": 0.6}), _BOAT.model_copy(update={"kind": "motor", "bearing": 2.6})),
            foam=Foam(saturation=(WakeSaturation(amount=0.0, bow=0.0, contact=4.0),), look="textured"),
        ),
        guard="distance at least that beyond stem and transom, where the sides go on without a hull "
        "(foam/saturation/wake.glsl@contact)",
        camera=Camera(position=(0.0, 20.0, -20.0), pitch=-math.pi / 2, fov=1.4),
        without={"foam/saturation/wake.glsl": {"if (past > away)": "if (false)"}},
    ),
)

_INVISIBLE_WHITECAPS = (
    Scene(waves=(ParametricWave(),), foam=Foam(saturation=(WhitecapSaturation(), HeightSaturation()), look="halftone")),
    Scene(sea=Sea(choppiness=0.0), foam=Foam(saturation=(WhitecapSaturation(), HeightSaturation()), look="halftone")),
)

_HARD_WHITECAPS = (
    HardCase(
        "foam of an hour's gale, from near to the horizon",
        Scene(sea=Sea(wind=20.0), foam=Foam(saturation=(WhitecapSaturation(),), look="fading")),
        guard="no average over a normal distribution where the footprint filters nothing out "
        "(foam/saturation/whitecap.glsl@whitecap)",
        camera=Camera(position=(0.37, 30.0, -0.21), yaw=1.0, pitch=-0.3),
        times=(3600.0,),
        without={"foam/saturation/whitecap.glsl": {"if (deviation < 0.02 * limits.y)": "if (false)"}},
    ),
)

CASES = {
    "height foam": Cases(invisible=_INVISIBLE_HEIGHT),
    "slope foam": Cases(invisible=_INVISIBLE_SLOPE),
    "surf foam": Cases(invisible=_INVISIBLE_SURF),
    "wake foam": Cases(invisible=_INVISIBLE_WAKE_FOAM, hard=_HARD_WAKE_FOAM),
    "whitecaps": Cases(invisible=_INVISIBLE_WHITECAPS, hard=_HARD_WHITECAPS),
}
