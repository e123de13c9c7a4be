"""Waves of a scene: parametric ones, and the sea that a wind raises."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from seafoam.scene.base import Angle, Downwind, Follows, InEffect, Part, Share


class ParametricWave(Part):
    """Periodic height field y = A((sin θ + 1)/2)^K (Van Drasek et al. 2010, in Yingst et al. 2011)."""

    model: Literal["parametric"] = "parametric"
    amplitude: float = Field(default=0.5, ge=0.0, le=50.0, description="A: height of the crest above the trough, m")
    wavelength: float = Field(default=12.0, ge=0.05, le=2000.0, description="λ: wavelength in deep water, m")
    direction: Angle = Field(default=0.0, description="Direction of travel, rad from +x toward +z")
    exponent: float = Field(
        default=2.0,
        ge=0.1,
        le=100.0,
        description="K: exponent of the profile; 1 is a sine, larger values sharpen the crests",
    )
    phase: Angle = Field(default=0.0, description="Phase θ at the origin at time 0, rad")
    speed: float | None = Field(
        default=None, ge=0.0, le=200.0, description="s: phase speed, m/s; absent: √(gλ/2π), the speed in deep water"
    )


class WaveGroups(Part):
    """Groups of high waves, with calmer water between them: a factor of the heights of all parametric waves."""

    size: float = Field(default=100.0, ge=1.0, le=10_000.0, description="Mean distance of a group from the next, m")
    contrast: Share = Field(
        default=0.7,
        description="How much lower waves are where they are lowest, as a fraction of their greatest height: 0 is "
        "no groups, 1 is still water between them",
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of where the groups are")


class Sea(Part):
    """Wind-driven open sea: a JONSWAP spectrum (Hasselmann et al. 1973) on tiles."""

    model: Literal["gerstner", "fft"] = Field(
        default="fft",
        description="gerstner: dozens of waves on two tiles; fft: the whole spectrum on four tiles (Tessendorf 2001)",
    )
    wind: Annotated[float | None, Follows("speed", alone=10.0)] = Field(
        default=None,
        ge=0.0,
        le=60.0,
        description="U: wind speed at 10 m, m/s; sets wave height and peak period; null: as the scene's wind",
    )
    wind_speed: ClassVar[InEffect] = InEffect("wind")
    fetch: float = Field(
        default=2e5,
        ge=100.0,
        le=1e7,
        description="Fetch: distance over which the wind blows across the sea, m; longer gives higher and longer waves",
    )
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    spread: float = Field(
        default=6.0,
        ge=0.0,
        le=100.0,
        description="s: exponent of the directional spreading cos^2s(θ/2), θ the angle to the wind; larger "
        "values align the waves",
    )
    against: Share = Field(
        default=0.3,
        description="Factor on the energy of waves that travel against the wind; 0 removes them, as in rivers",
    )
    choppiness: Share = Field(
        default=0.9,
        description="λ: horizontal displacement of the water, as a fraction of that of trochoids in deep "
        "water; 0 gives rounded crests, 1 sharp ones",
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the wave amplitudes and phases")


Wave = ParametricWave
"""All wave models; becomes a union discriminated by ``model`` when there is a second one."""
