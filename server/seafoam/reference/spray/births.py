"""Section 13: the drops of a scene's spray that are in the air at a time, as they were at birth."""

from __future__ import annotations

import numpy as np

from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray.bursts import from_bursts
from seafoam.reference.spray.drop import Drops, none
from seafoam.reference.spray.rocks import from_rocks, on_rocks
from seafoam.reference.spray.waters import from_waves
from seafoam.reference.types import Floats
from seafoam.scene.models import Scene
from seafoam.scene.spray import DROPS


def drops(scene: Scene, time: float, origin: tuple[float, float], ahead: Floats, coast: Coast | None) -> Drops:
    """All drops of a scene. ``ahead``: (2,) x and z of the ray through the picture's centre."""
    spray = scene.spray
    if spray is None:
        return none()
    thrown = from_bursts(spray.bursts, spray, time, origin, DROPS)
    steady = (
        from_rocks(scene, coast, time, origin)
        if coast is not None and on_rocks(scene)
        else from_waves(scene, time, origin, ahead, coast)
    )
    if steady is None:
        return thrown.of(thrown.strength > 0.0)
    if not spray.bursts:
        return steady.of(steady.strength > 0.0)
    # Of two sources each has half of the drops.
    first = np.arange(DROPS // 2)
    of_bursts = thrown.of(first)
    both = of_bursts.joined(steady.of(first))
    return both.of(both.strength > 0.0)
