"""Encodes frames: PNG and WebP for display, JPEG in motion, OpenEXR for compositing, NPY for measurements."""

import io
from importlib.metadata import version
from typing import Any, Literal, get_args
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from seafoam.render.encode.formats import NoRecipeError, Precision, encode_exr, encode_jpeg, encode_webp, recipe_of
from seafoam.render.encode.png import dithered, encode_png

__all__ = [
    "BYTES_PER_PIXEL", "ENCODERS", "FRAME_FORMATS", "MEDIA_TYPES", "FrameFormat", "NoRecipeError", "Output",
    "Precision", "encode", "encode_jpeg", "output_of", "read_recipe",
]  # fmt: skip

FrameFormat = Literal["png", "webp", "exr", "npy"]
FRAME_FORMATS: tuple[FrameFormat, ...] = get_args(FrameFormat)
MEDIA_TYPES: dict[FrameFormat, str] = {
    "png": "image/png",
    "webp": "image/webp",
    "exr": "image/x-exr",
    "npy": "application/x-npy",
}
ENCODERS = {name: version(name) for name in ("isal", "Pillow", "OpenEXR", "numpy")}
"""Versions of the packages that a file's bytes depend on."""

Output = Literal["rgba8", "rgba16", "linear"]
_TYPES: dict[Output, type[np.generic]] = {"rgba8": np.uint8, "rgba16": np.uint16, "linear": np.float32}
BYTES_PER_PIXEL: dict[Output, int] = {output: 4 * np.dtype(type).itemsize for output, type in _TYPES.items()}


def output_of(format: FrameFormat, dither: bool) -> Output:
    """Return what a renderer must give for a format. dither: of ``png`` and ``webp``."""
    if format in ("npy", "exr"):
        return "linear"
    return "rgba16" if dither else "rgba8"


def encode(
    pixels: NDArray[Any], format: FrameFormat, recipe: str | None = None, *, precision: Precision = "half"
) -> bytes:
    """Encode a frame, top row first.

    pixels: (height, width, 4); for ``png`` and ``webp`` uint8, or uint16 to be dithered; float32 for ``exr`` and
    ``npy``; ``exr`` also of (height, width, 8) with normal and distance, which is 0 where there is none. recipe: text
    that the file carries; ``npy`` has no place for it. precision: of ``exr``.

    ``png`` and ``webp`` hold RGB, sRGB-encoded, lossless; PNG says so, and WebP is sRGB without a profile. ``exr``
    holds R, G, B, coverage, normal and distance, ``npy`` the first four, linear, little-endian. The same pixels give
    the same bytes.
    """
    if format == "npy":
        buffer = io.BytesIO()
        np.save(buffer, pixels.astype("<f4", copy=False), allow_pickle=False)
        return buffer.getvalue()
    if format == "exr":
        return encode_exr(pixels, precision, recipe)
    if format == "png":
        return encode_png(pixels, recipe)
    return encode_webp(dithered(pixels) if pixels.dtype == np.uint16 else pixels, recipe)


def read_recipe(content: bytes) -> str:
    """Return the recipe that a PNG, WebP or OpenEXR file carries. Raises :class:`NoRecipeError`."""
    try:
        found = recipe_of(content)
    except (OSError, RuntimeError, ValueError, ElementTree.ParseError) as error:
        raise NoRecipeError(f"it is damaged: {error}") from error
    if found is None:
        raise NoRecipeError("it is no PNG, WebP or OpenEXR picture with a recipe")
    return found
