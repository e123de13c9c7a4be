"""Foam behind boats. docs/formulae.md, section 15."""

import math

from seafoam.effects.boats.wake import WAY
from seafoam.effects.bounds import SATURATION_CAP, wake_limit
from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.effects.light.noise import VALUE_NOISE
from seafoam.framegraph.rules import Constant, array, significant
from seafoam.ocean.wakes import LEAST_SPEED
from seafoam.quality import Quality
from seafoam.scene.boats import Boat
from seafoam.scene.models import Camera, Foam, Scene, WakeSaturation

HULL_SPEED = 1.25
"""Speed over the root of the length, √m/s, at which the bow's foam is full."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``wake``."""
    if scene.foam is None:
        return None
    found = [s for s in scene.foam.saturation if isinstance(s, WakeSaturation)]
    if not found:
        return None
    wake = found[0]
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
    name, torn = ("wake_filtered", ("saturation/torn.glsl",)) if filtered else ("wake", ())
    return Contribution(
        why=f"foam behind boats, {wake.life:g} s to 1/e",
        slots=(SlotFile("saturation", f"saturation/{name}.glsl", prefix="wake", needs=(*VALUE_NOISE, *torn, *WAY)),),
        consts={} if filtered else {"WAKE_CAP": SATURATION_CAP},
        uniforms={"u_wake_foam": array("vec4", [Constant(value=one) for one in amounts], len(amounts))},
    )


_FOAM = Foam(saturation=(WakeSaturation(),), mask="clump")
_BOAT = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0)

EFFECT = Effect(
    "wake foam",
    contribute,
    invisible=(Scene(foam=_FOAM), Scene(foam=_FOAM, boats=(_BOAT.model_copy(update={"speed": 0.0}),))),
    hard_cases=(
        HardCase(
            name="foam at the centre of a boat's circle",
            scene=Scene(
                boats=(_BOAT.model_copy(update={"radius": 13.5, "speed": 20.0}),),
                foam=Foam(saturation=(WakeSaturation(amount=4.0, life=60.0, bow=4.0),), look="halftone"),
            ),
            guard="at least a tenth of the radius, exponents of at most 80 (wake/way.glsl, saturation/wake.glsl)",
            without="nothing on llvmpipe: exponentials end at 0, and no sample is at the centre",
            camera=Camera(position=(0.0, 20.0, -30.0), pitch=-math.pi / 2),
        ),
    ),
)
