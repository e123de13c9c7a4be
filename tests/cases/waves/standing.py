"""Hard cases of waves.standing, and scenes that name it but in which it is invisible."""

import math

from support.cases import Cases, HardCase
from support.scenes import Camera, Current, Foam, Scene, SlopeSaturation, Stone, WakeSaturation

_STONES = (Stone(place=(0.0, -20.0), radius=0.8, waves=1.0), Stone(place=(4.0, -24.0), radius=10.0, waves=1.0))
_FLOWS = Scene(current=Current(speed=3.0, direction=0.9, stones=_STONES))

_ABOVE = Camera(position=(0.0, 25.0, -18.0), pitch=-math.pi / 2)

_INVISIBLE = (Scene(current=Current(speed=0.4, stones=_STONES)), Scene(current=Current(stones=(Stone(waves=0.0),))))

_HARD = (
    HardCase(
        "the edge of standing waves, and straight behind a stone",
        _FLOWS.model_copy(update={"foam": Foam(saturation=(SlopeSaturation(),), look="textured")}),
        guard="waves only where the square root in their phase exceeds 0 (boats/wake.glsl@pattern)",
        camera=_ABOVE,
        without={"boats/wake.glsl": {"at.x <= 0.0 || square <= 0.0": "at.x <= 0.0"}},
    ),
    HardCase(
        "white water at a stone's middle, and far down the current",
        _FLOWS.model_copy(
            update={"foam": Foam(saturation=(WakeSaturation(amount=4.0, life=60.0, bow=4.0),), look="textured")}
        ),
        guard="exponents at most 80 (foam/saturation/surf.glsl@stones)",
        camera=_ABOVE,
        unseen="not needed: exp of a large negative number is 0, and so is the foam there",
    ),
)

CASES = {"standing waves": Cases(invisible=_INVISIBLE, hard=_HARD)}
