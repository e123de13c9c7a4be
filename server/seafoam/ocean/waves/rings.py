"""Bounds of the height and slope of all rings of a scene together, valid at any place and time.

Amplitudes decay, so the amplitude of a ring at a point is at most that when its front arrives: a bound that falls with
the distance from the centre. The maximum over the plane of the sum of these bounds is between the centres; it is found
by branch and bound on squares, the one with the greatest bound first.
"""

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from seafoam.ocean.basics.dispersion import wavenumber
from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Ring, Scene

SOFT = 0.25
"""Radius of a ring's rounded centre, in wavelengths."""
FRONT = 1.0
"""Width of a ring's front, and of its tail's end, in wavelengths."""
STEEPER = math.hypot(1.0, 1.5 / (2.0 * math.pi * FRONT))
"""Upper bound of the slope of wave and front together, relative to the wave's own."""
_TOLERANCE = 0.02
"""Relative gap between bound and attained value at which the search ends."""
_MAX_SQUARES = 3000
"""Number of squares after which the search ends."""


@dataclass(frozen=True)
class Train:
    """Properties of a ring: k (rad/m), ω (rad/s), front speed c (m/s), wavelength at this depth (m), lifetime (s)."""

    ring: Ring
    k: float
    omega: float

    @property
    def speed(self) -> float:
        """Speed of the front, m/s."""
        return self.omega / self.k

    @property
    def length(self) -> float:
        """Wavelength, m."""
        return 2.0 * math.pi / self.k

    @property
    def soft(self) -> float:
        """Radius of the rounded centre, m."""
        return SOFT * self.length

    @property
    def tail(self) -> float:
        """Length of the wave train behind the front, m; practically infinite if the ring gives no number of crests."""
        return 1e9 if self.ring.crests is None else self.ring.crests * self.length

    @property
    def reach(self) -> float:
        """Maximum radius of the ring, m: r where ρ(r) is the distance that its front travels in a lifetime."""
        rho = self.speed * self.ring.life
        return math.sqrt(rho * (rho + 2.0 * self.soft))

    def amplitude_at(self, distance: float) -> float:
        """Return an upper bound of the crests' height at this distance from the centre, m."""
        rho = distance * distance / (math.sqrt(distance * distance + self.soft * self.soft) + self.soft)
        return max(self.ring.amplitude * math.exp(-self.ring.decay * rho / self.speed) - self.ring.dead, 0.0)


@lru_cache(maxsize=64)
def trains(scene: Scene) -> tuple[Train, ...]:
    """Return the scene's rings with their properties; at finite depth they keep their frequency and shorten."""
    result = []
    for ring in scene.rings:
        deep = 2.0 * math.pi / ring.wavelength
        result.append(Train(ring, wavenumber(deep, scene.water.depth), math.sqrt(GRAVITY * deep)))
    return tuple(result)


@lru_cache(maxsize=64)
def ring_height(scene: Scene) -> float:
    """Return an upper bound of the rings' joint height above still water and depth below it, m. Rounded up."""
    return _rounded_up(_greatest(trains(scene), lambda train: 1.0))


@lru_cache(maxsize=64)
def ring_slope(scene: Scene) -> float:
    """Return an upper bound of the slope of all rings together. Rounded up."""
    return _rounded_up(_greatest(trains(scene), lambda train: STEEPER * train.k))


@lru_cache(maxsize=64)
def ring_curvature(scene: Scene) -> float:
    """Return an upper bound of the second derivative of all rings together, 1/m. Rounded up.

    Radially: |η″| ≤ A(k² + 2k·1.5/W + 6/W²), W = 2π/k the width of the front; ρ″ ≤ 1/a and tangentially ρ′/r ≤ 1/a add
    slope/a each.
    """
    turn = 2.0 * math.pi * FRONT

    def bend(train: Train) -> float:
        along = train.k**2 * (1.0 + 3.0 / turn + 6.0 / turn**2)
        return along + 2.0 * STEEPER * train.k / train.soft

    return _rounded_up(_greatest(trains(scene), bend))


def _rounded_up(value: float) -> float:
    # To seven digits, so that plans do not depend on a processor's rounding errors.
    return float(f"{value * (1.0 + 1e-6):.7g}") if value > 0.0 else 0.0


def _greatest(rings: tuple[Train, ...], weight: Callable[[Train], float]) -> float:
    """Return the maximum over all places of Σ weight·bound of the amplitude, from above, to within 2 %."""
    shown = [(train, weight(train)) for train in rings if train.ring.life > 0.0]
    if not shown:
        return 0.0
    places = [train.ring.place for train, _ in shown]
    x, z = (0.5 * (min(p[i] for p in places) + max(p[i] for p in places)) for i in (0, 1))
    half = 0.5 * max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1))

    def above(cx: float, cz: float, h: float) -> float:
        """Bound of the sum within the square of half side h around (cx, cz)."""
        total = 0.0
        for train, w in shown:
            px, pz = train.ring.place
            total += w * train.amplitude_at(math.hypot(max(abs(px - cx) - h, 0.0), max(abs(pz - cz) - h, 0.0)))
        return total

    squares = [(-above(x, z, half), x, z, half)]
    attained = 0.0
    for _ in range(_MAX_SQUARES):
        negative_bound, cx, cz, h = squares[0]
        attained = max(attained, above(cx, cz, 0.0))
        if h == 0.0 or -negative_bound <= (1.0 + _TOLERANCE) * attained:
            break
        heapq.heappop(squares)
        h *= 0.5
        for sx, sz in ((-h, -h), (-h, h), (h, -h), (h, h)):
            heapq.heappush(squares, (-above(cx + sx, cz + sz, h), cx + sx, cz + sz, h))
    return -squares[0][0]
