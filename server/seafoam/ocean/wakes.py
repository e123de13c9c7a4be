"""Wakes of boats: the numbers of their waves. docs/formulae.md, section 15."""

import math
from dataclasses import dataclass

from seafoam.scene.boats import Boat

LEAST_SPEED = 0.5
"""Slower boats leave no wake, m/s."""

_GRAVITY = 9.81

NEAR = 2.0
"""Beyond so many lengths from a boat's middle little is left of the window at its bow."""

_OPENING = 2800.0
"""Second derivative of a wake's window near the bow, in its height over its boat's length squared."""


@dataclass(frozen=True)
class Wake:
    """A wake's numbers. Of two systems of waves the crests across are half as high as the spreading ones."""

    boat: Boat

    @property
    def shows(self) -> bool:
        return self.boat.speed >= LEAST_SPEED and self.boat.wake > 0.0

    @property
    def k(self) -> float:
        """Wavenumber of the waves across, which run as fast as the boat: g/v², rad/m."""
        return _GRAVITY / max(self.boat.speed, LEAST_SPEED) ** 2

    @property
    def wavelength(self) -> float:
        """m"""
        return 2.0 * math.pi / self.k

    @property
    def shortest(self) -> float:
        """Waves of 1/e: a hull makes none that are much shorter than it is wide; rad/m."""
        return 2.0 * math.pi / (0.18 * self.boat.length)

    @property
    def length(self) -> float:
        """No wake is left so far behind the bow, on the course, m."""
        return min(12.0 * self.wavelength + 4.0 * self.boat.length, 5.0 * self.boat.radius)

    @property
    def height(self) -> float:
        """No crest is higher and no trough deeper, m."""
        return 1.5 * self.boat.wake if self.shows else 0.0

    @property
    def steepest(self) -> float:
        """No slope is steeper: a·k of both systems, and what their windows add."""
        if not self.shows:
            return 0.0
        # k exp(-(k/c)^2) is greatest at k = c/sqrt 2; no wave is longer than those across.
        peak = max(self.k, self.shortest / math.sqrt(2.0))
        waves = 1.5 * self.boat.wake * peak * math.exp(-((peak / self.shortest) ** 2))
        # The windows at the bow and at the edge, where both systems open over a tenth of the way behind it.
        windows = self.height * math.exp(-((self.k / self.shortest) ** 2)) * 5.0 / self.boat.length
        # Inside the circle a wake is drawn together, at most to 0.75 of its length.
        return (waves + windows) / 0.75

    @property
    def curvature(self) -> tuple[float, float]:
        """No second derivative is greater, 1/m, within :data:`NEAR` lengths of the boat, and elsewhere.

        a·k² of both systems, and the window at the bow, where the wake opens: it is as narrow there as the way behind
        the bow, so its share grows with 1/length² and falls with the square of that way. Its factor is measured over
        boats of every speed, radius and height, with a tenth to spare.
        """
        if not self.shows:
            return 0.0, 0.0
        peak = max(self.k, self.shortest)
        waves = 1.5 * self.boat.wake * peak**2 * math.exp(-((peak / self.shortest) ** 2))
        window = _OPENING * self.height * math.exp(-((self.k / self.shortest) ** 2)) / self.boat.length**2
        return (waves + window) / 0.75**2, (waves + window / NEAR**2) / 0.75**2

    def grain(self, texel: float) -> float:
        """How far a map of ``texel`` m, read bilinearly, stands over what its slopes and its curvature say, m.

        The unit is the second derivative of its shortest waves times texel²; the factor is measured, with a tenth to
        spare.
        """
        return 0.013 * self.height * math.exp(-((self.k / self.shortest) ** 2)) * (texel * self.shortest) ** 2


def wakes(boats: tuple[Boat, ...]) -> tuple[Wake, ...]:
    """Every boat's wake, shown or not."""
    return tuple(Wake(boat) for boat in boats)


def wake_height(boats: tuple[Boat, ...]) -> float:
    """No crest of all wakes together is higher over still water and no trough deeper, m."""
    return float(f"{sum(wake.height for wake in wakes(boats)):.7g}")


def wake_slope(boats: tuple[Boat, ...]) -> float:
    """No slope of all wakes together is steeper."""
    return float(f"{sum(wake.steepest for wake in wakes(boats)):.7g}")
