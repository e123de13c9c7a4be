"""The bytes of textures, and their addresses. An address holds the whole description, so any process can make them."""

import gzip
import hashlib
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from seafoam.textures.foam import FoamTexture
from seafoam.textures.front import FrontIntegral
from seafoam.textures.masks import MaskTexture
from seafoam.textures.parts import TexturePart, lower_part, upper_part
from seafoam.textures.sea import FftTwiddles, SeaSpectrum
from seafoam.textures.shore import ShoreFloor, ShoreProfiles, ShoreTravel
from seafoam.textures.spec import Format, TextureSpec, UnknownTextureError
from seafoam.textures.spray import SprayRocks, SprayStrands

PREFIX = "/api/textures/"
"""What an address begins with in a plan."""
GZIP_LEVEL = 4
_OF_WATER: tuple[type[TextureSpec], ...] = (FftTwiddles, FoamTexture, FrontIntegral, MaskTexture, SeaSpectrum)
_OF_SHORES: tuple[type[TextureSpec], ...] = (ShoreFloor, ShoreProfiles, ShoreTravel, SprayRocks, SprayStrands)
_KINDS = {one.kind: one for one in (*_OF_WATER, *_OF_SHORES)}


@dataclass(frozen=True)
class TextureData:
    """Mip levels, largest first, concatenated; rows from v = 0, tightly packed, little-endian."""

    data: bytes
    sha256: str
    format: Format
    width: int
    height: int
    levels: int

    @cached_property
    def gzipped(self) -> bytes | None:
        """The data compressed by gzip, if that saves at least a tenth: atlases contain each texel four times."""
        packed = gzip.compress(self.data, GZIP_LEVEL, mtime=0)
        return packed if 10 * len(packed) <= 9 * len(self.data) else None

    def part(self, part: TexturePart) -> bytes:
        """Return a part of texels of 16 bits, see :mod:`seafoam.textures.parts`; the upper one is compressed by gzip.

        Raises ``ValueError`` for a texture of another format.
        """
        if self.format != "R16UI":
            raise ValueError(f"part: a texture of format {self.format} has no parts, only R16UI has")
        return self._upper if part == "upper" else lower_part(self._texels)

    @property
    def _texels(self) -> NDArray[np.uint16]:
        return np.frombuffer(self.data, "<u2").reshape(self.height, self.width)

    @cached_property
    def _upper(self) -> bytes:
        return upper_part(self._texels)


@lru_cache(maxsize=64)
def texture(spec: TextureSpec) -> TextureData:
    """Return the texture's bytes. Raises :class:`UnknownTextureError` where there are none."""
    try:
        image = spec.image()
    except (KeyError, ValueError) as error:
        raise UnknownTextureError(spec.address) from error
    data = b"".join(level.tobytes() for level in image.levels)
    height, width = image.levels[0].shape[:2]
    return TextureData(data, hashlib.sha256(data).hexdigest(), image.format, width, height, len(image.levels))


def url_of(spec: TextureSpec) -> str:
    """Return the path of a texture's bytes, as a plan has it."""
    return PREFIX + spec.address


def spec_of(url: str) -> TextureSpec:
    """Return the description in what :func:`url_of` gave. Raises :class:`UnknownTextureError` for any other text."""
    if not url.startswith(PREFIX):
        raise UnknownTextureError(url)
    return spec_at(url.removeprefix(PREFIX))


def spec_at(address: str) -> TextureSpec:
    """Return what has this address. Raises :class:`UnknownTextureError` where nothing has."""
    kind, _, fields = address.partition("/")
    try:
        found = _KINDS[kind].of_fields(fields)
    except (KeyError, ValueError):
        raise UnknownTextureError(address) from None
    # One address each: caches and hashes of plans rest on it.
    if found.address != address:
        raise UnknownTextureError(address)
    return found
