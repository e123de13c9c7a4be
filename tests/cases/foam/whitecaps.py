"""Hard cases of foam.whitecaps, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, Foam, HeightSaturation, ParametricWave, Scene, Sea, WhitecapSaturation

_NEAR = Camera(position=(0.37, 6.0, -0.21), yaw=1.0, pitch=-0.2)

_INVISIBLE = (
    Scene(waves=(ParametricWave(),), foam=Foam(saturation=(WhitecapSaturation(), HeightSaturation()), look="halftone")),
    Scene(sea=Sea(choppiness=0.0), foam=Foam(saturation=(WhitecapSaturation(), HeightSaturation()), look="halftone")),
)

_HARD = (
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
        without={
            "foam/saturation/whitecap.glsl": {
                "u_whitecap_variance.z, 1.0)), 1.0)": "u_whitecap_variance.z, 1.0)), 1e30)"
            }
        },
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

CASES = {"whitecaps": Cases(invisible=_INVISIBLE, hard=_HARD)}
