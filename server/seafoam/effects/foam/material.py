"""Foam as a material: its thickness, light that passes through it, bubbles under it. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import no_foam
from seafoam.effects.effect import Contribution, QualityParameter, part_effect
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.ocean.waves.stokes import foam_life
from seafoam.quality import Quality
from seafoam.scene import Foam, FoamScattering, Scene, Water

ASYMMETRY = 0.75
"""Asymmetry parameter g of the Henyey-Greenstein phase function of light that foam scatters once."""
SHADE = 0.6
"""Share of the sun's light that foam blocks; the rest passes through it."""


def _relief(scene: Scene, foam: Foam, thickness: float, quality: Quality) -> Contribution | None:
    if scene.light is None or not quality.foam_relief:
        return None
    beside = "foam/shading.glsl@beside"
    if foam.look == "filtered" and foam_life(scene) is not None:
        beside = "foam/shading.glsl@beside_lying"
    elif foam.look == "filtered":
        beside = "foam/shading.glsl@beside_filtered"
    return Contribution(
        why=f"foam {thickness:g} m thick casts shadows",
        slots=(SlotFile("relief", "foam/shading.glsl@relief", needs=(beside,)),),
        consts={"FOAM_SHADE": SHADE},
        uniforms={"u_foam_thickness": number(thickness, "/foam/thickness")},
        bound=no_foam(foam, scene),
    )


def _scattering(scene: Scene, foam: Foam, layer: FoamScattering, quality: Quality) -> Contribution | None:
    if scene.light is None:
        return None
    return Contribution(
        why=f"foam of an optical depth of {layer.optical_depth:g}",
        slots=(SlotFile("foam layer", "foam/shading.glsl@scattering"),),
        consts={"FOAM_ASYMMETRY": ASYMMETRY, "FOAM_PHASE": significant((1.0 - ASYMMETRY**2) / (4.0 * math.pi))},
        uniforms={
            "u_foam_depth": number(layer.optical_depth, "/foam/scattering/optical_depth"),
            "u_foam_lumps": number(significant(2.0 / math.pi * layer.roughness**2)),
            "u_foam_forward": number(layer.forward, "/foam/scattering/forward"),
        },
        bound=no_foam(foam, scene),
    )


def _aeration(scene: Scene, water: Water, aeration: float, quality: Quality) -> Contribution | None:
    foam = scene.foam
    if foam is None or scene.light is None:
        return None
    return Contribution(
        why=f"bubbles down to {water.plume_depth:g} m under foam",
        slots=(SlotFile("plume", "water/body.glsl@bubbles", needs=("light/shade.glsl@optics", "lib/refraction.glsl")),),
        uniforms={
            "u_aeration": number(aeration, "/water/aeration"),
            "u_plume_depth": number(water.plume_depth, "/water/plume_depth"),
        },
        bound=no_foam(foam, scene),
    )


RELIEF = part_effect(
    "foam relief",
    _relief,
    "/foam/thickness",
    QualityParameter("/foam_relief", "shading by foam thickness", (False, True), "geometry"),
)
SCATTERING = part_effect("foam scattering", _scattering, "/foam/scattering")
AERATION = part_effect("milky water", _aeration, "/water/aeration", fields=("/water/plume_depth",))
