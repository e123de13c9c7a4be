"""Sunlight through thin crests. docs/formulae.md, section 6."""

from seafoam.effects.bounds import crest_limit, surface_top, surface_trough
from seafoam.effects.effect import Bound, Contribution, Effect, SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.quality import Quality
from seafoam.scene.models import (
    Scene,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light`` on translucent water."""
    if scene.light is None:
        return None
    top, trough = surface_top(scene), surface_trough(scene)
    return Contribution(
        why=f"crests up to {top:g} m against the sun",
        slots=(SlotFile("crest", "light/subsurface/translucent.glsl", needs=("light/shade/irradiance.glsl",)),),
        uniforms={
            "u_translucency": number(scene.water.translucency, "/water/translucency"),
            "u_crest_trough": number(significant(trough)),
            "u_crest_height": number(1.0 / (top - trough) if top - trough > 1e-37 else 0.0),
        },
        bound=Bound(
            crest_limit(scene),
            "no crest, no sun on it, or water too dark to let it through",
            ("/light/exposure", "/water/absorption_length", "/water/translucency"),
        ),
    )


EFFECT = Effect("crest light", contribute)
