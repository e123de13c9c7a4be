"""Sunlight transmitted by thin crests. docs/formulae.md, section 6."""

from seafoam.effects.bounds import crest_limit, max_surface_height, min_surface_height
from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a light."""
    if scene.light is None:
        return None
    highest, lowest = max_surface_height(scene), min_surface_height(scene)
    return Contribution(
        why=f"crests of up to {highest:g} m transmit sunlight",
        slots=(SlotFile("crest", "light/shade.glsl@translucent", needs=("light/shade.glsl@irradiance",)),),
        uniforms={
            "u_translucency": number(scene.water.translucency, "/water/translucency"),
            "u_crest_trough": number(significant(lowest)),
            "u_crest_height": number(1.0 / (highest - lowest) if highest - lowest > 1e-37 else 0.0),
        },
        bound=Bound(
            crest_limit(scene),
            "no crests, no sunlight, or water that absorbs all of it",
            ("/light/exposure", "/water/absorption_length", "/water/translucency"),
        ),
    )


EFFECT = Effect("crest light", contribute, fields=("/water/translucency",))
