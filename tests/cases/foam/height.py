"""Hard cases of foam.height, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards, reference
from support.scenes import Camera, Foam, FrontSaturation, HeightSaturation, ParametricWave, Scene

_INVISIBLE = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.5, full=1.0)), look="halftone"),
    ),
)

_HARD = (
    HardCase(
        "foam over a millimetre, a hundred metres up",
        Scene(
            waves=(
                ParametricWave(amplitude=50.0, wavelength=400.0),
                ParametricWave(amplitude=50.0, wavelength=400.0),
                ParametricWave(amplitude=1.0, wavelength=300.0),
            ),
            foam=Foam(saturation=(HeightSaturation(base=100.0, full=100.001),), look="halftone"),
        ),
        guard="divisor at least 1e-3 m (foam/saturation/height.glsl@plain)",
        camera=Camera(position=(0.0, 140.0, 0.0), pitch=-0.4),
        without={
            "foam/saturation/height.glsl": {
                "max(u_height_full - u_height_base, 1e-3), 0.0": "(u_height_full - u_height_base), 0.0"
            }
        },
        missed_by=guards("foam", "functions_are_guarded[foam over no height at all]"),
    ),
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

CASES = {"height foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
