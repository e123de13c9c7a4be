"""Foam behind boats, and behind stones in a current. docs/formulae.md, sections 15 and 16."""

import math

from seafoam.effects.boats.boat import HULLS
from seafoam.effects.boats.wake import WAY
from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.effect import Contribution, SaturationSource, foam_effect
from seafoam.effects.shader import VALUE_NOISE, Const, SlotFile
from seafoam.effects.waves.current import WAY as STONE_WAY
from seafoam.effects.waves.current import places
from seafoam.framegraph.rules import constants, rounded, significant
from seafoam.ocean.waves.wakes import LEAST_SPEED, Wake, stone_wakes
from seafoam.quality import Quality
from seafoam.scene.foam import Foam, WakeSaturation
from seafoam.scene.models import Scene

HULL_SPEED = 1.25
"""Speed over the square root of the length, √m/s, at which the bow's foam reaches its full amount."""
_CONTACT, _NO_CONTACT = "foam/saturation/wake.glsl@contact", "foam/saturation/wake.glsl@contact_none"
_STILL = "no boat moves, and no stone stands in a current"


def draw(scene: Scene, foam: Foam, wake: WakeSaturation, quality: Quality) -> Contribution:
    if wake_limit(wake, scene) == 0.0:
        return Contribution.invisible(_STILL)
    filtered = foam.look == "filtered"
    torn = "foam/saturation/wake.glsl@torn" if filtered else "foam/saturation/wake.glsl@torn_exact"
    consts: dict[str, Const] = {"WAKE_CAP": 1.0 if filtered else SATURATION_CAP}
    amounts: list[tuple[float, ...]] = []
    if scene.current is not None and _stones(scene):
        # As of boats, each stone a hull of its breadth.
        speed = scene.current.speed
        for stone in scene.current.stones:
            share = min(speed / (HULL_SPEED * math.sqrt(4.0 * stone.radius)), 1.0)
            amounts.append((*rounded((wake.amount * share, wake.life * speed, wake.bow * share)), 0.0))
        files = (*VALUE_NOISE, torn, *STONE_WAY)
        slot = SlotFile("saturation", "foam/saturation/surf.glsl@stones", prefix="stones", needs=files)
        why = f"foam behind stones, {wake.life:g} s to 1/e"
        uniforms = {"u_stone_foam": constants("vec4", amounts)}
        return Contribution(why=why, slots=(slot,), consts=consts, uniforms=uniforms).joined(places(scene.current))
    for boat in scene.boats:
        moves = boat.speed >= LEAST_SPEED
        share = min(boat.speed / (HULL_SPEED * math.sqrt(boat.length)), 1.0)
        amounts.append(
            (
                wake.amount if moves else 0.0,
                significant(wake.life * max(boat.speed, LEAST_SPEED)),
                significant(wake.bow * share * share) if moves else 0.0,
                significant(wake.contact * share) if moves else 0.0,
            )
        )
    needs = (*VALUE_NOISE, torn, *WAY, _CONTACT if wake.contact else _NO_CONTACT)
    hulls = {"u_contact_hull": constants("vec3", (HULLS[boat.kind] for boat in scene.boats))}
    return Contribution(
        why=f"foam behind boats, {wake.life:g} s to 1/e",
        slots=(SlotFile("saturation", "foam/saturation/wake.glsl@wake", prefix="wake", needs=needs),),
        consts=consts,
        uniforms={"u_wake_foam": constants("vec4", amounts), **(hulls if wake.contact else {})},
    )


def _stones(scene: Scene) -> tuple[Wake, ...]:
    """The wakes of the stones that white water stands at. Boats are at anchor where there are any."""
    return tuple(wake for wake in stone_wakes(scene.current) if wake.boat.speed >= LEAST_SPEED)


def wake_limit(wake: WakeSaturation, scene: Scene) -> float:
    """Return the greatest wake saturation: 0 if no boat moves, and no stone stands in a current."""
    if _stones(scene):
        return min(len(_stones(scene)) * (1.2 * wake.amount + 1.3 * wake.bow), SATURATION_CAP)
    if not any(boat.speed >= LEAST_SPEED for boat in scene.boats):
        return 0.0
    return min(len(scene.boats) * (1.2 * (wake.amount + wake.contact) + 1.7 * wake.bow), SATURATION_CAP)


EFFECT = foam_effect("wake foam", draw, SaturationSource(WakeSaturation, wake_limit))
