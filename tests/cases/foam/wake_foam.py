"""Hard cases of foam.wake_foam, and scenes that name it but in which it is invisible."""

import math

from support.cases import Bounds, Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Boat, Camera, Foam, Scene, WakeSaturation

_FOAM = Foam(saturation=(WakeSaturation(),), mask="clump")

_BOAT = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0)

_INVISIBLE = (Scene(foam=_FOAM), Scene(foam=_FOAM, boats=(_BOAT.model_copy(update={"speed": 0.0}),)))

_HARD = (
    HardCase(
        "foam at the centre of a boat's circle",
        Scene(
            boats=(_BOAT.model_copy(update={"radius": 13.5, "speed": 20.0}),),
            foam=Foam(saturation=(WakeSaturation(amount=4.0, life=60.0, bow=4.0),), look="halftone"),
        ),
        guard="distance from the centre at least a tenth of the radius, exponents at most 80 (boats/wake.glsl@way, "
        "foam/saturation/wake.glsl@wake)",
        camera=Camera(position=(0.0, 20.0, -30.0), pitch=-math.pi / 2),
        # An arc tangent that is off by 3e-6 moves the end of the wake, and bubbles at their threshold with it.
        bounds=Bounds(mean=1.0, share=0.01),
        without={"boats/wake.glsl": {"max(length(from), 0.1 * radius)": "length(from)"}},
        missed_by=guards("foam", "functions_are_guarded[the centre of a boat's circle]"),
    ),
    HardCase(
        "white water along a heeled hull, from its keel line to far abeam",
        Scene(
            boats=(_BOAT.model_copy(update={"heel": 0.6}), _BOAT.model_copy(update={"kind": "motor", "bearing": 2.6})),
            foam=Foam(saturation=(WakeSaturation(amount=0.0, bow=0.0, contact=4.0),), look="textured"),
        ),
        guard="distance at least that beyond stem and transom, where the sides go on without a hull "
        "(foam/saturation/wake.glsl@contact)",
        camera=Camera(position=(0.0, 20.0, -20.0), pitch=-math.pi / 2, fov=1.4),
        without={"foam/saturation/wake.glsl": {"if (past > away)": "if (false)"}},
    ),
)

CASES = {"wake foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
