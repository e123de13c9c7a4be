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
from seafoam.scene.waves import ParametricWave, Ring, Sea
from support.cases import Cases, HardCase
from support.hard.mutations import guards, reference
from support.scenes import Boat, Camera, Light, Scene, Shore, Surf

_INVISIBLE_HEIGHT = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.5, full=1.0)), look="halftone"),
    ),
)

_HARD_HEIGHT = (
    HardCase(
        "heights that the eye sees, from between the crests and along them",
        Scene(
            waves=(
                ParametricWave(amplitude=1.0, wavelength=9.0, exponent=3.0),
                ParametricWave(amplitude=1e-12, wavelength=0.05, exponent=0.3),
            ),
            foam=Foam(saturation=(HeightSaturation(base=0.2, full=0.201),)),
        ),
        guard="water above the camera is averaged as if seen vertically; lengths divided by at least 1e-6, deviation "
        "of heights at least a thousandth of the ramp (foam/saturation/height.glsl@seen, "
        "foam/saturation/height.glsl@level)",
        camera=Camera(position=(4.5, -0.1125, 0.0), yaw=1.5707963, pitch=-0.05),
        without={
            "foam/saturation/height.glsl": {
                "over > 0.0 ? min(over / (way * along) * u_height_wave.w, 1.0) : 1.0": (
                    "min(over / (way * along) * u_height_wave.w, 1.0)"
                )
            }
        },
        missed_by=reference("foam/shader_functions", "seen_height_equals_its_float64_form[0.7]"),
    ),
)

_INVISIBLE_SLOPE = (
    Scene(foam=Foam(saturation=(SlopeSaturation(),), look="halftone")),
    Scene(
        waves=(ParametricWave(amplitude=0.0),),
        foam=Foam(saturation=(HeightSaturation(base=-0.2, full=1.0), SlopeSaturation(blur=1.0)), look="filtered"),
    ),
)

_HARD_SLOPE = (
    HardCase(
        "foam on walls",
        Scene(
            waves=(ParametricWave(amplitude=3.0, wavelength=4.0, exponent=6.0),),
            foam=Foam(saturation=(SlopeSaturation(gain=1000.0),), look="fading"),
        ),
        guard="f clamped to [0, 4] (foam/saturation/slope.glsl@lack)",
        camera=Camera(position=(0.0, 6.0, 0.0), pitch=-0.5),
        without={"foam/saturation/slope.glsl": {"u_slope_base), 0.0, SLOPE_MOST)": "u_slope_base), -1e30, 1e30)"}},
        missed_by=reference("foam/slope_and_cells", "slope_saturation_equals_its_float64_form[4.0-0.0]"),
    ),
    HardCase(
        "foam on the steepest of many rings",
        Scene(
            rings=tuple(
                Ring(place=(0.4 * i, -8.0), birth=-0.1 * i, amplitude=0.05, decay=0.3, wavelength=0.8 + 0.2 * i)
                for i in range(8)
            ),
            foam=Foam(saturation=(SlopeSaturation(gain=12.0, base=0.02),), look="filtered"),
        ),
        guard="the slope variance that the footprint filters out is added (foam/saturation/slope.glsl@lack)",
        times=(2.0, 4.0),
        camera=Camera(position=(0.0, 4.0, 0.0), pitch=-0.4),
        without={"foam/saturation/slope.glsl": {"dot(wave.yz, wave.yz) + wave.w": "dot(wave.yz, wave.yz)"}},
        missed_by=guards("foam", "functions_are_guarded[a slope that the footprint filters out]"),
    ),
)

_BEACH = Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0)

_FOAM_SURF = Foam(saturation=(SurfSaturation(),), mask="clump")

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0)

_VIEW = Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2)

_INVISIBLE_SURF = (
    Scene(foam=_FOAM_SURF),
    Scene(shore=_BEACH.model_copy(update={"surf": Surf(height=0.0)}), foam=_FOAM_SURF),
)

_HARD_SURF = (
    HardCase(
        "surf foam on water as level as its ground",
        Scene(
            light=_LIGHT, shore=_BEACH.model_copy(update={"slope": 0.01, "surf": Surf(height=0.05)}), foam=_FOAM_SURF
        ),
        guard="change of depth over a footprint at least 1 mm (foam/saturation/surf.glsl@front_filtered)",
        times=(0.0, 2.3),
        camera=_VIEW,
        without={"foam/saturation/surf.glsl": {", 1e-3, 0.15)": ", 0.0, 0.15)"}},
        missed_by=guards("foam", "functions_are_guarded[surf on level ground under level water]"),
    ),
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

_NEAR = Camera(position=(0.37, 6.0, -0.21), yaw=1.0, pitch=-0.2)

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
    HardCase(
        "more foam than there is sea",
        Scene(
            sea=Sea(wind=60.0, model="gerstner"),
            foam=Foam(saturation=(WhitecapSaturation(coverage=10.0, softness=0.01, decay=60.0),), look="textured"),
        ),
        guard="f at most 1 (foam/saturation/whitecap.glsl@whitecap), threshold found by bisection "
        "(ocean/foam/whitecaps.py)",
        camera=Camera(position=(0.37, 90.0, -0.21), yaw=1.0, pitch=-0.3),
        times=(1e9,),
        without={"foam/saturation/whitecap.glsl": {".z, 1.0)), 1.0)": ".z, 1.0)), 1e30)"}},
        missed_by=guards("foam", "functions_are_guarded[whitecaps of nine times]"),
    ),
    HardCase(
        "a sea too flat to fold",
        Scene(sea=Sea(wind=0.2, fetch=100.0), foam=Foam(saturation=(WhitecapSaturation(),))),
        guard="no foam where the mean square of J - 1, J the Jacobian, is below 1e-8 (ocean/foam/whitecaps.py)",
        camera=_NEAR,
        without={"ocean/foam/whitecaps.py": {"min(now, earlier) < 1e-8 or ": ""}},
        missed_by=guards("foam", "a_sea_that_is_too_flat_has_no_whitecaps"),
    ),
)

CASES = {
    "height foam": Cases(invisible=_INVISIBLE_HEIGHT, hard=_HARD_HEIGHT),
    "slope foam": Cases(invisible=_INVISIBLE_SLOPE, hard=_HARD_SLOPE),
    "surf foam": Cases(invisible=_INVISIBLE_SURF, hard=_HARD_SURF),
    "wake foam": Cases(invisible=_INVISIBLE_WAKE_FOAM, hard=_HARD_WAKE_FOAM),
    "whitecaps": Cases(invisible=_INVISIBLE_WHITECAPS, hard=_HARD_WHITECAPS),
}
