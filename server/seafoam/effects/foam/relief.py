"""Foam's thickness: it shadows water, and its edges toward the sun are brighter. docs/formulae.md, section 6."""

from seafoam.effects.bounds import body_limit, foam_limit, greatest_saturation
from seafoam.effects.effect import Bound, Contribution, Effect, QualityParameter
from seafoam.effects.registry import saturation_fields
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number
from seafoam.ocean.stokes import foam_life
from seafoam.quality import Quality
from seafoam.scene.models import Scene

SHADE = 0.6
"""Share of the sun's light that foam blocks; the rest passes through it."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if foam has a thickness and there is light, at qualities with ``foam_relief``."""
    foam = scene.foam
    if foam is None or scene.light is None or foam.thickness == 0.0 or not quality.foam_relief:
        return None
    most = min(greatest_saturation(foam, scene), 1.0)
    beside = "foam/shading.glsl@beside"
    if foam.look == "filtered":
        beside = (
            "foam/shading.glsl@beside_lying" if foam_life(scene) is not None else "foam/shading.glsl@beside_filtered"
        )
    return Contribution(
        why=f"foam {foam.thickness:g} m thick casts shadows",
        slots=(SlotFile("relief", "foam/shading.glsl@relief", needs=(beside,)),),
        consts={"FOAM_SHADE": SHADE},
        uniforms={"u_foam_thickness": number(foam.thickness, "/foam/thickness")},
        bound=Bound(
            0.0 if most == 0.0 else body_limit(scene) + foam_limit(foam, scene),
            "no foam that could cast a shadow",
            saturation_fields(scene),
        ),
    )


EFFECT = Effect(
    "foam relief",
    contribute,
    fields=("/foam/thickness",),
    parameters=(QualityParameter("/foam_relief", "shading by foam thickness", (False, True), "geometry"),),
)
