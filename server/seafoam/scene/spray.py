"""Spray: water thrown up by waves, by surf on rocks, and by blasts. docs/formulae.md, section 13."""

from typing import Annotated, ClassVar

from pydantic import Field

from seafoam.scene.base import Downwind, Follows, InEffect, Part, Place, Share

DROPS = 16384
"""Number of drops; a quality that draws fewer draws each larger."""
BURSTS_MOST = 8
"""Maximum number of bursts of a scene."""


class Burst(Part):
    """A blast under the water: a column, a crown about its foot, and a surge of mist when it falls back."""

    place: tuple[Place, Place] = Field(default=(0.0, -40.0), description="Middle (x, z), m")
    birth: float = Field(default=0.0, ge=-1e9, le=1e9)
    """Time at which the column breaks through the surface, s"""
    every: float | None = Field(default=None, ge=1.0, le=1e5)
    """Interval at which it is repeated, s; absent: it happens once"""
    height: float = Field(default=15.0, ge=0.5, le=150.0, description="Height of the column, m")
    radius: float = Field(default=1.8, ge=0.1, le=30.0, description="Radius of the column's foot, m")


class Spray(Part):
    """Water thrown up where waves break or rise fast, or where surf breaks on rocks or a beach; and by bursts."""

    threshold: float = Field(default=1.5, ge=0.0, le=20.0)
    """Minimum speed that throws drops, m/s: of the rising water on single waves and surf, of the drops themselves on
    rocks"""
    speed: float = Field(default=3.0, ge=0.1, le=10.0)
    """Initial speed of the drops: on waves relative to the speed of the rising water, on rocks to √(gH), H the height
    of the surf"""
    crests: float = Field(default=1.0, ge=0.0, le=4.0)
    """Spray from breaking crests of a sea: factor on the excess of its folds over the whitecaps' threshold; 0: none"""
    spindrift: Share = 0.5
    """Fraction of a sea's drops that a gale tears from crests: none below a wind of 15 m/s, all of it from 21 m/s on"""
    steep: float = Field(default=0.3, ge=0.0, le=2.0)
    """Slope of the ground above which a coast is rock; without rocks surf throws spray where it breaks"""
    size: float = Field(default=0.04, ge=0.002, le=0.3)
    """Scale of the drops, m; each stands for a cluster of many"""
    mist: Share = Field(default=0.3, description="Fraction of the drops that are puffs of mist")
    drag: float = Field(default=0.8, ge=0.05, le=10.0)
    """Time constant of air drag: a drop's velocity relative to the wind falls to 1/e, s"""
    life: float = Field(default=2.5, ge=0.2, le=8.0, description="Lifetime of a drop, s")
    wind: Annotated[float | None, Follows("speed", alone=3.0)] = Field(default=None, ge=0.0, le=40.0)
    """Speed of the wind that carries the drops, m/s; null: as the scene's wind"""
    wind_speed: ClassVar[InEffect] = InEffect("wind")
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    reach: float = Field(default=60.0, ge=5.0, le=1000.0)
    """Maximum distance from the camera at which waves throw drops, m; rocks throw them at any distance"""
    bursts: tuple[Burst, ...] = Field(default=(), max_length=BURSTS_MOST, description="Blasts under the water")
