"""How high and how steep the rings of a scene can be together: bounds that hold anywhere and at any time.

A ring reaches a place only with its front, so there its amplitude is never above that of the age at which the front
arrives: a bound that falls with the distance from its centre. The greatest sum over the plane of such falling bounds
lies among the centres and is closed in by halving squares, the most promising first (branch and bound).
"""

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.dispersion import wavenumber
from seafoam.scene.models import Scene
from seafoam.scene.rings import Ring

SOFT = 0.25
"""Radius of a ring's rounded centre, in wavelengths."""
FRONT = 1.0
"""Width of a ring's front, and of its tail's end, in wavelengths."""
STEEPER = math.hypot(1.0, 1.5 / (2.0 * math.pi * FRONT))
"""The slope of wave and front together over the wave's own, at most."""

_CLOSE = 0.02
_SQUARES = 3000


@dataclass(frozen=True)
class Train:
    """A ring's numbers: k (rad/m), ω (rad/s), front's speed c (m/s), wavelength over this floor (m), life (s)."""

    ring: Ring
    k: float
    omega: float

    @property
    def speed(self) -> float:
        return self.omega / self.k

    @property
    def length(self) -> float:
        return 2.0 * math.pi / self.k

    @property
    def soft(self) -> float:
        return SOFT * self.length

    @property
    def tail(self) -> float:
        """What lies behind the front, m; as good as endless where the ring names no crests."""
        return 1e9 if self.ring.crests is None else self.ring.crests * self.length

    @property
    def reach(self) -> float:
        """Nothing of it ever shows farther from the centre, m: r where ρ(r) is what the front runs in a life."""
        rho = self.speed * self.ring.life
        return math.sqrt(rho * (rho + 2.0 * self.soft))

    def amplitude_at(self, distance: float) -> float:
        """No crest is higher at this distance from the centre, m."""
        rho = distance * distance / (math.sqrt(distance * distance + self.soft * self.soft) + self.soft)
        return max(self.ring.amplitude * math.exp(-self.ring.decay * rho / self.speed) - self.ring.dead, 0.0)


@lru_cache(maxsize=64)
def trains(scene: Scene) -> tuple[Train, ...]:
    """The scene's rings with their numbers; over a floor they keep their frequency and shorten."""
    found = []
    for ring in scene.rings:
        deep = 2.0 * math.pi / ring.wavelength
        found.append(Train(ring, wavenumber(deep, scene.water.depth), math.sqrt(GRAVITY * deep)))
    return tuple(found)


@lru_cache(maxsize=64)
def ring_height(scene: Scene) -> float:
    """No crest of all rings together is higher over still water and no trough deeper, m. Rounded up."""
    return _rounded_up(_greatest(trains(scene), lambda train: 1.0))


@lru_cache(maxsize=64)
def ring_slope(scene: Scene) -> float:
    """No slope of all rings together is steeper. Rounded up."""
    return _rounded_up(_greatest(trains(scene), lambda train: STEEPER * train.k))


@lru_cache(maxsize=64)
def ring_curvature(scene: Scene) -> float:
    """No second derivative of all rings together is greater, 1/m. Rounded up.

    Along the way out: |η″| ≤ A(k² + 2k·1.5/W + 6/W²), W = 2π/k the width of the front; ρ″ ≤ 1/a and across the way out
    ρ′/r ≤ 1/a add slope/a each.
    """
    turn = 2.0 * math.pi * FRONT

    def bend(train: Train) -> float:
        along = train.k**2 * (1.0 + 3.0 / turn + 6.0 / turn**2)
        return along + 2.0 * STEEPER * train.k / train.soft

    return _rounded_up(_greatest(trains(scene), bend))


def _rounded_up(value: float) -> float:
    # Seven digits, so that no processor's last bits show in a plan.
    return float(f"{value * (1.0 + 1e-6):.7g}") if value > 0.0 else 0.0


def _greatest(rings: tuple[Train, ...], weight: Callable[[Train], float]) -> float:
    """Σ weight·amplitude is never above this, anywhere, at any time."""
    shown = [(train, weight(train)) for train in rings if train.ring.life > 0.0]
    if not shown:
        return 0.0
    return min(_over_the_plane(shown), _over_time(shown))


def _over_time(shown: list[tuple[Train, float]]) -> float:
    """The greatest sum of amplitudes wherever they are: just after some birth, for each only sinks from its own."""
    always = sum(w * (t.ring.amplitude - t.ring.dead) for t, w in shown if t.ring.every is not None)
    once = [(t.ring, w) for t, w in shown if t.ring.every is None]
    most = 0.0
    for now, _ in once:
        ages = [(ring, w, now.birth - ring.birth) for ring, w in once]
        most = max(
            most,
            sum(w * max(r.amplitude * math.exp(-r.decay * age) - r.dead, 0.0) for r, w, age in ages if age >= 0.0),
        )
    return always + most


def _over_the_plane(shown: list[tuple[Train, float]]) -> float:
    """The greatest sum of what each ring can be at a place, over all places, closed in to 2 %, from above."""
    places = [train.ring.place for train, _ in shown]
    x, z = (0.5 * (min(p[i] for p in places) + max(p[i] for p in places)) for i in (0, 1))
    half = 0.5 * max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1))

    def above(cx: float, cz: float, h: float) -> float:
        total = 0.0
        for train, w in shown:
            px, pz = train.ring.place
            total += w * train.amplitude_at(math.hypot(max(abs(px - cx) - h, 0.0), max(abs(pz - cz) - h, 0.0)))
        return total

    squares = [(-above(x, z, half), x, z, half)]
    reached = 0.0
    for _ in range(_SQUARES):
        most, cx, cz, h = squares[0]
        reached = max(reached, above(cx, cz, 0.0))
        if h == 0.0 or -most <= (1.0 + _CLOSE) * reached:
            break
        heapq.heappop(squares)
        h *= 0.5
        for sx, sz in ((-h, -h), (-h, h), (h, -h), (h, h)):
            heapq.heappush(squares, (-above(cx + sx, cz + sz, h), cx + sx, cz + sz, h))
    return -squares[0][0]
