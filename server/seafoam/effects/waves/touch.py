"""Rings raised by touches of the water: slopes summed at each sample, from a list that can change without a new plan.

docs/formulae.md, section 2.
"""

import math

from seafoam.effects.effect import Bound, Contribution, Effect
from seafoam.effects.shader import SlotFile
from seafoam.effects.waves.rings import RING_CONSTS
from seafoam.framegraph.rules import FAR, Clamp, Constant, Rule, Term, array, significant
from seafoam.ocean.constants import GRAVITY
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.waves import (
    DEAD,
    DEAD_SHARE,
    TOUCH_CRESTS,
    TOUCH_DECAY,
    TOUCH_LEAST_LENGTH,
    TOUCH_LENGTH,
    TOUCHES_MOST,
    Touch,
)
from seafoam.sums import summed

_LIFE = significant(math.log(1.0 / DEAD_SHARE) / TOUCH_DECAY + 1.0)
"""Age at which every ring has ended, and a second more, s."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has touches."""
    if not scene.touches:
        return None
    velocity = (0.0, 0.0) if scene.current is None else scene.current.velocity
    given: list[Touch | None] = [*scene.touches, *[None] * (TOUCHES_MOST - len(scene.touches))]
    rules = [rule for i, touch in enumerate(given) for rule in _rules(f"/touches/{i}", touch, velocity)]
    return Contribution(
        # The list can change within the plan, so nothing here tells how long it is.
        why=f"up to {TOUCHES_MOST} touches of the water, summed at each sample",
        slots=(SlotFile("detail", "waves/rings.glsl@touch", prefix="touches", needs=("waves/rings.glsl@ring",)),),
        consts={
            "TOUCH_COUNT": TOUCHES_MOST,
            "TOUCH_CRESTS": TOUCH_CRESTS,
            "TOUCH_DECAY": TOUCH_DECAY,
            "TOUCH_GRAVITY": GRAVITY,
            "TOUCH_LEAST_LENGTH": TOUCH_LEAST_LENGTH,
            "TOUCH_LENGTH": TOUCH_LENGTH,
            **RING_CONSTS,
        },
        uniforms={"u_touch": array("vec4", rules, TOUCHES_MOST)},
        bound=_bound(scene),
    )


def _rules(pointer: str, touch: Touch | None, velocity: tuple[float, float]) -> list[Rule]:
    """One touch: the vector from its ring's centre to the camera (m), the ring's age (s), and the strength (m).

    The centre moves with the current from the time of the touch on: -place + velocity * time is the part of the vector
    that does not change, and the planner adds the part that does.
    """
    rules: list[Rule] = []
    for axis, along in enumerate(((1.0, 0.0), (0.0, 1.0))):
        terms = [Term(field=f"{pointer}/place/{axis}", factor=-1.0)]
        values = [0.0 if touch is None else touch.place[axis]]
        if velocity[axis] != 0.0:
            terms.append(Term(field=f"{pointer}/time", factor=velocity[axis]))
            values.append(0.0 if touch is None else touch.time)
        offset = summed(term.factor * value for term, value in zip(terms, values, strict=True))
        rules.append(Clamp(offset=offset, k=along, low=-FAR, high=FAR, terms=tuple(terms)))
    age = (Term(field=f"{pointer}/time", factor=-1.0),)
    birth = 0.0 if touch is None else touch.time
    rules.append(Clamp(offset=-1.0 * birth, rate=1.0, low=0.0, high=_LIFE, terms=age))
    strength = 0.0 if touch is None else touch.strength
    rules.append(Constant(value=(strength,), field=f"{pointer}/strength", absent=(0.0,)))
    return rules


def _bound(scene: Scene) -> Bound | None:
    """Rings of touches have slopes but no height, so only shading shows them."""
    if scene.light is None:
        return Bound(0.0, "the scene has no light, and touches show by the water's shading alone")
    if all(touch.strength <= DEAD for touch in scene.touches):
        return Bound(0.0, f"no touch is stronger than {DEAD:g} m", ("/touches",))
    return None


EFFECT = Effect("touch", contribute, fields=("/touches",), afloat=("u_touch",))
