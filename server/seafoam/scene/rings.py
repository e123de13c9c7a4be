"""Circular waves from a stone, a drop or a blast (Kryachko 2005)."""

import math

from pydantic import Field, model_validator

from seafoam.scene.base import Part, Place

DEAD = 1e-4
DEAD_SHARE = 1.0 / 256.0
"""A ring's amplitude is reduced by 10⁻⁴ m or by this share of I0, whichever is more, so that it ends, without a jump,
when the formula's amplitude has decayed to that."""

RINGS_MOST = 100
"""Maximum number of rings in a scene."""


class Ring(Part):
    """Circular waves around a centre: η = (I0 e^(−bs) − d) cos(kρ − ωs) behind a front, from ``birth`` on."""

    place: tuple[Place, Place] = Field(default=(0.0, -20.0), description="Centre (x, z), m")
    birth: float = Field(default=0.0, ge=-1e9, le=1e9, description="Time at which the ring starts, s")
    every: float | None = Field(
        default=None,
        ge=0.1,
        le=1e5,
        description="Interval at which the ring is repeated, s; at least its lifetime, at most 5.55/b; "
        "absent: it happens once",
    )
    amplitude: float = Field(default=0.2, ge=0.0, le=20.0, description="I0: initial amplitude of the crests, m")
    decay: float = Field(default=0.3, ge=0.01, le=10.0, description="b: decay rate of the amplitude, 1/s")
    wavelength: float = Field(default=3.0, ge=0.05, le=500.0, description="λ: wavelength in deep water, m")
    crests: float | None = Field(
        default=None,
        ge=0.5,
        le=100.0,
        description="Number of waves behind the front, after which the water is calm; absent: waves to the centre",
    )

    @property
    def dead(self) -> float:
        """d: reduction of the amplitude, m."""
        return max(DEAD, DEAD_SHARE * self.amplitude)

    @property
    def life(self) -> float:
        """Age at which the ring ends, s; 0 for a ring that is never visible."""
        return math.log(self.amplitude / self.dead) / self.decay if self.amplitude > self.dead else 0.0

    @model_validator(mode="after")
    def _ends_before_it_starts_again(self) -> "Ring":
        if self.every is not None and self.every < self.life:
            raise ValueError(f"every: must be at least the ring's lifetime ({self.life:.4g} s)")
        return self
