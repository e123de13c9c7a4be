"""Foam that transmits light and glows against the sun. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import FOAM_ASYMMETRY, body_limit, foam_limit, greatest_saturation
from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.effects.registry import saturation_fields
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if foam has a scattering layer and there is light."""
    foam = scene.foam
    if foam is None or scene.light is None or foam.scattering is None:
        return None
    layer = foam.scattering
    most = min(greatest_saturation(foam, scene), 1.0)
    return Contribution(
        why=f"foam of an optical depth of {layer.optical_depth:g}",
        slots=(SlotFile("foam layer", "foam/shading.glsl@scattering"),),
        consts={
            "FOAM_ASYMMETRY": FOAM_ASYMMETRY,
            "FOAM_PHASE": significant((1.0 - FOAM_ASYMMETRY**2) / (4.0 * math.pi)),
        },
        uniforms={
            "u_foam_depth": number(layer.optical_depth, "/foam/scattering/optical_depth"),
            "u_foam_lumps": number(significant(2.0 / math.pi * layer.roughness**2)),
            "u_foam_forward": number(layer.forward, "/foam/scattering/forward"),
        },
        bound=Bound(
            0.0 if most == 0.0 else body_limit(scene) + foam_limit(foam, scene),
            "no foam",
            saturation_fields(scene),
        ),
    )


EFFECT = Effect("foam scattering", contribute, fields=("/foam/scattering",))
