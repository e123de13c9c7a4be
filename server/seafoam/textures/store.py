"""The bytes of textures, and their addresses. An address holds the whole description, so any process can make them.

Texels of 16 bits come in two parts, of which the first is small: a page shows water before it has the second. The upper
bits of texels that lie side by side are alike, so their differences compress; the lower bits are as good as random and
most of the bytes.
"""

import gzip
import hashlib
import zlib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.textures.foam import FoamTexture, SprayStrands
from seafoam.textures.masks import MaskTexture
from seafoam.textures.shore import ShoreFloor, ShoreProfiles, ShoreTravel, SprayRocks
from seafoam.textures.spec import Format, TextureSpec, UnknownTextureError
from seafoam.textures.waves import FftTwiddles, FrontIntegral, SeaSpectrum

PREFIX = "/api/textures/"
"""What an address begins with in a plan."""
GZIP_LEVEL = 4
_OF_WATER: tuple[type[TextureSpec], ...] = (FftTwiddles, FoamTexture, FrontIntegral, MaskTexture, SeaSpectrum)
_OF_SHORES: tuple[type[TextureSpec], ...] = (ShoreFloor, ShoreProfiles, ShoreTravel, SprayRocks, SprayStrands)
_KINDS = {one.kind: one for one in (*_OF_WATER, *_OF_SHORES)}
TexturePart = Literal["upper", "lower"]
UPPER_BITS = 6
"""Bits of a texel in the first part. By these alone pictures of filtered foam differ by less than 0.2 levels root mean
square; each bit more takes 95 kB of the three masks of lace."""
_LOWER_BITS = 16 - UPPER_BITS


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
        """Return a part of texels of 16 bits, the upper one is compressed by gzip.

        Raises ``ValueError`` for a texture of another format.
        """
        if self.format != "R16UI":
            raise ValueError(f"part: a texture of format {self.format} has no parts, only R16UI has")
        return self._parts[part]

    @cached_property
    def _parts(self) -> dict[TexturePart, bytes]:
        texels = np.frombuffer(self.data, "<u2").reshape(self.height, self.width)
        return {"upper": upper_part(texels), "lower": lower_part(texels)}


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


def upper_part(texels: NDArray[np.uint16]) -> bytes:
    """Return the upper bits of each texel as gzip, a byte each: what is to be added, modulo 64, to what its neighbours
    have one expect.

    That is the median of the texel before, the one of the row above, and their sum less the one between them (the
    predictor of JPEG-LS, ITU-T T.87). In the first row it is the texel before, in the first column the one above.
    """
    values = (texels >> _LOWER_BITS).astype(np.int16)
    before, above = np.zeros_like(values), np.zeros_like(values)
    before[:, 1:], above[1:] = values[:, :-1], values[:-1]
    expected = above + before
    between = values[:-1, :-1]
    low, high = np.minimum(before, above)[1:, 1:], np.maximum(before, above)[1:, 1:]
    expected[1:, 1:] = np.clip(low + high - between, low, high)
    coded = ((values - expected) % (1 << UPPER_BITS)).astype(np.uint8).tobytes()
    # Nothing repeats: codes of single bytes are smaller than those of matches, and quicker.
    packer = zlib.compressobj(9, zlib.DEFLATED, 16 + zlib.MAX_WBITS, 9, zlib.Z_HUFFMAN_ONLY)
    return packer.compress(coded) + packer.flush()


def lower_part(texels: NDArray[np.uint16]) -> bytes:
    """Return the other bits: the lowest 8 of each texel, then of all the 2 above, four texels to a byte, the first of
    four in the lowest bits.
    """
    flat = texels.ravel()
    pairs = ((flat >> 8) & 3).astype(np.uint8).reshape(-1, 4)
    packed = pairs[:, 0] | pairs[:, 1] << 2 | pairs[:, 2] << 4 | pairs[:, 3] << 6
    return (flat & 0xFF).astype(np.uint8).tobytes() + packed.tobytes()
