"""Foam behind boats. docs/formulae.md, section 15."""

import math

from seafoam.effects.boats.wake import WAY
from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.effect import Bound, Contribution, Effect, SaturationSource, SlotFile
from seafoam.effects.noise import VALUE_NOISE
from seafoam.framegraph.rules import Constant, array, significant
from seafoam.ocean.wakes import LEAST_SPEED
from seafoam.quality import Quality
from seafoam.scene.foam import WakeSaturation
from seafoam.scene.models import Scene

HULL_SPEED = 1.25
"""Speed over the square root of the length, √m/s, at which the bow's foam reaches its full amount."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if a saturation has source ``wake``."""
    if scene.foam is None:
        return None
    wake = scene.foam.source(WakeSaturation)
    if wake is None:
        return None
    if wake_limit(wake, scene) == 0.0:
        return Contribution(
            why="no boat moves",
            bound=Bound(0.0, "no boat moves"),
        )
    amounts = []
    for boat in scene.boats:
        moves = boat.speed >= LEAST_SPEED
        share = min(boat.speed / (HULL_SPEED * math.sqrt(boat.length)), 1.0)
        amounts.append(
            (
                wake.amount if moves else 0.0,
                significant(wake.life * max(boat.speed, LEAST_SPEED)),
                significant(wake.bow * share * share) if moves else 0.0,
                0.0,
            )
        )
    filtered = scene.foam.look == "filtered"
    torn = "foam/saturation/torn.glsl" if filtered else "foam/saturation/torn_exact.glsl"
    return Contribution(
        why=f"foam behind boats, {wake.life:g} s to 1/e",
        slots=(SlotFile("saturation", "foam/saturation/wake.glsl", prefix="wake", needs=(*VALUE_NOISE, torn, *WAY)),),
        consts={"WAKE_CAP": 1.0 if filtered else SATURATION_CAP},
        uniforms={"u_wake_foam": array("vec4", [Constant(value=value) for value in amounts], len(amounts))},
    )


def wake_limit(wake: WakeSaturation, scene: Scene) -> float:
    """Return the greatest wake saturation: 0 if no boat moves."""
    if not any(boat.speed >= LEAST_SPEED for boat in scene.boats):
        return 0.0
    return min(len(scene.boats) * (1.2 * wake.amount + 1.7 * wake.bow), SATURATION_CAP)


EFFECT = Effect("wake foam", contribute, saturation=SaturationSource(WakeSaturation, wake_limit))
