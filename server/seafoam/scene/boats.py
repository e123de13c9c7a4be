"""Boats: course, shape and wake. docs/formulae.md, section 15."""

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

BOATS_MOST = 4
"""Maximum number of boats in a scene."""
LEAST_SPEED = 0.5
"""Speed below which a boat leaves no wake, m/s."""
_GRAVITY = 9.81

_Place = Annotated[float, Field(ge=-1e7, le=1e7)]
_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Rgb = tuple[_Share, _Share, _Share]


class Boat(BaseModel):
    """A boat that floats on the waves and follows a circular course."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    kind: Literal["sail", "motor"] = Field(default="sail", description="sail: a sloop; motor: a small trawler")
    length: float = Field(
        default=9.0, ge=2.0, le=60.0, description="Overall length, m; all other dimensions scale with it"
    )
    centre: tuple[_Place, _Place] = Field(default=(0.0, -40.0), description="Centre (x, z) of the circular course, m")
    radius: float = Field(default=60.0, ge=5.0, le=2000.0, description="Radius of the course, m; at least 1.5 lengths")
    bearing: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Position on the course at time 0, as an angle about its centre, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    turn: Literal["starboard", "port"] = Field(default="starboard", description="Side to which the boat turns")
    speed: float = Field(default=3.0, ge=0.0, le=20.0, description="Speed, m/s; 0: at anchor, the bow along the course")
    heel: float = Field(
        default=0.0,
        ge=-0.6,
        le=0.6,
        description="Heel to starboard, in addition to that caused by the waves, rad",
        json_schema_extra={"unit": "rad"},
    )
    boom: float = Field(
        default=0.35,
        ge=-1.4,
        le=1.4,
        description="Angle of the boom from the centreline to starboard, rad",
        json_schema_extra={"unit": "rad"},
    )
    smoothing: float = Field(
        default=1.0,
        ge=0.0,
        le=30.0,
        description="Radius of the disc over which the wave height at each hull point is averaged, m; larger "
        "values steady the boat; 0: no averaging",
    )
    wake: float = Field(default=0.12, ge=0.0, le=2.0, description="Amplitude of the waves at the bow, m; 0: no wake")
    hull: _Rgb = Field(default=(0.045, 0.09, 0.2), description="Albedo of the hull, linear RGB")
    sails: _Rgb = Field(default=(0.83, 0.81, 0.76), description="Albedo of the sails or of the wheelhouse, linear RGB")

    @model_validator(mode="after")
    def _course_wider_than_the_boat(self) -> "Boat":
        if self.radius < 1.5 * self.length:
            raise ValueError(f"radius: must be at least 1.5 lengths ({1.5 * self.length:.4g} m)")
        return self


NEAR = 2.0
"""Distance from a boat's middle, in lengths, beyond which the window at its bow is negligible."""
_OPENING = 2800.0
"""Second derivative of a wake's window near the bow, in units of its level over the boat's length squared."""


@dataclass(frozen=True)
class Wake:
    """Properties of a wake. The transverse waves are half as high as the divergent ones."""

    boat: Boat

    @property
    def shows(self) -> bool:
        return self.boat.speed >= LEAST_SPEED and self.boat.wake > 0.0

    @property
    def k(self) -> float:
        """Wavenumber of the transverse waves, whose phase speed is the boat's: g/v², rad/m."""
        return _GRAVITY / max(self.boat.speed, LEAST_SPEED) ** 2

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
    def level(self) -> float:
        """Upper bound of the height and depth of the waves, m."""
        return 1.5 * self.boat.wake if self.shows else 0.0

    @property
    def steepest(self) -> float:
        """Upper bound of the slope: a·k of both systems, and the slope of their windows."""
        if not self.shows:
            return 0.0
        # k exp(-(k/c)^2) is greatest at k = c/sqrt 2; no wave is longer than those across.
        peak = max(self.k, self.shortest / math.sqrt(2.0))
        waves = 1.5 * self.boat.wake * peak * math.exp(-((peak / self.shortest) ** 2))
        # The windows at the bow and at the edge, where both systems open over a tenth of the way behind it.
        windows = self.level * math.exp(-((self.k / self.shortest) ** 2)) * 5.0 / self.boat.length
        # Inside the circle a wake is drawn together, at most to 0.75 of its length.
        return (waves + windows) / 0.75

    @property
    def curvature(self) -> tuple[float, float]:
        """Upper bounds of the second derivative, 1/m, within :data:`NEAR` lengths of the boat and elsewhere.

        a·k² of both systems, and the window at the bow, where the wake opens: its width there is proportional to the
        distance from the bow, so its contribution grows with 1/length² and falls with the square of the distance. The
        factor is measured over boats of every speed, radius and height, plus a tenth.
        """
        if not self.shows:
            return 0.0, 0.0
        peak = max(self.k, self.shortest)
        waves = 1.5 * self.boat.wake * peak**2 * math.exp(-((peak / self.shortest) ** 2))
        window = _OPENING * self.level * math.exp(-((self.k / self.shortest) ** 2)) / self.boat.length**2
        return (waves + window) / 0.75**2, (waves + window / NEAR**2) / 0.75**2

    def grain(self, texel: float) -> float:
        """Upper bound of the excess of a bilinear map of ``texel`` m over what its slope and curvature say, m.

        In units of the second derivative of its shortest waves times texel²; the factor is measured, plus a tenth.
        """
        return 0.013 * self.level * math.exp(-((self.k / self.shortest) ** 2)) * (texel * self.shortest) ** 2


def wakes(boats: tuple[Boat, ...]) -> tuple[Wake, ...]:
    """Return every boat's wake, visible or not."""
    return tuple(Wake(boat) for boat in boats)


def wake_level(boats: tuple[Boat, ...]) -> float:
    """Return the height of still water above y = 0 where boats pass, m: a bound of the depth of all wakes' troughs."""
    return float(f"{sum(wake.level for wake in wakes(boats)):.7g}")


def wake_slope(boats: tuple[Boat, ...]) -> float:
    """Return an upper bound of the slope of all wakes together."""
    return float(f"{sum(wake.steepest for wake in wakes(boats)):.7g}")
