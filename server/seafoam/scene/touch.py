"""Rings that a finger raises on the water: the small circular waves of a touch, by place, time and strength."""

from pydantic import Field

from seafoam.scene.base import Part, Place
from seafoam.scene.rings import Ring

TOUCHES_MOST = 24
"""Maximum number of touches in a scene: the capacity of every plan that draws touches."""
DECAY = 0.7
"""Decay rate of the amplitude, 1/s."""
CRESTS = 3.0
"""Number of waves behind the front."""
LEAST_LENGTH = 0.05
"""Wavelength of an infinitely weak touch, m."""
LENGTH = 16.0
"""Wavelength by strength: rings of all strengths are about equally steep."""


class Touch(Part):
    """A touch of the water: it raises a ring of wavelength 0.05 m + 16 strength, which dies away in eight seconds."""

    place: tuple[Place, Place] = Field(default=(0.0, -6.0), description="Where the water was touched (x, z), m")
    time: float = Field(default=0.0, ge=-1e9, le=1e9, description="Time of the touch, s")
    strength: float = Field(default=0.025, ge=0.0, le=0.5, description="Initial amplitude of the ring's crests, m")

    @property
    def ring(self) -> Ring:
        """The ring that it raises, in deep water and in the frame of the water at the time of the touch."""
        return Ring(
            place=self.place,
            birth=self.time,
            amplitude=self.strength,
            decay=DECAY,
            wavelength=LEAST_LENGTH + LENGTH * self.strength,
            crests=CRESTS,
        )
