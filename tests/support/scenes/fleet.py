"""Boats that tests draw and compute, and places over their wakes."""

import numpy as np
from numpy.typing import NDArray

from seafoam.effects.boats.wake import ASIDE
from seafoam.ocean.waves.wakes import Wake
from seafoam.reference.boats.boat import course_of
from support.scenes import Boat

BOATS = (
    Boat(centre=(0.0, -30.0), radius=25.0, bearing=1.2, speed=3.0, smoothing=0.0, length=9.0),
    Boat(
        centre=(10.0, -30.0),
        radius=40.0,
        bearing=-2.1,
        speed=5.0,
        smoothing=0.0,
        length=16.0,
        kind="motor",
        turn="port",
    ),
)


WAKES = (
    Boat(),
    Boat(speed=6.0, length=15.0, radius=200.0, wake=0.4),
    Boat(speed=2.0, length=4.0, radius=10.0, turn="port"),
    Boat(speed=20.0, length=5.0, radius=500.0),
)


def around(boat: Boat, seed: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places over a boat's wake at time 0, and beside it."""
    rng = np.random.default_rng(seed)
    wake, at = Wake(boat), course_of(boat, 0.0, (0.0, 0.0))
    angle = at.bearing - at.turn * (rng.random(count) * 1.2 * wake.length / boat.radius - 0.05)
    far = boat.radius + rng.uniform(-1.0, 1.0, count) * min(0.45 * boat.radius, ASIDE * wake.length)
    return boat.centre[0] + far * np.cos(angle), boat.centre[1] + far * np.sin(angle)
