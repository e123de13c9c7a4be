"""Textures and targets of a frame plan, and how they are read."""

import re
from collections.abc import Container
from typing import Annotated, Final, Literal, Self

from pydantic import Field

from seafoam.framegraph.rules import PlanPart


class TextureInput(PlanPart):
    """A sampler that reads a texture of the plan."""

    texture: str


class TargetInput(PlanPart):
    """A sampler that reads a target of the plan, drawn by an earlier pass."""

    target: str


Input = TextureInput | TargetInput
"""What a sampler reads."""


def sampler_of(name: str) -> str:
    """Return the sampler that reads a target or texture if nothing else is said: ``u_start_wide`` "start, wide"."""
    return f"u_{re.sub(r'[ ,]+', '_', name)}"


def source_of(name: str, textures: Container[str]) -> Input:
    """Return what reads the texture or target of a name."""
    return TextureInput(texture=name) if name in textures else TargetInput(target=name)


class ViewportSize(PlanPart):
    """The picture's size times ``scale``, divided by ``part`` along each side and by ``narrow`` also along the width,
    rounded up; ``odd``: to an odd number, at least 3.

    Software drivers compile a program anew where a side of what it reads becomes a power of two.
    """

    rule: Literal["viewport"] = "viewport"
    scale: int = Field(default=1, ge=1)
    part: int = Field(default=1, ge=1)
    narrow: int = Field(default=1, ge=1)
    odd: bool = False

    def of_picture(self, width: int, height: int) -> tuple[int, int]:
        """Return width and height in a picture of this size, pixels."""
        sides = -(-width * self.scale // (self.part * self.narrow)), -(-height * self.scale // self.part)
        return (max(3, sides[0] | 1), max(3, sides[1] | 1)) if self.odd else sides


class FixedSize(PlanPart):
    """A fixed size in pixels."""

    rule: Literal["fixed"] = "fixed"
    width: int
    height: int

    @classmethod
    def square(cls, side: int) -> Self:
        """Return the size of a square."""
        return cls(width=side, height=side)

    def of_picture(self, width: int, height: int) -> tuple[int, int]:
        """Return width and height, pixels, which are the same in every picture."""
        return self.width, self.height


TargetFormat = Literal["R16F", "RGBA16F", "RGBA32F", "RGBA8", "RG32UI"]
"""RG32UI: integers, which no pass clears, blends or depth-tests; sampled texel by texel."""
Filter = Literal["nearest", "linear", "linear_mipmap_linear"]
MIPMAPPED: Final = "linear_mipmap_linear"
"""A target with this filter has mip levels, means of 2 × 2 texels, generated after each pass into it."""
WrapMode = Literal["repeat", "clamp_to_edge"]


class Target(PlanPart):
    """A render target: passes draw into it, and later passes read it.

    ``layers``: more than one make an array of textures, whose layers a pass draws all at once, each by one of its
    program's outputs: what these have in common is computed once. Without mip levels.
    """

    size: Annotated[ViewportSize | FixedSize, Field(discriminator="rule")]
    format: TargetFormat
    depth: bool = False
    filter: Filter = "nearest"
    wrap: WrapMode = "clamp_to_edge"
    layers: int = Field(default=1, ge=1, le=4)


class Texture(PlanPart):
    """Texture data: mip levels, largest first, concatenated; rows from v = 0, tightly packed, little-endian."""

    url: str = Field(description="Path of the bytes, relative to the server's address")
    sha256: str = Field(description="SHA-256 of the bytes")
    format: Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]
    width: int
    height: int
    levels: int
    filter: Filter
    wrap: WrapMode
