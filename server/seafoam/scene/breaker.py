"""A plunging crest. docs/formulae.md, section 17."""

from typing import Literal

from pydantic import Field

from seafoam.scene.base import Angle, Part, Place, Radians


class Breaker(Part):
    """A crest that overturns along a reef, again and again."""

    place: tuple[Place, Place] = Field(default=(0.0, -20.0), description="Where it begins to overturn, (x, z) m")
    heading: Angle = Field(default=1.5708, description="Direction of travel, rad from +x toward +z")
    height: float = Field(default=2.5, ge=0.0, le=20.0, description="Greatest height over still water, m; 0: none")
    length: float = Field(default=50.0, ge=10.0, le=500.0, description="Length of the crest, m")
    peel_angle: Radians = Field(default=0.8, ge=0.2, le=1.3)
    """Angle between crest and reef (Walker 1974), rad: the smaller, the faster it breaks along its length"""
    peels: Literal["left", "right"] = Field(default="right", description="Side to which it breaks, as it travels")
    start: float = Field(default=0.0, ge=-1e6, le=1e6, description="Time at which it begins to overturn, s")
    rest: float = Field(default=4.0, ge=0.0, le=600.0, description="Time without a crest before the next, s")
