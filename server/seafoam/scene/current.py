"""A river's current, uniform and steady, and stones in it. docs/formulae.md, section 16."""

import math

from pydantic import Field

from seafoam.scene.base import Angle, Part, Place, Share

STONES_MOST = 8
"""Maximum number of stones in a current."""


class Stone(Part):
    """A stone just under the surface: standing waves and white water lie behind it. The stone itself is not drawn."""

    place: tuple[Place, Place] = Field(default=(0.0, -12.0), description="Centre (x, z), m")
    radius: float = Field(default=0.6, ge=0.1, le=10.0, description="Radius, m")
    waves: Share = Field(
        default=0.4,
        description="Amplitude of the waves at the stone, as a fraction of the velocity head U²/2g; 0: none",
    )


class Current(Part):
    """A uniform current: it carries waves, ripples and foam past banks, floor and anything at anchor."""

    speed: float = Field(default=1.5, ge=0.0, le=10.0, description="Speed over the ground, m/s; 0: no current")
    direction: Angle = Field(default=0.0, description="Direction toward which the water flows, rad from +x toward +z")
    stones: tuple[Stone, ...] = Field(default=(), max_length=STONES_MOST, description="Stones in the river")

    @property
    def velocity(self) -> tuple[float, float]:
        """(x, z) m/s, rounded to 1 µm/s."""
        x, z = self.speed * math.cos(self.direction), self.speed * math.sin(self.direction)
        return round(x, 6), round(z, 6)
