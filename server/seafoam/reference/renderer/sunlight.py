"""The share of the direct sunlight that reaches places past all that throws shadows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seafoam.reference.boats.boat import Fleet
from seafoam.reference.foam.torn import Feet
from seafoam.reference.light.cloud_shadow import sunlight as past_clouds
from seafoam.reference.light.light import Air
from seafoam.reference.shore.shadow import LandShadow
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Floats
from seafoam.scene.models import Scene

Sunlight = Callable[[Floats, Feet], Floats]
"""Share (r,) of the sunlight at places (r, 3), m from the origin, with footprints."""


def open_sun(scene: Scene, air: Air | None, coast: Coast | None) -> Sunlight | None:
    """The product of the shares that land and clouds leave; None if neither throws a shadow."""
    if air is None:
        return None
    parts: list[Sunlight] = []
    if coast is not None and scene.shore is not None and scene.shore.shadows:
        parts.append(LandShadow(coast, air.sun).sunlight)
    layer = None if air.above is None else air.above.clouds
    if layer is not None and layer.clouds.shadows > 0.0 and layer.taken > 0.0:
        parts.append(lambda place, feet: past_clouds(layer, place, feet))
    if not parts:
        return None

    def product(place: Floats, feet: Feet) -> Floats:
        result: Floats = np.prod([part(place, feet) for part in parts], axis=0)
        return result

    return product


def sunlight(air: Air | None, fleet: Fleet | None, past_scenery: Sunlight | None) -> Sunlight | None:
    """The product of the shares that boats and, by ``past_scenery``, land and clouds leave; None if all is lit."""
    if air is None or fleet is None:
        return past_scenery

    def both(place: Floats, feet: Feet) -> Floats:
        past_boats = fleet.sunlight(place, air.sun)
        return past_boats if past_scenery is None else past_boats * past_scenery(place, feet)

    return both
