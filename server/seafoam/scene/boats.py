"""Boats: their course round a centre, their form, and the numbers of their wakes. docs/formulae.md, section 15."""

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

BOATS_MOST = 4
"""A scene holds no more boats."""
LEAST_SPEED = 0.5
"""Slower boats leave no wake, m/s."""
_GRAVITY = 9.81

_Place = Annotated[float, Field(ge=-1e7, le=1e7)]
_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Rgb = tuple[_Share, _Share, _Share]


class Boat(BaseModel):
    """A boat that floats on the waves and runs round a circle."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    kind: Literal["sail", "motor"] = Field(default="sail", description="sail: a sloop; motor: a small trawler")
    length: float = Field(default=9.0, ge=2.0, le=60.0, description="Length over all, m; everything scales with it")
    centre: tuple[_Place, _Place] = Field(default=(0.0, -40.0), description="Centre (x, z) of its course, m")
    radius: float = Field(default=60.0, ge=5.0, le=2000.0, description="Radius of its course, m")
    bearing: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Where on its course it is at time 0, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    turn: Literal["starboard", "port"] = Field(default="starboard", description="To which side it turns")
    speed: float = Field(default=3.0, ge=0.0, le=20.0, description="Speed, m/s; 0: at anchor, its bow along its course")
    heel: float = Field(
        default=0.0,
        ge=-0.6,
        le=0.6,
        description="How far it leans to starboard besides what the waves do, rad",
        json_schema_extra={"unit": "rad"},
    )
    boom: float = Field(
        default=0.35,
        ge=-1.4,
        le=1.4,
        description="How far its boom is out to starboard, rad",
        json_schema_extra={"unit": "rad"},
    )
    smoothing: float = Field(
        default=1.0,
        ge=0.0,
        le=30.0,
        description="It feels the mean height over a disc of this radius round each hull point, m; 0: the point's own",
    )
    wake: float = Field(default=0.12, ge=0.0, le=2.0, description="Height of the waves at its bow, m; 0: no wake")
    hull: _Rgb = Field(default=(0.045, 0.09, 0.2), description="Reflectance of the hull")
    sails: _Rgb = Field(default=(0.83, 0.81, 0.76), description="Reflectance of sails or wheelhouse")

    @model_validator(mode="after")
    def _course_wider_than_the_boat(self) -> "Boat":
        if self.radius < 1.5 * self.length:
            raise ValueError(f"radius: must be at least 1.5 lengths, {1.5 * self.length:.4g} m")
        return self


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
