"""Hard cases of boats.wake, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import TIME, guards
from support.scenes import Boat, Camera, Foam, Scene, SlopeSaturation

_FAST = Boat(centre=(0.0, -30.0), radius=30.0, bearing=1.2, speed=4.0, wake=0.3)

_ABOVE = Camera(position=(0.0, 30.0, -20.0), pitch=-math.pi / 2)

_INVISIBLE = (
    Scene(boats=(_FAST.model_copy(update={"speed": 0.0}),)),
    Scene(boats=(_FAST.model_copy(update={"wake": 0.0}),)),
)

_HARD = (
    HardCase(
        "the edge of a wake, where both systems meet",
        Scene(boats=(_FAST,), foam=Foam(saturation=(SlopeSaturation(),), look="textured")),
        guard="a wake has height only where the square root in its phase exceeds 0 (boats/wake.glsl@pattern)",
        camera=_ABOVE,
        without={"boats/wake.glsl": {"at.x <= 0.0 || square <= 0.0": "at.x <= 0.0"}},
    ),
    HardCase(
        "the centre of a boat's circle, and straight behind it",
        Scene(boats=(_FAST.model_copy(update={"radius": 13.5}),)),
        guard="distance from the centre at least a tenth of the radius, tangent at most 5000 (boats/wake.glsl@way, "
        "boats/wake.glsl@pattern)",
        camera=_ABOVE.model_copy(update={"position": (0.0, 20.0, -30.0)}),
        without={
            "boats/wake.glsl": {
                "max(length(from), 0.1 * radius)": "length(from)",
                "max(q, 1e-4)": "q",
                "max(q * q, 1e-8)": "(q * q)",
            }
        },
        missed_by=guards("waves", "wakes_at_the_centre_and_on_the_course"),
    ),
    HardCase(
        "a wake from thirty years ago",
        Scene(boats=(_FAST,)),
        guard="the bearing on the course reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9),
        camera=_ABOVE,
        without=TIME,
    ),
)

CASES = {"wakes": Cases(invisible=_INVISIBLE, hard=_HARD)}
