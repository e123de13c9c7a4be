"""Drift: what carries foam over a square of water: a current, the waves' own drift, and vortices."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

VORTICES_MOST = 12
"""A scene holds no more vortices."""

_Place = Annotated[float, Field(ge=-1e7, le=1e7)]
_Speed = Annotated[float, Field(ge=-20.0, le=20.0)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Vortex(_Part):
    """Water that turns around a place that stays: fastest at its radius, still at its centre and past six radii."""

    place: tuple[_Place, _Place] = Field(default=(0.0, -30.0), description="Centre (x, z), m")
    radius: float = Field(default=2.0, ge=0.05, le=500.0, description="Where it turns fastest, m from its centre")
    speed: float = Field(
        default=1.0, ge=-20.0, le=20.0, description="There, m/s; positive turns from +x toward +z, negative back"
    )


class Drift(_Part):
    """A steady flow over a square, which carries the foam of a ``drift`` saturation."""

    place: tuple[_Place, _Place] = Field(default=(0.0, -30.0), description="Middle of the square (x, z), m")
    size: float = Field(default=60.0, ge=1.0, le=5000.0, description="Side of the square, m; no such foam beyond it")
    current: tuple[_Speed, _Speed] = Field(default=(0.3, 0.0), description="Current toward (x, z), m/s")
    waves: float = Field(
        default=1.0, ge=0.0, le=4.0, description="How much of the waves' own drift carries foam (Stokes 1847)"
    )
    vortices: tuple[Vortex, ...] = Field(default=(), max_length=VORTICES_MOST, description="Eddies that stay in place")
