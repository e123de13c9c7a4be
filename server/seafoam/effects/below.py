"""What an eye under the surface sees: Snell's window, total reflection, floor and water. docs/formulae.md, section 11."""

import math

from seafoam.effects.contribution import (
    Contribution,
    Effect,
    HardCase,
    SlotFile,
    number,
    significant,
)
from seafoam.quality import Quality
from seafoam.scene.level import mean_level
from seafoam.scene.models import (
    Camera,
    Caustics,
    Chop,
    Foam,
    Light,
    ParametricWave,
    Scene,
    Water,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.view_below`` under a light; a shore has a floor of its own."""
    if not scene.water.view_below or scene.light is None or scene.shore is not None:
        return None
    return Contribution(
        why="an eye under the surface sees through it, and what it mirrors",
        slots=(SlotFile("below", "below/main.glsl", needs=("below/find.glsl",)),),
        uniforms={"u_below_level": number(significant(mean_level(scene)))},
    )


_POOL = Water(depth=2.0, floor_tile=0.3, view_below=True, chop=Chop(slope=0.08))
_LIGHT = Light(exposure=-1.5, caustics=Caustics(dispersion=0.0))


def _case(
    name: str, guard: str, without: str, camera: Camera, water: Water = _POOL, light: Light = _LIGHT, wavy: bool = False
) -> HardCase:
    waves = (ParametricWave(amplitude=0.6, wavelength=5.0, phase=math.pi / 2),) if wavy else ()
    return HardCase(
        name=name,
        scene=Scene(waves=waves, water=water, light=light, foam=Foam(look="halftone") if wavy else None),
        guard=guard,
        without=without,
        camera=camera,
    )


EFFECT = Effect(
    "view from below",
    contribute,
    always_visible="an eye under the surface sees nothing else; the plan does not know where the eye will be",
    hard_cases=(),
)
