"""What a texture is: a typed, frozen description from which any process makes the same bytes, and its address."""

import json
from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

Format = Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]
_PATH = str.maketrans('{}[]"/', "()!*'~")
"""JSON's punctuation, and the slash of base64, by characters that stand in a path as they are (RFC 3986)."""
_JSON = str.maketrans("()!*'~", '{}[]"/')


class UnknownTextureError(KeyError):
    """No texture has that address, or none can be made of what it says."""


@dataclass(frozen=True, eq=False)
class Image:
    """Mip levels, largest first: (rows, columns) or (rows, columns, components), little-endian, as GL takes them."""

    format: Format
    levels: tuple[NDArray[Any], ...]


def halved(level: NDArray[np.float64]) -> NDArray[np.float64]:
    """The next mip level: means of 2 × 2 texels."""
    return 0.25 * (level[0::2, 0::2] + level[1::2, 0::2] + level[0::2, 1::2] + level[1::2, 1::2])


class TextureSpec(BaseModel, extra="forbid", frozen=True, allow_inf_nan=False):
    """Base class of descriptions of textures. Equal ones have the same bytes, on every machine."""

    kind: ClassVar[str]
    """First part of the address."""

    @abstractmethod
    def image(self) -> Image:
        """Return the texels. Raises ``KeyError`` or ``ValueError`` where there are none."""

    @property
    def canonical(self) -> str:
        """The fields that are not at their defaults, as JSON with sorted keys and no spaces."""
        document = self.model_dump(mode="json", exclude_defaults=True)
        return json.dumps(document, sort_keys=True, separators=(",", ":"), allow_nan=False)

    @property
    def address(self) -> str:
        """The kind alone, or the kind, a slash and the fields; a path that needs no escapes."""
        text = self.canonical
        return self.kind if text == "{}" else f"{self.kind}/{text.translate(_PATH)}"

    @classmethod
    def of_fields(cls, text: str) -> Self:
        """Return what has these fields, as in an address; empty: all defaults. Raises ``ValueError``."""
        return cls.model_validate_json(text.translate(_JSON) or "{}")
