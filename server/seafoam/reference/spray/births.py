"""Section 13: the drops of a scene's spray that are in the air at a time, as they were at birth."""

from __future__ import annotations

import numpy as np

from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray.bursts import from_bursts
from seafoam.reference.spray.drop import Drops, joined, none
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
    sources = [from_bursts(spray, time, origin, DROPS)] if spray.bursts else []
    if coast is not None and on_rocks(scene):
        sources.append(from_rocks(scene, coast, time, origin))
    else:
        sources += from_waves(scene, time, origin, ahead, coast)
    if not sources:
        return none()
    # Of two sources each has half of the drops.
    both = joined([drops.subset(np.arange(DROPS // len(sources))) for drops in sources])
    return both.subset(both.strength > 0.0)
