"""Foam transport and ageing: waves and wind move the foam, and its mask changes with its age."""

from typing import Annotated, ClassVar

from pydantic import Field

from seafoam.scene.base import Downwind, Follows, InEffect, Part

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
    wind_direction: Downwind = None
    downwind: ClassVar[InEffect] = InEffect("wind_direction")
    wind_drift: Annotated[float | None, Follows("speed", alone=0.0, factor=0.02)] = Field(
        default=None,
        ge=0.0,
        le=2.0,
        description="Drift speed of the surface with the wind, m/s; null: 2 % of the scene's wind",
    )
    drift_speed: ClassVar[InEffect] = InEffect("wind_drift")
    windrows: Annotated[float | None, Follows("speed", alone=0.0, factor=1.0 / 18.0, calm=4.0)] = Field(
        default=None,
        ge=0.0,
        le=1.0,
        description="Strength with which foam gathers in windrows, rows along the wind (Langmuir 1938); 0: even; null: "
        "by the scene's wind, 0 up to 4 m/s and 1 from 22 m/s on",
    )
    row_strength: ClassVar[InEffect] = InEffect("windrows")
    windrow_spacing: float = Field(default=12.0, ge=0.5, le=500.0, description="Mean spacing of the windrows, m")
