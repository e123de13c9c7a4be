"""A shore: sea floor and land over a square, and the surf that runs up on it. docs/formulae.md, section 8."""

import base64
import binascii
import io
from functools import lru_cache
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, model_validator

Floats = NDArray[np.float64]

_Place = Annotated[float, Field(ge=-1e7, le=1e7)]

_Share = Annotated[float, Field(ge=0.0, le=1.0)]

_Rgb = tuple[_Share, _Share, _Share]

STEPS = 1024
"""Heights are whole multiples of 1/1024 m, so that the last bits of a root hide."""


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Surf(_Part):
    """Shore waves: skewed trochoids x = s − b sin(2π frac(s)^γ), y = a cos(2π frac(s)^γ) (Outerra 2011)."""

    height: float = Field(default=1.0, ge=0.0, le=6.0, description="Height of a wave where it breaks, m; 0: no surf")
    period: float = Field(default=7.0, ge=2.0, le=20.0, description="Time from crest to crest, s")
    skew: float = Field(
        default=0.5, ge=0.0, le=1.0, description="γ where a wave breaks: 1 is upright, less leans to the shore"
    )
    sharpness: float = Field(default=0.05, ge=0.0, le=0.15, description="b: how far a crest gathers, in wavelengths")
    variation: float = Field(
        default=0.7, ge=0.0, le=1.0, description="How far the slowly changing mask lowers waves: 0 breaks all alike"
    )
    heading: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Heading of the swell, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    exposure: float = Field(
        default=0.0, ge=0.0, le=1.0, description="How calm coasts are that the swell does not meet: 0 as rough, 1 calm"
    )


class Shore(_Part):
    """Sea floor and land: a height field over a square; beyond it the floor goes on level."""

    kind: Literal["beach", "island", "islands", "lagoon", "image"] = Field(
        default="beach",
        description="beach: a coast right through the square; island; islands: several; lagoon: a ring with an "
        "opening; image: a picture of your own",
    )
    place: tuple[_Place, _Place] = Field(default=(0.0, 0.0), description="Middle of the square (x, z), m")
    size: float = Field(default=500.0, ge=40.0, le=10000.0, description="Side of the square, m")
    heading: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Toward the land of a beach, the opening of a lagoon; rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    radius: float = Field(default=60.0, ge=1.0, le=4000.0, description="Of an island or of a lagoon's ring, m")
    depth: float = Field(default=12.0, ge=0.5, le=1000.0, description="Depth of the level floor around, m")
    inner_depth: float = Field(default=3.0, ge=0.2, le=100.0, description="Depth inside a lagoon, m")
    height: float = Field(default=6.0, ge=0.0, le=300.0, description="About how high the land rises, m")
    slope: float = Field(default=0.06, ge=0.01, le=1.0, description="Slope of the floor at the water's edge")
    roughness: float = Field(
        default=0.5, ge=0.0, le=1.0, description="How far bays and capes stray from the plain shape"
    )
    level: float = Field(default=0.0, ge=-1000.0, le=100.0, description="Lifts floor and land; below 0: high water, m")
    seed: int = Field(default=1, ge=0, le=65535, description="Which shore of its kind")
    image: str | None = Field(
        default=None,
        max_length=8192,
        description="For kind image, a PNG in base64, 2 to 128 pixels a side: black is the deep floor, white the "
        "height of the land; its top is toward −z",
    )
    smoothing: float = Field(
        default=6.0, ge=0.0, le=60.0, description="Standard deviation of the Gaussian that smooths distances, m"
    )
    sand: _Rgb = Field(default=(0.66, 0.56, 0.40), description="Reflectance of dry sand")
    rock: _Rgb = Field(default=(0.27, 0.24, 0.21), description="Reflectance of rock, where it is steep")
    plants: _Rgb = Field(default=(0.06, 0.10, 0.035), description="Reflectance of what grows")
    plants_from: float = Field(default=2.0, ge=0.0, le=400.0, description="Height from which something grows, m")
    reef: float = Field(default=0.5, ge=0.0, le=1.0, description="Share of dark patches on the floor: reef and weed")
    surf: Surf = Field(default_factory=Surf)

    @model_validator(mode="after")
    def _pictured(self) -> "Shore":
        if (self.kind == "image") != (self.image is not None):
            raise ValueError("image: a shore of kind image needs one, and no other kind takes one")
        if self.image is not None:
            _picture(self.image)
        return self

    @property
    def deep(self) -> float:
        """Depth of the level floor below y = 0, m; at least 0.1, so that what divides by it may."""
        return max(self.depth - self.level, 0.1)

    @property
    def ground(self) -> str:
        """All that the height field hangs on, as text: what is equal here has the same floor."""
        values = [str(getattr(self, name)) for name in _GROUND]
        if self.image is not None:
            # The alphabet of base64 that addresses take.
            values.append(self.image.replace("+", "-").replace("/", "_"))
        return ",".join(values)

    @staticmethod
    def of_ground(text: str) -> "Shore":
        """A shore with the ground that :attr:`ground` tells of. Raises ``ValueError`` where no shore has it."""
        values = text.split(",")
        names = _GROUND if len(values) == len(_GROUND) else (*_GROUND, "image")
        if len(values) != len(names):
            raise ValueError(text)
        found = dict(zip(names, values, strict=True))
        if "image" in found:
            found["image"] = found["image"].replace("-", "+").replace("_", "/")
        return Shore.model_validate(found)


_GROUND = (
    "kind",
    "size",
    "heading",
    "radius",
    "depth",
    "inner_depth",
    "height",
    "slope",
    "roughness",
    "level",
    "seed",
)


@lru_cache(maxsize=16)
def _picture(encoded: str) -> Floats:
    """Grey of a PNG in base64, (rows, columns) in [0, 1]. Raises ``ValueError`` that says what is wrong with it."""
    try:
        raw = base64.b64decode(encoded, validate=True)
    except binascii.Error:
        raise ValueError("image: not base64") from None
    try:
        with Image.open(io.BytesIO(raw), formats=("PNG",)) as picture:
            if not (2 <= picture.width <= 128 and 2 <= picture.height <= 128):
                raise ValueError(f"image: {picture.width} × {picture.height} pixels, not 2 to 128 a side")
            deep = picture.mode.startswith("I")
            grey = np.asarray(picture if deep else picture.convert("L"), np.float64) / (65535.0 if deep else 255.0)
    except (OSError, SyntaxError) as error:
        raise ValueError("image: not a PNG that can be read") from error
    result: Floats = np.clip(grey, 0.0, 1.0)
    result.setflags(write=False)
    return result
