"""Milky water: bubbles under young foam scatter light back. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import body_limit, greatest_saturation
from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.effects.registry import saturation_fields
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has aeration, foam and light."""
    water, foam = scene.water, scene.foam
    if foam is None or scene.light is None or water.aeration == 0.0:
        return None
    most = min(greatest_saturation(foam, scene), 1.0)
    # Light crosses the layer twice, on a path of at most three times its depth: refracted rays are never flatter.
    whitened = 1.0 - math.exp(-3.0 * water.aeration * water.plume_depth * most)
    bound = Bound(
        whitened * body_limit(scene),
        "almost no bubbles, no foam above them, or no light on them",
        ("/light/exposure", "/water/aeration", "/water/plume_depth", *saturation_fields(scene)),
    )
    return Contribution(
        why=f"bubbles down to {water.plume_depth:g} m under foam",
        slots=(SlotFile("plume", "water/body.glsl@bubbles", needs=("light/shade.glsl@optics", "lib/refraction.glsl")),),
        uniforms={
            "u_aeration": number(water.aeration, "/water/aeration"),
            "u_plume_depth": number(water.plume_depth, "/water/plume_depth"),
        },
        # Caustics make a floor brighter than the bound of uniform light.
        bound=None if scene.light.caustics is not None else bound,
    )


EFFECT = Effect("milky water", contribute, fields=("/water/aeration", "/water/plume_depth"))
