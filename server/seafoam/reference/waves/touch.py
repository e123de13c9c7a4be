"""Section 2: rings of touches, at one time, around one origin. They have slopes without height."""

from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from seafoam.reference.types import Floats
from seafoam.reference.waves.rings import OneRing, one_ring, ring_slope_outward
from seafoam.scene.models import Scene
from seafoam.scene.touch import Touch


@dataclass(frozen=True)
class TouchSet:
    """The rings of a scene's touches at one time."""

    rings: tuple[OneRing, ...]

    def gradient(self, x: Floats, z: Floats) -> tuple[Floats, Floats]:
        """(h_x, h_z) of the sum at (x, z), m from the origin; (r,) each."""
        h_x, h_z = np.zeros_like(x), np.zeros_like(x)
        for ring in self.rings:
            outward, inverse = ring_slope_outward(ring, x, z)
            h_x += outward * (x - ring.x) * inverse
            h_z += outward * (z - ring.z) * inverse
        return h_x, h_z


def touch_set(scene: Scene, time: float, origin: tuple[float, float]) -> TouchSet:
    """The rings of the scene's touches at a time (s) around an origin (x, z) in m, carried by the scene's current."""
    states = [_ring(touch, scene, time, origin) for touch in scene.touches]
    return TouchSet(tuple(ring for ring in states if ring.amplitude > 0.0 and ring.front > 0.0))


def _ring(touch: Touch, scene: Scene, time: float, origin: tuple[float, float]) -> OneRing:
    ring = one_ring(touch.ring, None, time, origin)
    if scene.current is None:
        return ring
    since = Fraction(time) - Fraction(touch.time)
    x, z = (
        float(Fraction(place) + Fraction(part) * since - Fraction(middle))
        for place, part, middle in zip(touch.place, scene.current.velocity, origin, strict=True)
    )
    return replace(ring, x=x, z=z)
