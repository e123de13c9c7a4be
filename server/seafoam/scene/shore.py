"""A shore: sea floor and land over a square, and surf. docs/formulae.md, section 8."""

import base64
import binascii
import io
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from seafoam.scene.base import Angle, Part, Place, Rgb, Share

Floats = NDArray[np.float64]
STEPS = 1024
"""Heights are multiples of 1/1024 m, which hides differences in the last bits of square roots."""


class Surf(Part):
    """Shore waves: skewed trochoids x = s − b sin(2π frac(s)^γ), y = a cos(2π frac(s)^γ) (Outerra 2011)."""

    height: float = Field(default=1.0, ge=0.0, le=6.0, description="Height of the breakers, m; 0: no surf")
    period: float = Field(default=7.0, ge=2.0, le=20.0, description="Wave period, s")
    skew: Share = 0.5
    """γ: asymmetry of the profile at breaking; 1 is symmetric, smaller values lean toward the shore"""
    sharpness: float = Field(default=0.05, ge=0.0, le=0.15)
    """b: horizontal displacement at the crests, in wavelengths; larger values sharpen them"""
    variation: Share = 0.7
    """Strength of the slow variation of the wave height along the coast; 0: all waves break alike"""
    heading: Angle = Field(default=0.0, description="Direction of travel of the swell, rad from +x toward +z")
    exposure: Share = 0.0
    """Reduction of the surf on coasts that face away from the swell: 0 none, 1 no surf there"""
    refraction: bool = False
    """Crests follow the travel time of a swell from `heading` over the depth, which bends them around capes and
    islands; false: waves approach every coast at normal incidence"""


class Shore(Part):
    """Sea floor and land: a height field over a square; beyond it the floor is level."""

    kind: Literal["beach", "island", "islands", "lagoon", "image"] = "beach"
    """Shape of the coast. beach: a straight coast across the square; island; islands: several; lagoon: a ring with an
    opening; image: heights from `image`"""
    place: tuple[Place, Place] = Field(default=(0.0, 0.0), description="Centre of the square (x, z), m")
    size: float = Field(default=500.0, ge=40.0, le=10000.0, description="Side of the square, m")
    heading: Angle = 0.0
    """Direction of a beach's land, or of a lagoon's opening, rad from +x toward +z"""
    radius: float = Field(default=60.0, ge=1.0, le=4000.0, description="Radius of an island or of a lagoon's ring, m")
    depth: float = Field(default=12.0, ge=0.5, le=1000.0, description="Depth of the level floor offshore, m")
    inner_depth: float = Field(default=3.0, ge=0.2, le=100.0, description="Depth inside a lagoon, m")
    height: float = Field(default=6.0, ge=0.0, le=300.0, description="Approximate height of the land, m")
    slope: float = Field(default=0.06, ge=0.01, le=1.0, description="Slope of the floor at the waterline")
    roughness: Share = 0.5
    """Irregularity of the coastline: bays and capes; 0: the plain shape"""
    relief: Share = Field(default=0.0, description="Ruggedness of the land: ridges and valleys; 0: smooth hills")
    level: float = Field(default=0.0, ge=-1000.0, le=100.0)
    """Vertical offset of floor and land, m; negative values raise the water"""
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the coastline and the terrain")
    image: str | None = Field(default=None, max_length=8192)
    """Height map for kind 'image': a base64 PNG, 2 to 128 pixels a side; black is the offshore depth, white the height
    of the land; the top row is toward −z"""
    smoothing: float = Field(default=6.0, ge=0.0, le=60.0)
    """Standard deviation of the Gaussian that smooths the distance to the shore, m"""
    sand: Rgb = Field(default=(0.66, 0.56, 0.40), description="Albedo of dry sand, linear RGB")
    rock: Rgb = Field(default=(0.27, 0.24, 0.21), description="Albedo of rock, on steep ground, linear RGB")
    plants: Rgb = Field(default=(0.06, 0.10, 0.035), description="Albedo of vegetation, linear RGB")
    plants_from: float = Field(default=2.0, ge=0.0, le=400.0, description="Height above which vegetation grows, m")
    reef: Share = Field(default=0.5, description="Fraction of the shallow floor covered by dark reef and seaweed")
    detail: Share = 1.0
    """Strength of the land's fine detail: sand ripples, layers and cracks of rock, clumps of plants, a line of seaweed,
    a film of water behind the swash; 0: smooth land"""
    shadows: bool = Field(default=False, description="Land throws shadows on land, water and the floor")
    surf: Surf = Field(default_factory=Surf)

    @model_validator(mode="after")
    def _pictured(self) -> "Shore":
        if (self.kind == "image") != (self.image is not None):
            raise ValueError("image: required for kind 'image', and allowed for no other kind")
        if self.image is not None:
            decoded_image(self.image)
        return self

    @property
    def deep(self) -> float:
        """Depth of the level floor below y = 0, m; at least 0.1, so that divisions by it are safe."""
        return max(self.depth - self.level, 0.1)

    @property
    def ground(self) -> "Shore":
        """The same ground, all else at its default: equal ones have the same height field."""
        return Shore.model_construct(**{name: getattr(self, name) for name in _GROUND})

    @property
    def approach(self) -> "Shore":
        """The ground and what a swell's way over it depends on, all else at its default."""
        surf = Surf.model_construct(**{name: getattr(self.surf, name) for name in _APPROACH})
        return self.ground.model_copy(update={"smoothing": self.smoothing, "surf": surf})


_GROUND = (
    "kind", "size", "heading", "radius", "depth", "inner_depth", "height", "slope", "roughness", "relief", "level",
    "seed", "image",
)  # fmt: skip
"""Fields that determine the height field."""
_APPROACH = ("height", "period", "heading", "exposure")
"""Fields of the surf that determine a swell's travel time, and how much of it arrives."""


@lru_cache(maxsize=16)
def decoded_image(encoded: str) -> Floats:
    """Return the grey values of a base64 PNG, (rows, columns) in [0, 1]. Raises ``ValueError`` with the reason."""
    # Here, because few scenes have an image.
    from PIL import Image

    try:
        with Image.open(io.BytesIO(base64.b64decode(encoded, validate=True)), formats=("PNG",)) as picture:
            if not (2 <= picture.width <= 128 and 2 <= picture.height <= 128):
                raise ValueError(f"image: {picture.width} × {picture.height} pixels; each side must be 2 to 128")
            deep = picture.mode.startswith("I")
            grey = np.asarray(picture if deep else picture.convert("L"), np.float64) / (65535.0 if deep else 255.0)
    except (OSError, SyntaxError, binascii.Error) as error:
        raise ValueError("image: not a readable PNG in base64") from error
    result: Floats = np.clip(grey, 0.0, 1.0)
    result.setflags(write=False)
    return result
