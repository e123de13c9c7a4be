"""Test scenes of foam.material: hard cases, and scenes that name an effect and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import (
    Camera,
    Foam,
    FoamLife,
    FoamScattering,
    FrontSaturation,
    HeightSaturation,
    Light,
    ParametricWave,
    Scene,
    Water,
)

_FOAM_RELIEF = Foam(
    saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, thickness=0.05, life=FoamLife()
)

_INVISIBLE_RELIEF = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(
            saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product", thickness=0.1
        ),
    ),
)

_HARD_RELIEF = (
    HardCase(
        "foam under a low sun",
        Scene(light=Light(sun_elevation=0.1, sun_azimuth=2.0), foam=_FOAM_RELIEF),
        guard="sine of the sun's elevation at least 1/4 in the length of shadows (foam/shading.glsl@relief)",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        without={"foam/shading.glsl": {"max(u_sun_direction.y, 0.25)": "u_sun_direction.y"}},
    ),
    HardCase(
        "foam under a sun overhead",
        Scene(light=Light(sun_elevation=math.pi / 2), foam=_FOAM_RELIEF),
        guard="shadows shorter than a footprint fade out, with a length of at least 1e-6 m as divisor "
        "(foam/shading.glsl@relief)",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        without={"foam/shading.glsl": {"1.0 - smoothstep(0.25, 1.0, max(x, y) / max(length(way), 1e-6))": "1.0"}},
    ),
    HardCase(
        "foam with the eye all but on it",
        Scene(light=Light(), foam=_FOAM_RELIEF.model_copy(update={"thickness": 1.0, "mask_tile": 0.05})),
        guard="sides of the footprint at least 1e-6 m before they are widened (foam/shading.glsl@relief)",
        camera=Camera(position=(0.0, 1e-25, 0.0), pitch=-math.pi / 2),
        without={"foam/shading.glsl": {"max(x, 1e-6)": "x", "max(y, 1e-6)": "y"}},
        missed_by=guards("foam", "functions_are_guarded[a footprint that its shade widens]"),
    ),
)

_INVISIBLE_SCATTERING = (
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(
            saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)),
            combine="product",
            scattering=FoamScattering(),
        ),
    ),
)


def _foam_scattering(layer: FoamScattering) -> Foam:
    return Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),), scattering=layer)


_HARD_SCATTERING = (
    HardCase(
        "flat foam seen along its surface against the sun",
        Scene(
            light=Light(sun_elevation=0.0, sun_azimuth=0.0, exposure=-3.0),
            foam=_foam_scattering(FoamScattering(optical_depth=0.5, roughness=0.0, forward=1.0)),
            water=Water(roughness=0.05),
        ),
        guard="mean cosines of lumps at least 0.001 (foam/shading.glsl@scattering)",
        camera=Camera(position=(0.37, 1.2, -0.21), yaw=math.pi / 2, pitch=-0.01),
        without={"foam/shading.glsl": {"u_foam_lumps)), 1e-3)": "u_foam_lumps)), 0.0)"}},
        missed_by=guards("foam", "functions_are_guarded[smooth foam that neither sun nor eye sees]"),
    ),
)

_VARIANTS_SCATTERING = (
    Scene(foam=_foam_scattering(FoamScattering()), light=Light()),
    Scene(foam=_foam_scattering(FoamScattering()).model_copy(update={"thickness": 0.1}), light=Light()),
)

_FOAM_AERATION = Foam(saturation=(HeightSaturation(base=-0.4, full=0.6),))

_INVISIBLE_AERATION = (
    Scene(waves=(ParametricWave(amplitude=0.5),), foam=Foam(), water=Water(aeration=1e-6)),
    Scene(
        waves=(ParametricWave(amplitude=0.5),),
        foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product"),
        water=Water(aeration=1.0),
    ),
)

_HARD_AERATION = (
    HardCase(
        "milk in water as dark and as clear as it gets",
        Scene(
            foam=_FOAM_AERATION,
            water=Water(
                aeration=10.0, plume_depth=20.0, scattering=0.0, absorption_length=(0.01, 1000.0, 0.01), depth=0.05
            ),
        ),
        guard="reflected light at least 0 (water/body.glsl@bubbles)",
        unseen="not needed: bubbles scatter back at least what the water of their layer does: deep (1 - passed) more; "
        "by rounding none of 2 million random waters was negative",
    ),
)

CASES = {
    "foam relief": Cases(invisible=_INVISIBLE_RELIEF, hard=_HARD_RELIEF),
    "foam scattering": Cases(invisible=_INVISIBLE_SCATTERING, hard=_HARD_SCATTERING, variants=_VARIANTS_SCATTERING),
    "milky water": Cases(invisible=_INVISIBLE_AERATION, hard=_HARD_AERATION),
}
