"""Shadows of boats on the water and on a floor that is seen through it. docs/formulae.md, section 15."""

from seafoam.effects.boats.boat import TRACE
from seafoam.effects.bounds import body_limit
from seafoam.effects.effect import Bound, Contribution, Effect, QualityParameter
from seafoam.effects.shader import SlotFile
from seafoam.quality import Quality
from seafoam.scene.models import Scene

UNDER_SAIL = 0.25
"""Share of the sunlight that a sail transmits."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if there are boats and light, at qualities with ``boat_shadows``."""
    if not scene.boats or scene.light is None or not quality.boat_shadows:
        return None
    return Contribution(
        why="rays to the sun from the water around boats",
        slots=(SlotFile("sunlight", "boats/drawn.glsl@shadow", needs=TRACE),),
        consts={"SUN_UNDER_SAIL": UNDER_SAIL},
        bound=Bound(0.0, "no sunlight") if body_limit(scene) == 0.0 else None,
    )


EFFECT = Effect(
    "boat shadows",
    contribute,
    fields=("/boats",),
    parameters=(QualityParameter("/boat_shadows", "shadows of boats on the water", (False, True), "geometry"),),
)
