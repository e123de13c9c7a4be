"""Boats: their course round a centre, their form, and the numbers of their wakes. docs/formulae.md, section 15."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

BOATS_MOST = 4
"""A scene holds no more boats."""

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
