"""Drift: the flow that carries foam over a square of water: a current, Stokes drift, and vortices."""

from typing import Annotated

from pydantic import Field

from seafoam.scene.base import Part, Place

VORTICES_MOST = 12
"""Maximum number of vortices in a scene."""

_Speed = Annotated[float, Field(ge=-20.0, le=20.0)]


class Vortex(Part):
    """A stationary vortex: fastest at its radius, at rest at its centre and beyond six radii."""

    place: tuple[Place, Place] = Field(default=(0.0, -30.0), description="Centre (x, z), m")
    radius: float = Field(
        default=2.0, ge=0.05, le=500.0, description="Distance from the centre at which the flow is fastest, m"
    )
    speed: float = Field(
        default=1.0,
        ge=-20.0,
        le=20.0,
        description="Maximum speed, m/s; positive turns from +x toward +z, negative the other way",
    )


class Drift(Part):
    """A steady flow over a square, which carries the foam of a ``drift`` saturation."""

    place: tuple[Place, Place] = Field(default=(0.0, -30.0), description="Centre of the square (x, z), m")
    size: float = Field(
        default=60.0, ge=1.0, le=5000.0, description="Side of the square, m; drifting foam exists only inside it"
    )
    current: tuple[_Speed, _Speed] = Field(default=(0.3, 0.0), description="Velocity of the current (x, z), m/s")
    waves: float = Field(
        default=1.0,
        ge=0.0,
        le=4.0,
        description="Factor on the Stokes drift of the waves; 0: waves do not carry foam (Stokes 1847)",
    )
    vortices: tuple[Vortex, ...] = Field(default=(), max_length=VORTICES_MOST, description="Stationary vortices")
