"""Spray: drops that the water throws up, and the rocks that surf breaks on. docs/formulae.md, section 13."""

from pydantic import BaseModel, ConfigDict, Field

DROPS = 16384
"""Drops of the whole spray; a quality that draws fewer makes each larger."""


class Spray(BaseModel):
    """Drops thrown up where waves rise fast or, where there is a shore, where surf breaks on rocks."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    threshold: float = Field(
        default=1.5,
        ge=0.0,
        le=20.0,
        description="Water that rises slower throws no drops, and surf whose drops would start slower neither, m/s",
    )
    speed: float = Field(
        default=3.0,
        ge=0.1,
        le=10.0,
        description="How fast drops start: in speeds at which the water rises; on rocks in √(gH), H the surf's height",
    )
    steep: float = Field(default=0.3, ge=0.0, le=2.0, description="Slope of the ground from which a coast is rock")
    size: float = Field(default=0.04, ge=0.002, le=0.3, description="Radius of a drop, a clot of many, m")
    mist: float = Field(default=0.3, ge=0.0, le=1.0, description="Share of the drops that are puffs of mist")
    drag: float = Field(
        default=0.8, ge=0.05, le=10.0, description="Time in which the air takes a drop's speed to 1/e of the wind's, s"
    )
    life: float = Field(default=2.5, ge=0.2, le=8.0, description="Time after which nothing of a drop is left, s")
    wind: float = Field(default=3.0, ge=0.0, le=40.0, description="Wind that carries drops along, m/s")
    wind_direction: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading of the wind, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    reach: float = Field(
        default=60.0, ge=5.0, le=1000.0, description="How far from the eye waves throw up drops, m; rocks do anywhere"
    )
