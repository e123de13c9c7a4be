"""Boats: course, shape and wake. docs/formulae.md, section 15."""

from typing import Literal

from pydantic import Field, model_validator

from seafoam.scene.base import Angle, Part, Place, Radians, Rgb

BOATS_MOST = 4
"""Maximum number of boats in a scene."""


class Boat(Part):
    """A boat that floats on the waves and follows a circular course."""

    kind: Literal["sail", "motor"] = Field(default="sail", description="sail: a sloop; motor: a small trawler")
    length: float = Field(default=9.0, ge=2.0, le=60.0)
    """Overall length, m; all other dimensions scale with it"""
    centre: tuple[Place, Place] = Field(default=(0.0, -40.0), description="Centre (x, z) of the circular course, m")
    radius: float = Field(default=60.0, ge=5.0, le=2000.0, description="Radius of the course, m; at least 1.5 lengths")
    bearing: Angle = 0.0
    """Position on the course at time 0, as an angle about its centre, rad from +x toward +z"""
    turn: Literal["starboard", "port"] = Field(default="starboard", description="Side to which the boat turns")
    speed: float = Field(default=3.0, ge=0.0, le=20.0, description="Speed, m/s; 0: at anchor, the bow along the course")
    heel: Radians = Field(default=0.0, ge=-0.6, le=0.6)
    """Heel to starboard, in addition to that caused by the waves, rad"""
    boom: Radians = Field(default=0.35, ge=-1.4, le=1.4)
    """Angle of the boom from the centreline to starboard, rad"""
    smoothing: float = Field(default=1.0, ge=0.0, le=30.0)
    """Radius of the disc over which the wave height at each hull point is averaged, m; larger values steady the boat;
    0: no averaging"""
    wake: float = Field(default=0.12, ge=0.0, le=2.0, description="Amplitude of the waves at the bow, m; 0: no wake")
    hull: Rgb = Field(default=(0.045, 0.09, 0.2), description="Albedo of the hull, linear RGB")
    sails: Rgb = Field(default=(0.83, 0.81, 0.76), description="Albedo of the sails or of the wheelhouse, linear RGB")

    @model_validator(mode="after")
    def _course_wider_than_the_boat(self) -> "Boat":
        if self.radius < 1.5 * self.length:
            raise ValueError(f"radius: must be at least 1.5 lengths ({1.5 * self.length:.4g} m)")
        return self
