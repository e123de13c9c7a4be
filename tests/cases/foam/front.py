"""Hard cases of foam.front, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import IN_FLOAT32, guards
from support.scenes import Camera, Foam, FrontSaturation, HeightSaturation, ParametricWave, Scene

_INVISIBLE = (
    Scene(foam=Foam()),
    Scene(waves=(ParametricWave(),), foam=Foam(saturation=(FrontSaturation(group=(1.0, 1.0)),), look="halftone")),
)

_HARD = (
    HardCase(
        "the pole of every crest, C 0.25",
        Scene(
            waves=(ParametricWave(amplitude=0.0, wavelength=2.0),),
            foam=Foam(saturation=(FrontSaturation(intensity=0.25),), look="halftone"),
        ),
        guard="f = 4 where the phase is exactly 0, the pole; exponent clamped to [-80, 80] "
        "(foam/saturation/front.glsl@profile)",
        camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        without={
            "foam/saturation/front.glsl": {
                "signal.y == 0.0 ? 80.0 :": "",
                "clamp((rho + signal.x) / signal.y, -80.0, 80.0)": "(rho + signal.x) / signal.y",
            }
        },
        missed_by="tests/gpu/numerics/test_hard_cases.py::test_front_at_its_pole_and_beyond_the_schemas_c[0.25]",
    ),
    HardCase(
        "the pole of the listing, C 100",
        Scene(
            waves=(ParametricWave(amplitude=0.0, wavelength=2.0),),
            foam=Foam(saturation=(FrontSaturation(intensity=100.0, constants="listing"),), look="listing"),
        ),
        guard="the cotangent of half the phase instead of the published tangent (foam/saturation/front.glsl@profile)",
        camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        without={
            "foam/saturation/front.glsl": {
                "exp(u_front_log_base * exponent)": (
                    "exp(-u_front_log_base * tan(0.5 * atan(signal.y, signal.x) + 0.5 * PI))"
                )
            }
        },
        missed_by="tests/gpu/numerics/test_hard_cases.py::test_front_at_its_pole_and_beyond_the_schemas_c[0.25]",
    ),
    HardCase(
        "no phase at all: waves in antiphase",
        Scene(
            waves=(ParametricWave(amplitude=0.0), ParametricWave(amplitude=0.0, phase=math.pi)),
            foam=Foam(look="textured"),
        ),
        guard="exponent 0 where it would be 0/0 (foam/saturation/front.glsl@profile)",
        camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        apart="the phase of a sum that is 0 is rounding",
        coarse_apart="what is drawn is rounding",
        without={
            "foam/saturation/front.glsl": {
                "rho > 0.0 ? signal.y / (rho - signal.x) : 0.0": "signal.y / (rho - signal.x)"
            }
        },
        missed_by=guards("foam", "functions_are_guarded[a front of no phase]"),
    ),
    HardCase(
        "filtered, where the phase turns endlessly fast",
        Scene(waves=(ParametricWave(amplitude=0.0), ParametricWave(amplitude=0.0, phase=math.pi)), foam=Foam()),
        guard="rho² at least 1e-4 in the phase's gradient, phase width at most 1e4 rad "
        "(foam/saturation/front.glsl@filtered)",
        apart="the phase of a sum that is 0 is rounding",
        coarse_apart="what is drawn is rounding",
        without={
            "foam/saturation/front.glsl": {
                "max(dot(signal, signal), 1e-4)": "dot(signal, signal)",
                "clamp(width, 1e-5, 1e4)": "max(width, 1e-5)",
            }
        },
        missed_by=guards("foam", "functions_are_guarded[a front whose phase turns endlessly fast]"),
    ),
    HardCase(
        "patches anywhere, at any time",
        Scene(
            waves=(ParametricWave(amplitude=0.3), ParametricWave(amplitude=0.3, direction=0.5)),
            foam=Foam(saturation=(FrontSaturation(group=(0.3, 0.9), decay=3.0, variation=0.3, variation_size=5.0),)),
        ),
        guard="the camera's position in the noise is reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9),
        camera=Camera(position=(-1e7, 3.0, 1e7), yaw=1.0, pitch=-0.3),
        without=IN_FLOAT32,
    ),
    HardCase(
        "a gate without width",
        Scene(
            waves=(ParametricWave(amplitude=0.3), ParametricWave(amplitude=0.3, direction=0.5)),
            foam=Foam(
                saturation=(FrontSaturation(group=(0.5, 0.5)), HeightSaturation(base=-0.5, full=2.0)),
                look="halftone",
                combine="max",
            ),
        ),
        guard="upper group threshold at least 1e-4 above the lower one (effects/foam/front.py)",
        without={"effects/foam/front.py": {"max(front.group[1], front.group[0] + 1e-4)": "front.group[1]"}},
        missed_by=guards("foam", "groups_foam_over_a_range"),
    ),
    HardCase(
        "footprints from a hair to the horizon",
        Scene(
            waves=(ParametricWave(amplitude=0.01, wavelength=0.05), ParametricWave(amplitude=0.3, wavelength=2000.0)),
            foam=Foam(),
        ),
        guard="whole periods counted separately, Gauss quadrature over short intervals "
        "(foam/saturation/front.glsl@filtered)",
        times=(0.0, 1e9),
        camera=Camera(position=(0.0, 0.8, 0.0), pitch=-0.2),
        without={"foam/saturation/front.glsl": {"if (i == j && !crosses)": "if (false)"}},
        missed_by=guards("foam", "functions_are_guarded[a front under a hair]"),
    ),
    HardCase(
        "waves that hide their backs, an eye as high as their crests",
        Scene(
            waves=(
                ParametricWave(amplitude=0.5, wavelength=8.0, exponent=2.0),
                ParametricWave(amplitude=0.2, wavelength=5.0, direction=0.6),
            ),
            foam=Foam(),
        ),
        guard="divisor of a ray's fall over the waves' slope at least 1e-20, phase intervals at least 1e-5 rad "
        "(foam/saturation/front.glsl@filtered)",
        times=(0.0, 1e9),
        camera=Camera(position=(0.37, 0.4375, -0.21), yaw=1.2, pitch=-0.05),
        without={
            "foam/saturation/front.glsl": {
                "max(relief * length(p), 1e-20)": "(relief * length(p))",
                "1.0 - q16, 1e-6), 1e-5)": "1.0 - q16, 1e-6), 0.0)",
            }
        },
        missed_by=guards("foam", "functions_are_guarded[a front as high as the eye]"),
    ),
)

CASES = {"front foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
