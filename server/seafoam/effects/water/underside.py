"""What an eye under the surface sees: Snell's window, total reflection, the floor. docs/formulae.md, section 11."""

from seafoam.effects.effect import Contribution, Effect, SlotFile
from seafoam.quality import Quality
from seafoam.scene.models import (
    Scene,
)

WATER = "water/underside/water.glsl"
"""The water between an eye under the surface and what it sees."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.view_below``, where there is light or foam to see."""
    if not scene.water.view_below or (scene.light is None and scene.foam is None):
        return None
    if scene.light is None:
        return Contribution(
            why="an eye under the surface sees its foam",
            slots=(SlotFile("below", "water/underside/flat.glsl"),),
        )
    return Contribution(
        why="an eye under the surface sees through it, and what it mirrors",
        slots=(SlotFile("below", "water/underside/main.glsl", needs=(WATER,)),),
    )


EFFECT = Effect("view from below", contribute)
