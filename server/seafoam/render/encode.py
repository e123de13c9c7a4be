"""Encodes frames: PNG and WebP for display, NPY for measurements."""

import io
import struct
import zlib
from typing import Any, Literal, get_args

import numpy as np
from isal import isal_zlib
from numpy.typing import NDArray
from PIL import Image

FrameFormat = Literal["png", "webp", "npy"]
FRAME_FORMATS: tuple[FrameFormat, ...] = get_args(FrameFormat)
MEDIA_TYPES: dict[FrameFormat, str] = {
    "png": "image/png",
    "webp": "image/webp",
    "npy": "application/x-npy",
}

RECIPE_KEYWORD = "seafoam"
"""Keyword of the chunk with a frame's recipe: not compressed, without language (ISO 15948, 11.3.3.4)."""
PNG_COMPRESS_LEVEL = 2
"""Level of ISA-L, 0..3: as fast as its level 1; files as small as by zlib's level 1, which takes six times as long."""
_SUB = 1
"""The PNG filter of every row: each byte less the same channel of the pixel to its left."""
WEBP_EFFORT = 10
"""Pillow's ``quality`` of lossless WebP, 0..100, which controls effort, not loss."""


def needs_linear(format: FrameFormat) -> bool:
    """Whether a format contains the linear frame (float32) instead of the displayed picture (uint8)."""
    return format == "npy"


def encode(pixels: NDArray[Any], format: FrameFormat, recipe: str | None = None) -> bytes:
    """Encode a frame, top row first.

    pixels: (height, width, 4); uint8 for ``png`` and ``webp``, float32 for ``npy``. recipe: text that a PNG carries
    in an ``iTXt`` chunk; other formats ignore it.

    ``png`` and ``webp`` hold RGB, sRGB-encoded, lossless, without gamma or profile chunks; ``npy`` holds all four
    channels, linear, little-endian. The same pixels give the same bytes. Raises ``ValueError`` for another shape or
    type.
    """
    expected = np.dtype(np.float32 if needs_linear(format) else np.uint8)
    if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype != expected:
        raise ValueError(f"{format} requires (height, width, 4) of {expected}, not {pixels.shape} of {pixels.dtype}")
    buffer = io.BytesIO()
    if format == "npy":
        np.save(buffer, pixels.astype("<f4", copy=False), allow_pickle=False)
        return buffer.getvalue()
    if format == "png":
        return _png(pixels, recipe)
    picture = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    picture.save(buffer, "WEBP", lossless=True, quality=WEBP_EFFORT, method=0)
    return buffer.getvalue()


def _png(pixels: NDArray[Any], recipe: str | None) -> bytes:
    """Encode RGB of (height, width, 4) uint8 as PNG (ISO 15948): one row filter, one IDAT chunk, the recipe if any."""
    height, width, _ = pixels.shape
    rows = np.empty((height, 1 + 3 * width), np.uint8)
    rows[:, 0] = _SUB
    filtered = rows[:, 1:].reshape(height, width, 3)
    for channel in range(3):
        plane = pixels[..., channel]
        filtered[:, 0, channel] = plane[:, 0]
        np.subtract(plane[:, 1:], plane[:, :-1], out=filtered[:, 1:, channel])
    # 8 bits per channel, RGB, the only defined compression and filter methods, not interlaced.
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    body = isal_zlib.compress(rows, PNG_COMPRESS_LEVEL)
    note = (
        b"" if recipe is None else _chunk(b"iTXt", RECIPE_KEYWORD.encode("latin-1") + b"\0\0\0\0\0" + recipe.encode())
    )
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + note + _chunk(b"IDAT", body) + _chunk(b"IEND", b"")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(data, zlib.crc32(kind)))
