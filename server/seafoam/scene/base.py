"""Base of every part of a scene, and types of its numbers."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]

Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]

Rgb = tuple[Share, Share, Share]

Place = Annotated[float, Field(ge=-1e7, le=1e7)]
"""A horizontal coordinate, m."""

Angle = Annotated[float, Field(ge=-6.2832, le=6.2832, json_schema_extra={"unit": "rad"})]
"""An angle of up to a turn either way, rad."""

Elevation = Annotated[float, Field(ge=-1.5708, le=1.5708, json_schema_extra={"unit": "rad"})]
"""An angle over the horizon, rad."""


class Part(BaseModel):
    """Base class of every part of a scene: immutable, no unknown keys, no NaN or infinity."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
