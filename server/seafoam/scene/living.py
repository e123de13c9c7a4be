"""Foam transport and ageing: waves and wind move the foam, and its mask changes with its age."""

from typing import Annotated

from pydantic import Field

from seafoam.scene.base import Angle, Part

MASKS_MOST = 2
"""Maximum number of masks of older foam in a scene."""
MASK_NAME = r"^[a-z]+(-[0-9.]+)?$|^[a-z]+:[0-9.]+:[0-9]+:[0-9]+(:[0-9.]+:[0-9.]+)?$"
"""Name in the catalogue, or the parameters of a custom mask."""

_Mask = Annotated[
    str, Field(max_length=40, pattern=MASK_NAME, json_schema_extra={"choices_from": "/api/masks"}, title="Mask")
]


class FoamLife(Part):
    """Transport and ageing of foam; applies to the filtered look only."""

    carried: bool = Field(
        default=True,
        description="Waves carry the foam to and fro with the water and stretch it; false: it stays in place",
    )
    masks: tuple[_Mask, ...] = Field(
        default=("lacetorn", "streak"),
        max_length=MASKS_MOST,
        description="Masks for ageing foam, the oldest last; each must be as large as the foam's own mask",
    )
    wind_direction: Angle = Field(
        default=0.0,
        description="Direction toward which the wind blows, rad from +x toward +z; sets the wind drift and "
        "the windrows",
    )
    wind_drift: float = Field(
        default=0.0,
        ge=0.0,
        le=2.0,
        description="Drift speed of the surface with the wind, m/s; in nature 1 to 3 % of the wind speed",
    )
    windrows: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="Strength with which foam gathers in windrows, rows along the wind (Langmuir 1938); 0: even",
    )
    windrow_spacing: float = Field(default=12.0, ge=0.5, le=500.0, description="Mean spacing of the windrows, m")
