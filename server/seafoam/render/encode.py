"""Pictures as bytes: PNG and WebP for the eye, NPY for measurements."""

import io
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray
from PIL import Image

FrameFormat = Literal["png", "webp", "npy"]
FRAME_FORMATS: tuple[FrameFormat, ...] = get_args(FrameFormat)
MEDIA_TYPES: dict[FrameFormat, str] = {
    "png": "image/png",
    "webp": "image/webp",
    "npy": "application/x-npy",
}

PNG_COMPRESS_LEVEL = 1
"""zlib level. Foam is noise: level 6 takes several times as long to save some tenth of the bytes."""
WEBP_EFFORT = 10
"""Pillow's ``quality``, which is effort, not loss, where WebP is lossless; 0..100."""


def needs_linear(format: FrameFormat) -> bool:
    """Whether a format holds the linear frame (float32) rather than the finished picture (uint8)."""
    return format == "npy"


def encode(pixels: NDArray[Any], format: FrameFormat) -> bytes:
    """Encode a frame, rows from the top.

    pixels: (height, width, 4); uint8 for ``png`` and ``webp``, float32 for ``npy``.

    ``png`` and ``webp`` hold RGB, sRGB-encoded, lossless, without gamma or profile chunks; ``npy`` holds all four
    channels, linear, little-endian. The same pixels give the same bytes. Raises ``ValueError`` for another shape or
    type.
    """
    expected = np.dtype(np.float32 if needs_linear(format) else np.uint8)
    if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype != expected:
        raise ValueError(f"{format} needs (height, width, 4) of {expected}, not {pixels.shape} of {pixels.dtype}")
    buffer = io.BytesIO()
    if format == "npy":
        np.save(buffer, pixels.astype("<f4", copy=False), allow_pickle=False)
        return buffer.getvalue()
    picture = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    if format == "png":
        picture.save(buffer, "PNG", compress_level=PNG_COMPRESS_LEVEL)
    else:
        picture.save(buffer, "WEBP", lossless=True, quality=WEBP_EFFORT, method=0)
    return buffer.getvalue()
