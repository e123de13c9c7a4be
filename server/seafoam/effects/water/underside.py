"""The view from below the surface: Snell's window, total reflection, the floor. docs/formulae.md, section 11."""

from seafoam.effects.effect import Contribution, Effect
from seafoam.effects.shader import SlotFile
from seafoam.quality import Quality
from seafoam.scene.models import Scene

WATER = "water/underside.glsl@water"
"""Absorption and scattering between a camera below the surface and what it sees."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene allows views from below (``water.view_below``) and has light or foam."""
    if not scene.water.view_below or (scene.light is None and scene.foam is None):
        return None
    if scene.light is None:
        return Contribution(
            why="from below, the surface shows its foam",
            slots=(SlotFile("below", "water/underside.glsl@flat"),),
        )
    return Contribution(
        why="from below, the surface transmits the sky and reflects the floor",
        slots=(SlotFile("below", "water/underside.glsl@main", needs=(WATER,)),),
    )


EFFECT = Effect("view from below", contribute, fields=("/water/view_below",))
