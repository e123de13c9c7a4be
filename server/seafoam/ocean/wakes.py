"""Wakes of boats: wavenumbers, sizes and bounds of their waves. docs/formulae.md, section 15."""

import math
from dataclasses import dataclass

from seafoam.ocean.constants import GRAVITY
from seafoam.scene.boats import Boat

LEAST_SPEED = 0.5
"""Speed below which a boat leaves no wake, m/s."""

NEAR = 2.0
"""Distance from a boat's centre, in its lengths, beyond which the window at its bow is negligible."""

_OPENING = 2800.0
"""Second derivative of a wake's window near the bow, in units of its height over the boat's length squared."""


@dataclass(frozen=True)
class Wake:
    """Properties of a wake. The transverse waves are half as high as the divergent ones."""

    boat: Boat

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
        return min(12.0 * self.wavelength + 4.0 * self.boat.length, 5.0 * self.boat.radius)

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


def wake_height(boats: tuple[Boat, ...]) -> float:
    """Return an upper bound of all wakes' joint height above still water and depth below it, m."""
    return float(f"{sum(wake.height for wake in wakes(boats)):.7g}")


def wake_slope(boats: tuple[Boat, ...]) -> float:
    """Return an upper bound of the slope of all wakes together."""
    return float(f"{sum(wake.max_slope for wake in wakes(boats)):.7g}")
