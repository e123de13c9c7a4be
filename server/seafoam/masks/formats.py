"""Masks as files. All hold data, not colour: linear, no gamma, row 0 first, tileable both ways.

``rank`` runs over 0..N-1 with N texels. Integer formats of b bits hold floor(rank 2^b / N), which uses the full
range at every size; the threshold of a stored v is (v + 0.5) / 2^b.
"""

import io
import struct

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.torus import Ranks

DXGI_FORMAT_R16_UNORM = 56
"""Numbers from 0 to 1. No format of 16 bits is sRGB, so readers take it as it is."""
_LINEAR = struct.pack(">I", 100_000)
"""Gamma 1 in PNG's unit (ISO 15948, 11.3.2.2)."""


def quantised(ranks: Ranks, bits: int) -> NDArray[np.uint64]:
    """floor(rank 2^bits / N), of the shape of ``ranks``."""
    return (ranks.astype(np.uint64) << np.uint64(bits)) // np.uint64(ranks.size)


def to_u16(ranks: Ranks) -> bytes:
    """Raw little-endian uint16, row by row: floor(rank 65536 / N). 2 N bytes."""
    return quantised(ranks, 16).astype("<u2").tobytes()


def to_png16(ranks: Ranks) -> bytes:
    """16-bit greyscale PNG of the values of :func:`to_u16`, tagged as linear (gamma 1)."""
    return _png(quantised(ranks, 16).astype(np.uint16))


def to_png8(ranks: Ranks) -> bytes:
    """8-bit greyscale PNG of floor(rank 256 / N), for quick use: N / 256 texels share each value. Tagged as linear."""
    return _png(quantised(ranks, 8).astype(np.uint8))


def to_npy(ranks: Ranks) -> bytes:
    """NumPy file of float32 thresholds (rank + 0.5) / N, exact where N is a power of two."""
    buffer = io.BytesIO()
    np.save(buffer, ((ranks + 0.5) / ranks.size).astype("<f4"), allow_pickle=False)
    return buffer.getvalue()


def to_dds(ranks: Ranks) -> bytes:
    """DirectDraw Surface with a DX10 header, R16_UNORM, one level, of the values of :func:`to_u16`."""
    height, width = ranks.shape
    caps, height_flag, width_flag, pitch_flag, pixel_format = 0x1, 0x2, 0x4, 0x8, 0x1000
    flags = caps | height_flag | width_flag | pitch_flag | pixel_format
    header = struct.pack("<7I44x", 124, flags, height, width, 2 * width, 1, 1)
    fourcc_flag, texture_cap, texture_2d = 0x4, 0x1000, 3
    pixels = struct.pack("<2I4s5I", 32, fourcc_flag, b"DX10", 0, 0, 0, 0, 0)
    capabilities = struct.pack("<5I", texture_cap, 0, 0, 0, 0)
    dx10 = struct.pack("<5I", DXGI_FORMAT_R16_UNORM, texture_2d, 0, 1, 0)
    return b"DDS " + header + pixels + capabilities + dx10 + to_u16(ranks)


def decode_ranks(content: bytes, size: int) -> Ranks:
    """Ranks of a ``.ranks`` file (masks/README.md) of a (size, size) mask. Raises ``ValueError`` for another length."""
    texels = size * size
    if len(content) != 2 * texels + texels // 4:
        raise ValueError(f"{len(content)} bytes cannot hold {size} x {size} ranks")
    low = np.frombuffer(content, "<u2", texels).astype(np.uint32)
    packed = np.frombuffer(content, np.uint8, offset=2 * texels)
    high = (packed[:, None] >> np.array([0, 2, 4, 6], np.uint8)) & 3
    ranks: Ranks = low | high.ravel().astype(np.uint32) << np.uint32(16)
    return ranks.reshape(size, size)


def _png(values: NDArray[np.uint8 | np.uint16]) -> bytes:
    # Here, because masks are read and drawn without it.
    from PIL import Image, PngImagePlugin

    info = PngImagePlugin.PngInfo()
    info.add(b"gAMA", _LINEAR)
    buffer = io.BytesIO()
    Image.fromarray(values).save(buffer, "PNG", pnginfo=info)
    return buffer.getvalue()
