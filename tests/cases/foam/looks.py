"""Test scenes of looks and material of foam: hard cases, and scenes that name an effect and cannot show it."""

import math
from typing import Any

from seafoam.scene import Foam, FoamLife, FoamScattering, FrontSaturation, HeightSaturation
from support.cases import Bounds, Cases, HardCase
from support.scenes import Camera, Light, ParametricWave, Scene, Water


def _by_height(base: float, full: float, **fields: Any) -> Foam:
    """Foam that is the same all over level water."""
    return Foam(saturation=(HeightSaturation(base=base, full=full),), **fields)


_WAVES = (ParametricWave(amplitude=0.5),)
_TOO_HIGH = HeightSaturation(base=0.6, full=1.0)
_NOWHERE = Foam(saturation=(FrontSaturation(), _TOO_HIGH), combine="product")

_INVISIBLE = (
    Scene(waves=_WAVES, foam=Foam(saturation=(_TOO_HIGH,), look="halftone")),
    Scene(waves=_WAVES, foam=Foam(saturation=(_TOO_HIGH,), look="textured")),
    Scene(waves=_WAVES, foam=_NOWHERE.model_copy(update={"look": "filtered"})),
)

_HARD = (
    HardCase(
        "a fade too small for float32",
        Scene(waves=(ParametricWave(),), foam=Foam(fade=1e-40), light=None),
        guard="divisor of the ramp at least 1e-30 (foam/look.glsl@filtered)",
        without={"foam/look.glsl": {"max(2.0 * fade, 1e-30)": "(2.0 * fade)", "max(part, 1e-30)": "part"}},
    ),
    HardCase(
        "a mask turned in each cell, its thresholds hard",
        Scene(
            foam=_by_height(
                -0.4, 0.6, look="halftone_textured", cells=True, mask_tile=4.0, texture_tile=2.7, texture_second=3.14
            )
        ),
        guard="only the nearest cell is used, whose weight is never 0 (foam/cells.glsl@sharp)",
        camera=Camera(position=(3.0, 1.6, -9.0), yaw=2.0, pitch=-0.5),
        without={
            "foam/cells.glsl": {
                "cell_enter(corner[near], way[near]);": (
                    "float sum = 0.0;\n"
                    "    for (int i = 0; i < 3; ++i) {\n"
                    "        cell_enter(corner[i], way[i]);\n        sum += share[i] * cell_amount(f, p, fp);\n    }"
                ),
                "return cell_amount(f, p, fp);": "return sum;",
            }
        },
    ),
    HardCase(
        "black foam over the brightest glitter",
        Scene(
            foam=_by_height(-0.99, 0.01, mask_tile=1000.0, fade=0.1, albedo=0.0),
            water=Water(roughness=0.01),
            light=Light(sun_elevation=0.3, exposure=10.0, visibility=1e6),
        ),
        guard="foam amount clamped to [0, 1] (foam/look.glsl@filtered)",
        camera=Camera(position=(3.0, 0.3, 0.0), yaw=math.pi / 2, pitch=-0.3, fov=0.3),
        # The share of foam is rounded where it is nearly 1, and the light under it is 65504.
        bounds=Bounds(mean=8.0, share=0.15),
        without={"foam/look.glsl": {"share = clamp(share, 0.0, 1.0);": ""}},
    ),
)

_FOAM_RELIEF = _by_height(-0.4, 0.6, mask="lace", octaves=4, thickness=0.05, life=FoamLife())

_INVISIBLE_RELIEF = (Scene(waves=_WAVES, foam=_NOWHERE.model_copy(update={"thickness": 0.1})),)

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
)

_INVISIBLE_SCATTERING = (Scene(waves=_WAVES, foam=_NOWHERE.model_copy(update={"scattering": FoamScattering()})),)


def _foam_scattering(layer: FoamScattering) -> Foam:
    return _by_height(-0.4, 0.6, scattering=layer)


_VARIANTS_SCATTERING = (
    Scene(foam=_foam_scattering(FoamScattering()), light=Light()),
    Scene(foam=_foam_scattering(FoamScattering()).model_copy(update={"thickness": 0.1}), light=Light()),
)

_INVISIBLE_AERATION = (Scene(waves=_WAVES, foam=_NOWHERE, water=Water(aeration=1.0)),)

CASES = {
    "foam look": Cases(invisible=_INVISIBLE, hard=_HARD),
    "foam relief": Cases(invisible=_INVISIBLE_RELIEF, hard=_HARD_RELIEF),
    "foam scattering": Cases(invisible=_INVISIBLE_SCATTERING, variants=_VARIANTS_SCATTERING),
    "milky water": Cases(invisible=_INVISIBLE_AERATION),
}
