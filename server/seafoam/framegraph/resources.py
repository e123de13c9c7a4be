"""Textures and targets of a frame plan, and how they are read."""

from typing import Annotated, Final, Literal

from pydantic import Field

from seafoam.framegraph.rules import PlanPart


class TextureInput(PlanPart):
    """A sampler reads a texture of the plan."""

    texture: str


class TargetInput(PlanPart):
    """A sampler reads what an earlier pass drew into a target of the plan."""

    target: str


class ViewportSize(PlanPart):
    """As large as the picture, times ``scale`` and over ``part`` along each side, over ``narrow`` more along the width,
    rounded up."""

    rule: Literal["viewport"] = "viewport"
    scale: int = Field(default=1, ge=1)
    part: int = Field(default=1, ge=1)
    narrow: int = Field(default=1, ge=1)


class FixedSize(PlanPart):
    """A size in pixels."""

    rule: Literal["fixed"] = "fixed"
    width: int
    height: int


TargetFormat = Literal["RGBA16F", "RGBA32F", "RGBA8", "RG32UI"]
"""RG32UI: whole numbers, which no pass clears or blends, nor tests for depth; read texel by texel."""


Filter = Literal["nearest", "linear", "linear_mipmap_linear"]


MIPMAPPED: Final = "linear_mipmap_linear"
"""A target with this filter has levels of means of 2 × 2 texels below it, made anew after each pass into it."""


WrapMode = Literal["repeat", "clamp_to_edge"]


class Target(PlanPart):
    """A picture that passes draw into and later passes read."""

    size: Annotated[ViewportSize | FixedSize, Field(discriminator="rule")]
    format: TargetFormat
    depth: bool = False
    filter: Filter = "nearest"
    wrap: WrapMode = "clamp_to_edge"


class Texture(PlanPart):
    """Texture data: levels from the largest, rows from v = 0, tightly packed little-endian, one after the other."""

    url: str = Field(description="Where the bytes are, below the server's address")
    sha256: str = Field(description="Of the bytes")
    format: Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]
    width: int
    height: int
    levels: int
    filter: Filter
    wrap: WrapMode
