"""Waves of a scene: parametric ones, a wind's sea, rings from stones, blasts and touches, and a plunging crest."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from seafoam.scene.base import Angle, Downwind, Follows, InEffect, Part, Place, Radians, Share


class ParametricWave(Part):
    """Periodic height field y = A((sin θ + 1)/2)^K (Van Drasek et al. 2010, in Yingst et al. 2011)."""

    model: Literal["parametric"] = "parametric"
    amplitude: float = Field(default=0.5, ge=0.0, le=50.0, description="A: height of the crest above the trough, m")
    wavelength: float = Field(default=12.0, ge=0.05, le=2000.0, description="λ: wavelength in deep water, m")
    direction: Angle = Field(default=0.0, description="Direction of travel, rad from +x toward +z")
    exponent: float = Field(default=2.0, ge=0.1, le=100.0)
    """K: exponent of the profile; 1 is a sine, larger values sharpen the crests"""
    phase: Angle = Field(default=0.0, description="Phase θ at the origin at time 0, rad")
    speed: float | None = Field(default=None, ge=0.0, le=200.0)
    """s: phase speed, m/s; absent: √(gλ/2π), the speed in deep water"""


class WaveGroups(Part):
    """Groups of high waves, with calmer water between them: a factor of the heights of all parametric waves."""

    size: float = Field(default=100.0, ge=1.0, le=10_000.0, description="Mean distance of a group from the next, m")
    contrast: Share = 0.7
    """How much lower waves are where they are lowest, as a fraction of their greatest height: 0 is no groups, 1 is
    still water between them"""
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of where the groups are")


class Sea(Part):
    """Wind-driven open sea: a JONSWAP spectrum (Hasselmann et al. 1973) on tiles."""

    model: Literal["gerstner", "fft"] = "fft"
    """gerstner: dozens of waves on two tiles; fft: the whole spectrum on four tiles (Tessendorf 2001)"""
    wind: Annotated[float | None, Follows("speed", alone=10.0)] = Field(default=None, ge=0.0, le=60.0)
    """U: wind speed at 10 m, m/s; sets wave height and peak period; null: as the scene's wind"""
    wind_speed: ClassVar[InEffect] = InEffect("wind")
    fetch: float = Field(default=2e5, ge=100.0, le=1e7)
    """Fetch: distance over which the wind blows across the sea, m; longer gives higher and longer waves"""
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    spread: float = Field(default=6.0, ge=0.0, le=100.0)
    """s: exponent of the directional spreading cos^2s(θ/2), θ the angle to the wind; larger values align the waves"""
    against: Share = 0.3
    """Factor on the energy of waves that travel against the wind; 0 removes them, as in rivers"""
    choppiness: Share = 0.9
    """λ: horizontal displacement of the water, as a fraction of that of trochoids in deep water; 0 gives rounded
    crests, 1 sharp ones"""
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the wave amplitudes and phases")


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
    every: float | None = Field(default=None, ge=0.1, le=1e5)
    """Interval at which the ring is repeated, s; at least its lifetime, at most 5.55/b; absent: it happens once"""
    amplitude: float = Field(default=0.2, ge=0.0, le=20.0, description="I0: initial amplitude of the crests, m")
    decay: float = Field(default=0.3, ge=0.01, le=10.0, description="b: decay rate of the amplitude, 1/s")
    wavelength: float = Field(default=3.0, ge=0.05, le=500.0, description="λ: wavelength in deep water, m")
    crests: float | None = Field(default=None, ge=0.5, le=100.0)
    """Number of waves behind the front, after which the water is calm; absent: waves to the centre"""

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


TOUCHES_MOST = 24
"""Maximum number of touches in a scene: the capacity of every plan that draws touches."""
TOUCH_DECAY = 0.7
"""Decay rate of the amplitude, 1/s."""
TOUCH_CRESTS = 3.0
"""Number of waves behind the front."""
TOUCH_LEAST_LENGTH = 0.05
"""Wavelength of an infinitely weak touch, m."""
TOUCH_LENGTH = 16.0
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
            decay=TOUCH_DECAY,
            wavelength=TOUCH_LEAST_LENGTH + TOUCH_LENGTH * self.strength,
            crests=TOUCH_CRESTS,
        )


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
    every: float = Field(default=8.0, ge=0.5, le=600.0, description="Time from crest to crest, s")
