"""PNG (ISO 15948): one row filter and ISA-L's deflate, in stripes of rows at once; 8-bit pictures without bands."""

import os
import struct
from concurrent.futures import ThreadPoolExecutor
from functools import cache, lru_cache
from itertools import pairwise

import numpy as np
from isal import isal_zlib
from numpy.typing import NDArray

from seafoam.masks.catalogue import load_mask
from seafoam.render.encode.formats import KEYWORD

MASK = "vac-1.5"
"""The mask with the finest pattern."""
_SHIFTS = ((0, 0), (171, 341), (341, 171), (0, 0))
"""Places of the mask for the channels, texels: apart, so that the pattern is not one of brightness alone."""
BAND = 32
"""Rows at a time: what is computed on stays in the processor's cache. A divisor of the mask's side."""


@lru_cache(maxsize=4)
def _thresholds(width: int) -> NDArray[np.uint16]:
    """The mask, tiled to a width: (side, width, 4) of whole numbers 0..255 that all occur equally often."""
    ranks = load_mask(MASK).ranks
    scaled = (ranks.astype(np.uint64) * 256 // ranks.size).astype(np.uint16)
    channels = np.stack([np.roll(scaled, shift, axis=(0, 1)) for shift in _SHIFTS], axis=-1)
    return np.ascontiguousarray(np.tile(channels, (1, -(-width // len(ranks)), 1))[:, :width])


def dithered(pixels: NDArray[np.uint16], first: int = 0) -> NDArray[np.uint8]:
    """Return (height, width, 4), 65535 = display white, as 8 bits.

    first: the picture's row that is row 0, a multiple of :data:`BAND`.

    A value between two levels becomes the upper one in as many places of the mask as it lies above the lower one, so a
    mean over the mask's tile differs from the mean of the values by less than a hundredth of a level. Black stays
    black and white white. The same pixels give the same result.
    """
    height, width, _ = pixels.shape
    result = np.empty(pixels.shape, np.uint8)
    mask = _thresholds(width)
    for top in range(0, height, BAND):
        values = pixels[top : top + BAND]
        at = (first + top) % len(mask)
        # 16 bits hold it: 65535 becomes 255 levels of 256 steps, and a threshold is less than a level.
        scaled = values >> 8
        np.subtract(values, scaled, out=scaled)
        scaled += mask[at : at + len(values)]
        scaled >>= 8
        result[top : top + BAND] = scaled
    return result


COMPRESS_LEVEL = 2
"""Level of ISA-L, 0..3: as fast as its level 1; files as small as by zlib's level 1, which takes six times as long."""
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_STRIPE_PIXELS = 2**17
"""Of a stripe at least; the bytes depend on it, and not on the number of processors."""
_MAX_STRIPES = 8
_ZLIB_HEADER = b"\x78\x01"
"""Deflate with a window of 32 KiB, least effort (RFC 1950, 2.2)."""
_SUB = 1
"""The PNG filter of every row: each byte less the same channel of the pixel to its left."""
_SRGB = b"\0"
"""Content of the chunk that says that the picture is sRGB, to be shown as a photograph is (ISO 15948, 11.3.2.5)."""
_NOTE = KEYWORD.encode("latin-1") + b"\0\0\0\0\0"
"""Start of the chunk with a frame's recipe: not compressed, without language (ISO 15948, 11.3.3.4)."""


@cache
def _threads() -> ThreadPoolExecutor:
    """NumPy and ISA-L let other threads run; all pictures of a process share these."""
    return ThreadPoolExecutor(os.cpu_count(), thread_name_prefix="png")


def encode_png(pixels: NDArray[np.uint8 | np.uint16], recipe: str | None) -> bytes:
    """Encode RGB of (height, width, 4): one IDAT chunk, tagged as sRGB, and the recipe, if any, in an ``iTXt`` chunk.

    16 bits are dithered to 8.
    """
    height, width, _ = pixels.shape
    bands = -(-height // BAND)
    count = max(1, min(height * width // _STRIPE_PIXELS, _MAX_STRIPES, bands))
    edges = [min(BAND * (bands * i // count), height) for i in range(count + 1)]
    stripes = [*_threads().map(lambda rows: _stripe(pixels, *rows), pairwise(edges))]
    checksum = 1
    for rows, _ in stripes:
        checksum = isal_zlib.adler32(rows, checksum)
    # 8 bits per channel, RGB, the only defined compression and filter methods, not interlaced.
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    body = b"".join((_ZLIB_HEADER, *(deflated for _, deflated in stripes), struct.pack(">I", checksum)))
    note = b"" if recipe is None else _chunk(b"iTXt", _NOTE + recipe.encode())
    head = _chunk(b"IHDR", header) + _chunk(b"sRGB", _SRGB) + note
    return b"".join((_SIGNATURE, head, _chunk(b"IDAT", body), _chunk(b"IEND", b"")))


def _stripe(pixels: NDArray[np.uint8 | np.uint16], top: int, bottom: int) -> tuple[NDArray[np.uint8], bytes]:
    """Return some rows, filtered, and the same as a part of a deflate stream (RFC 1951) that ends on a whole byte."""
    stripe = pixels[top:bottom]
    shown = dithered(stripe.astype(np.uint16, copy=False), top) if stripe.dtype == np.uint16 else stripe
    height, width, _ = shown.shape
    rows = np.empty((height, 1 + 3 * width), np.uint8)
    rows[:, 0] = _SUB
    filtered = rows[:, 1:].reshape(height, width, 3)
    for channel in range(3):
        plane = shown[..., channel]
        filtered[:, 0, channel] = plane[:, 0]
        np.subtract(plane[:, 1:], plane[:, :-1], out=filtered[:, 1:, channel])
    deflate = isal_zlib.compressobj(COMPRESS_LEVEL, isal_zlib.DEFLATED, -isal_zlib.MAX_WBITS)
    end = isal_zlib.Z_FINISH if bottom == len(pixels) else isal_zlib.Z_SYNC_FLUSH
    return rows, deflate.compress(rows) + deflate.flush(end)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", isal_zlib.crc32(data, isal_zlib.crc32(kind)))
