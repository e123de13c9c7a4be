"""Test scenes of looks and material of foam: hard cases, and scenes that name an effect and cannot show it."""

import math
from typing import Any

from seafoam.scene import Foam, FoamLife, FoamScattering, FrontSaturation, HeightSaturation
from support.cases import Bounds, Cases, HardCase, reduced
from support.hard.mutations import guards, reference
from support.scenes import Camera, Light, ParametricWave, Scene, Water


def _by_height(base: float, full: float, **fields: Any) -> Foam:
    """Foam that is the same all over level water."""
    return Foam(saturation=(HeightSaturation(base=base, full=full),), **fields)


_WAVES = (ParametricWave(amplitude=0.5),)
_TOO_HIGH = HeightSaturation(base=0.6, full=1.0)
_NOWHERE = Foam(saturation=(FrontSaturation(), _TOO_HIGH), combine="product")

_INVISIBLE = (
    Scene(waves=_WAVES, foam=Foam(saturation=(_TOO_HIGH,), look="halftone")),
    Scene(waves=_WAVES, foam=_by_height(0.4999, 1.4999, look="textured")),
    Scene(waves=_WAVES, foam=_NOWHERE.model_copy(update={"look": "filtered"})),
)

_HARD = (
    HardCase(
        "filtered, a hair above nothing",
        Scene(foam=_by_height(-6.103515625e-05, 0.99993896484375, look="filtered")),
        guard="amount 0 at saturation 0 and 1 at 1, by a step of 1/256 at each end (foam/look.glsl@filtered)",
        without={"foam/look.glsl": {"covered *= smoothstep(0.0, 1.0 / 256.0, s);": ""}},
        missed_by=reference("foam/foam_functions", "filtered_coverage_equals_its_float64_form[0.0-vac-1.5]"),
    ),
    HardCase(
        "filtered, a hair below all",
        Scene(foam=_by_height(-0.99993896484375, 6.103515625e-05, look="filtered")),
        guard="amount 0 at saturation 0 and 1 at 1, by a step of 1/256 at each end (foam/look.glsl@filtered)",
        without={"foam/look.glsl": {"1.0 - (1.0 - covered) * smoothstep(0.0, 1.0 / 256.0, 1.0 - s)": "covered"}},
        missed_by=guards("foam", "foam_closes_before_its_saturation_is_whole"),
    ),
    HardCase(
        "a mask at a thousandth of a texel a pixel",
        Scene(foam=_by_height(-0.5, 0.5, look="filtered", mask_tile=1000.0)),
        guard="half width of the edge at least 5e-4, in thresholds (foam/look.glsl@filtered)",
        camera=Camera(position=(0.0, 0.1, 0.0), pitch=-math.pi / 2),
        without={"foam/look.glsl": {"/ 131072.0, 5e-4)": "/ 131072.0, 0.0)"}},
        missed_by=guards("foam", "functions_are_guarded[a mask that does not change under a footprint]"),
    ),
    HardCase(
        "a mask at a thousand texels a pixel",
        Scene(foam=_by_height(-0.5, 0.5, look="filtered", mask_tile=0.05)),
        guard="level at most the last one, a single texel for the whole mask (foam/look.glsl@filtered)",
        camera=Camera(position=(0.0, 5.0, 0.0), pitch=-math.pi / 2),
        without={"foam/look.glsl": {"clamp(most, 1.0, float(1 << (MASK_LEVELS - 1)))": "max(most, 1.0)"}},
        missed_by=guards("foam", "functions_are_guarded[eight tiles of a mask under a footprint]"),
    ),
    HardCase(
        "needles: footprints of a tenth of a texel by a thousand",
        Scene(foam=_by_height(-0.4, 0.6, look="filtered", mask="vac-1.5", mask_tile=1.0)),
        guard="level at least 0; box at least 0.01 texel wide (foam/look.glsl@filtered)",
        camera=Camera(position=(0.3, 0.02, 0.1), pitch=-0.01),
        without={
            "foam/look.glsl": {
                "int level = max(form, 0);": "int level = form;",
                "<< 23), 1e-2, 0.75 * float(FOAM_SIDE))": "<< 23), 0.0, 0.75 * float(FOAM_SIDE))",
            }
        },
        missed_by=guards("foam", "functions_are_guarded[a footprint without width]"),
    ),
    HardCase(
        "a fade too small for float32",
        Scene(waves=(ParametricWave(),), foam=Foam(fade=1e-40), light=None),
        guard="divisor of the ramp at least 1e-30 (foam/look.glsl@filtered)",
        without={"foam/look.glsl": {"max(2.0 * fade, 1e-30)": "(2.0 * fade)", "max(part, 1e-30)": "part"}},
    ),
    HardCase(
        "four octaves, ten thousand kilometres away",
        Scene(foam=_by_height(-0.4, 0.6, look="filtered", mask="lace", octaves=4, mask_tile=0.7)),
        guard="coordinates reduced modulo a tile before each octave, whose frequency is an integer "
        "(foam/look.glsl@filtered)",
        camera=Camera(position=(9.99e6, 0.4, -9.99e6), yaw=1.0, pitch=-0.5),
        without={"foam/look.glsl": {"octave(fract(uv))": "octave(uv)"}},
        missed_by=guards("foam", "octaves_are_alike_in_every_tile"),
    ),
    reduced(
        "a mask turned in each cell, ten thousand kilometres away",
        Scene(foam=_by_height(-0.4, 0.6, look="filtered", cells=True, mask_tile=0.7)),
        "camera position as whole cells and a fraction, both",
        Camera(position=(9.99e6, 2.4, -9.99e6), yaw=1.0, pitch=-0.5),
        times=(0.0,),
        missed_by=reference("foam/slope_and_cells", "frames_with_cells_and_two_textures_equal_float64[filtered]"),
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
    HardCase(
        "foam with the eye all but on it",
        Scene(light=Light(), foam=_FOAM_RELIEF.model_copy(update={"thickness": 1.0, "mask_tile": 0.05})),
        guard="sides of the footprint at least 1e-6 m before they are widened (foam/shading.glsl@relief)",
        camera=Camera(position=(0.0, 1e-25, 0.0), pitch=-math.pi / 2),
        without={"foam/shading.glsl": {"max(x, 1e-6)": "x", "max(y, 1e-6)": "y"}},
        missed_by=guards("foam", "functions_are_guarded[a footprint that its shade widens]"),
    ),
)

_INVISIBLE_SCATTERING = (Scene(waves=_WAVES, foam=_NOWHERE.model_copy(update={"scattering": FoamScattering()})),)


def _foam_scattering(layer: FoamScattering) -> Foam:
    return _by_height(-0.4, 0.6, scattering=layer)


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

_INVISIBLE_AERATION = (
    Scene(waves=_WAVES, foam=Foam(), water=Water(aeration=1e-6)),
    Scene(waves=_WAVES, foam=_NOWHERE, water=Water(aeration=1.0)),
)

CASES = {
    "foam look": Cases(invisible=_INVISIBLE, hard=_HARD),
    "foam relief": Cases(invisible=_INVISIBLE_RELIEF, hard=_HARD_RELIEF),
    "foam scattering": Cases(invisible=_INVISIBLE_SCATTERING, hard=_HARD_SCATTERING, variants=_VARIANTS_SCATTERING),
    "milky water": Cases(invisible=_INVISIBLE_AERATION),
}
