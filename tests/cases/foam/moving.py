"""Test scenes of fronts and of foam that drifts and lives: hard cases, and scenes that cannot show it."""

import math

from seafoam.scene import Drift, DriftSaturation, Foam, FoamLife, FrontSaturation, HeightSaturation, Vortex
from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, Light, ParametricWave, Scene, Shore

_INVISIBLE_FRONT = (
    Scene(foam=Foam()),
    Scene(waves=(ParametricWave(),), foam=Foam(saturation=(FrontSaturation(group=(1.0, 1.0)),), look="halftone")),
)

_HARD_FRONT = (
    reduced(
        "patches anywhere, at any time",
        Scene(
            waves=(ParametricWave(amplitude=0.3), ParametricWave(amplitude=0.3, direction=0.5)),
            foam=Foam(saturation=(FrontSaturation(group=(0.3, 0.9), decay=3.0, variation=0.3, variation_size=5.0),)),
        ),
        "the camera's position in the noise",
        Camera(position=(-1e7, 3.0, 1e7), yaw=1.0, pitch=-0.3),
    ),
)

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-1.0)

_VIEW = Camera(position=(0.0, 9.0, 8.0), pitch=-0.5)

_FOAM_DRIFT = Foam(saturation=(DriftSaturation(),), mask="clump", mask_tile=4.0)

_EDDY = Drift(place=(0.0, -10.0), size=40.0, vortices=(Vortex(place=(0.0, -10.0)),))


def _with(**fields: object) -> Drift:
    return _EDDY.model_copy(update=fields)


_INVISIBLE_DRIFT = (Scene(foam=_FOAM_DRIFT), Scene(drift=_EDDY, foam=Foam(saturation=(DriftSaturation(amount=0.0),))))

_HARD_DRIFT = (
    HardCase(
        "a vortex that turns twice a second",
        Scene(
            light=_LIGHT,
            drift=_with(vortices=(Vortex(place=(0.0, -6.0), radius=0.28, speed=2.0),)),
            foam=Foam(saturation=(DriftSaturation(life=12.0),), mask="clump", mask_tile=4.0),
        ),
        guard="steps in which the fastest vortex turns by at most 1 rad (effects/foam/drift.py)",
        times=(5.0,),
        camera=Camera(position=(0.0, 3.0, -6.0), pitch=-math.pi / 2),
        without={
            "effects/foam/drift.py": {
                "min(quality.drift_step, STEP_TURN * min(quality.drift_step, 1.0) / max(fastest, 1e-6))": (
                    "quality.drift_step"
                )
            }
        },
    ),
    reduced(
        "drifting foam ten thousand kilometres away, after thirty years",
        Scene(
            light=_LIGHT,
            drift=_with(
                place=(9.99e6, -9.99e6), vortices=(Vortex(place=(9.99e6 + 1.3, -9.99e6 + 3.7)),), current=(0.3, 0.1)
            ),
            foam=_FOAM_DRIFT,
        ),
        "ages, the number of the generation, and the vector from the square's centre to the camera",
        Camera(position=(9.99e6, 9.0, -9.99e6 + 18.0), pitch=-0.5),
        times=(-1e9, 1e9 + 3.1),
    ),
    HardCase(
        "more drifting foam than the water holds, times foam by height",
        Scene(
            light=_LIGHT,
            waves=(ParametricWave(amplitude=0.2, wavelength=5.0),),
            drift=_EDDY,
            foam=Foam(
                saturation=(DriftSaturation(amount=4.0, coverage=0.95), HeightSaturation(base=-0.2, full=0.4)),
                combine="product",
                mask="clump",
                mask_tile=4.0,
            ),
        ),
        guard="the filtered look clamps each saturation to 1 before the product (foam/saturation/drift.glsl@map)",
        times=(12.0,),
        camera=_VIEW,
        without={"effects/foam/drift.py": {': 1.0 if foam.look == "filtered" else SATURATION_CAP': ": SATURATION_CAP"}},
    ),
)

_LIFE = FoamLife(wind_drift=0.3, windrows=1.0, windrow_spacing=4.0)

_FOAM_LIVING = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, life=_LIFE)

_HARD_LIVING = (
    reduced(
        "foam that has drifted for thirty years",
        Scene(waves=(ParametricWave(amplitude=0.2, wavelength=6.0),), foam=_FOAM_LIVING),
        "displacement by the drift, as a phase of the mask,",
        Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
    ),
    HardCase(
        "foam next to none and next to whole, of all ages",
        Scene(
            waves=(ParametricWave(amplitude=1.0, wavelength=6.0, exponent=2.0),),
            foam=_FOAM_LIVING.model_copy(update={"saturation": (HeightSaturation(base=0.0, full=1.0),)}),
        ),
        guard="ridges of the windrows at least -1, so that they take no more foam than there is "
        "(foam/living.glsl@windrows); saturation at least 1e-6 in its logarithm (foam/living.glsl@living)",
        camera=Camera(position=(0.37, 12.0, -0.21), yaw=1.0, pitch=-0.6),
        without={"foam/living.glsl": {"uint(WINDROW_SEED))), -1.0)": "uint(WINDROW_SEED))), -1e30)"}},
    ),
    HardCase(
        "foam on a coast without surf",
        Scene(light=None, shore=Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0), foam=_FOAM_LIVING),
        guard="gradient of the waves' phase divided by a length of at least 1e-6 (foam/carry.glsl@shore)",
        camera=Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2),
        without={"shore/waves.glsl": {"max(length(out_to_sea), 1e-6)": "length(out_to_sea)"}},
    ),
)

CASES = {
    "front foam": Cases(invisible=_INVISIBLE_FRONT, hard=_HARD_FRONT),
    "drifting foam": Cases(invisible=_INVISIBLE_DRIFT, hard=_HARD_DRIFT),
    "foam that lives": Cases(always_visible="a mask that is moved is another everywhere", hard=_HARD_LIVING),
}
