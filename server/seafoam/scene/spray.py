"""Spray: drops thrown up by waves, and rocks on which surf breaks. docs/formulae.md, section 13."""

from pydantic import Field

from seafoam.scene.base import Angle, Part

DROPS = 16384
"""Number of drops; a quality that draws fewer draws each larger."""


class Spray(Part):
    """Drops thrown up where waves rise fast, or, with a shore, where surf breaks on rocks."""

    threshold: float = Field(
        default=1.5,
        ge=0.0,
        le=20.0,
        description="Minimum speed that throws drops, m/s: of the rising water on waves, of the drops "
        "themselves on rocks",
    )
    speed: float = Field(
        default=3.0,
        ge=0.1,
        le=10.0,
        description="Initial speed of the drops: on waves relative to the speed of the rising water, on rocks "
        "to √(gH), H the height of the surf",
    )
    steep: float = Field(
        default=0.3, ge=0.0, le=2.0, description="Slope of the ground above which a coast is rock and throws spray"
    )
    size: float = Field(
        default=0.04, ge=0.002, le=0.3, description="Radius of a drop, m; each stands for a cluster of many"
    )
    mist: float = Field(default=0.3, ge=0.0, le=1.0, description="Fraction of the drops that are puffs of mist")
    drag: float = Field(
        default=0.8,
        ge=0.05,
        le=10.0,
        description="Time constant of air drag: a drop's velocity relative to the wind falls to 1/e, s",
    )
    life: float = Field(default=2.5, ge=0.2, le=8.0, description="Lifetime of a drop, s")
    wind: float = Field(default=3.0, ge=0.0, le=40.0, description="Speed of the wind that carries the drops, m/s")
    wind_direction: Angle = Field(
        default=0.0, description="Direction toward which the wind blows, rad from +x toward +z"
    )
    reach: float = Field(
        default=60.0,
        ge=5.0,
        le=1000.0,
        description="Maximum distance from the camera at which waves throw drops, m; rocks throw them at any distance",
    )
