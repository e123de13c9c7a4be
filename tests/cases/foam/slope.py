"""Hard cases of foam.slope, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards, reference
from support.scenes import Camera, Foam, HeightSaturation, ParametricWave, Ring, Scene, SlopeSaturation

_INVISIBLE = (
    Scene(foam=Foam(saturation=(SlopeSaturation(),), look="halftone")),
    Scene(
        waves=(ParametricWave(amplitude=0.0),),
        foam=Foam(saturation=(HeightSaturation(base=-0.2, full=1.0), SlopeSaturation(blur=1.0)), look="filtered"),
    ),
)

_HARD = (
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

CASES = {"slope foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
