"""Section 16: where water that a current carries comes from."""

from fractions import Fraction

from seafoam.scene.models import Scene


def afloat(scene: Scene, time: float, origin: tuple[float, float]) -> tuple[float, float]:
    """The origin (x, z) in the frame of the flowing water, which is the ground's at time 0; m."""
    if scene.current is None:
        return origin
    x, z = (
        float(Fraction(place) - Fraction(part) * Fraction(time))
        for place, part in zip(origin, scene.current.velocity, strict=True)
    )
    return x, z
