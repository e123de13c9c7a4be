"""Wakes of boats, and of stones in a current: sizes and bounds of their waves. docs/formulae.md, sections 15 and 16."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from seafoam.ocean.constants import GRAVITY
from seafoam.scene import Boat, Current
from seafoam.sums import summed

LEAST_SPEED = 0.5
"""Speed below which a boat leaves no wake, m/s."""
NEAR = 2.0
"""Distance from a boat's centre, in its lengths, beyond which the window at its bow is negligible."""
_OPENING = 2800.0
"""Second derivative of a wake's window near the bow, in units of its height over the boat's length squared."""
STONE_CRESTS = 6.0
"""Number of standing waves behind a stone; beyond them a river's turbulence leaves none."""
STONE_LENGTH = 5.0
"""Length over radius of the hull that makes a stone's waves: its cut-off is a wavelength of 0.9 radii."""


@dataclass(frozen=True)
class Obstacle:
    """A stone in a current, as a hull of its breadth that moves against the current as fast as the water flows."""

    speed: float
    length: float
    wake: float
    radius: float = 1e9
    """Its course through the water is straight."""


@dataclass(frozen=True)
class Wake:
    """Properties of a wake. The transverse waves are half as high as the divergent ones."""

    boat: Boat | Obstacle
    crests: float = 12.0
    """Number of transverse waves after which it has ended, at most."""

    @property
    def shows(self) -> bool:
        """Whether the boat is fast enough to leave a wake."""
        return self.boat.speed >= LEAST_SPEED and self.boat.wake > 0.0

    @property
    def k(self) -> float:
        """Wavenumber of the transverse waves, whose phase speed is the boat's: g/v², rad/m."""
        return GRAVITY / max(self.boat.speed, LEAST_SPEED) ** 2

    @property
    def wavelength(self) -> float:
        """Wavelength of the transverse waves, m."""
        return 2.0 * math.pi / self.k

    @property
    def shortest(self) -> float:
        """Wavenumber at which amplitudes fall to 1/e: a hull makes no waves much shorter than its beam; rad/m."""
        return 2.0 * math.pi / (0.18 * self.boat.length)

    @property
    def length(self) -> float:
        """Length of the wake behind the bow along the course, m."""
        return min(self.crests * self.wavelength + 4.0 * self.boat.length, 5.0 * self.boat.radius)

    @property
    def height(self) -> float:
        """Upper bound of the height and depth of the waves, m."""
        return 1.5 * self.boat.wake if self.shows else 0.0

    @property
    def max_slope(self) -> float:
        """Upper bound of the slope: a·k of both systems, and the slope of their windows."""
        if not self.shows:
            return 0.0
        # k exp(-(k/c)²) is greatest at k = c/√2; the transverse waves are the longest.
        peak = max(self.k, self.shortest / math.sqrt(2.0))
        waves = 1.5 * self.boat.wake * peak * math.exp(-((peak / self.shortest) ** 2))
        # The windows at the bow and at the edge, where both systems rise over a tenth of the distance behind the bow.
        windows = self.height * math.exp(-((self.k / self.shortest) ** 2)) * 5.0 / self.boat.length
        # Inside the circle of its course a wake is compressed, to at least 0.75 of its length.
        return (waves + windows) / 0.75

    @property
    def curvature(self) -> tuple[float, float]:
        """Upper bounds of the second derivative, 1/m, within :data:`NEAR` lengths of the boat and elsewhere.

        a·k² of both systems, and the window at the bow, where the wake opens: its width there is proportional to the
        distance from the bow, so its contribution grows with 1/length² and falls with the square of the distance. The
        factor is measured over boats of all speeds, radii and heights, plus a tenth.
        """
        if not self.shows:
            return 0.0, 0.0
        peak = max(self.k, self.shortest)
        waves = 1.5 * self.boat.wake * peak**2 * math.exp(-((peak / self.shortest) ** 2))
        window = _OPENING * self.height * math.exp(-((self.k / self.shortest) ** 2)) / self.boat.length**2
        return (waves + window) / 0.75**2, (waves + window / NEAR**2) / 0.75**2

    def map_error(self, texel: float) -> float:
        """Upper bound of the error of bilinear interpolation in a map with texels of ``texel`` m, m.

        In units of the second derivative of its shortest waves times texel²; the factor is measured, plus a tenth.
        """
        return 0.013 * self.height * math.exp(-((self.k / self.shortest) ** 2)) * (texel * self.shortest) ** 2


def wakes(boats: tuple[Boat, ...]) -> tuple[Wake, ...]:
    """Return every boat's wake, visible or not."""
    return tuple(Wake(boat) for boat in boats)


def stone_wakes(current: Current | None) -> tuple[Wake, ...]:
    """Return the standing waves behind every stone of a current, visible or not."""
    if current is None:
        return ()
    head = current.speed**2 / (2.0 * GRAVITY)
    hulls = (Obstacle(current.speed, STONE_LENGTH * of.radius, of.waves * head) for of in current.stones)
    return tuple(Wake(hull, STONE_CRESTS) for hull in hulls)


def joint_height(wakes: Sequence[Wake]) -> float:
    """Return an upper bound of the joint height of wakes above still water and depth below it, m."""
    return float(f"{summed(wake.height for wake in wakes):.7g}")


def joint_slope(wakes: Sequence[Wake]) -> float:
    """Return an upper bound of the slope of wakes together."""
    return float(f"{summed(wake.max_slope for wake in wakes):.7g}")
