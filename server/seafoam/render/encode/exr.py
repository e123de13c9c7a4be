"""OpenEXR by the project's own library: linear light for compositing.

Functions import the library themselves, because most frames are PNG.
"""

import io
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.render.encode.recipes import KEYWORD

Precision = Literal["half", "float"]
COVERAGE = "coverage"
"""Channel of foam coverage. Not ``A``, which readers take for opacity."""
NORMAL = ("N.X", "N.Y", "N.Z")
"""Channels of the unit normal, y up."""
DISTANCE = "distance"
"""Channel of the distance from the camera, m. Not ``Z``, which readers take along the view axis."""
_MAGIC = b"v/1\x01"
_REC709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""CIE x, y of the primaries and of white (ITU-R BT.709): those of sRGB."""
_LINEAR = "lin_rec709_scene"
"""Name of linear light with these primaries by the Color Interop Forum."""


def encode_exr(pixels: NDArray[np.float32], precision: Precision, recipe: str | None) -> bytes:
    """Encode (height, width, 4 or 8) as R, G, B, ``coverage``, and of 8 normal and ``distance``, ZIP, with the recipe.

    ``half`` rounds to 11 significant bits, and what exceeds its largest number, 65504, becomes that; distances are
    float32 always, and infinite instead of 0.
    """
    import OpenEXR

    values = pixels
    if precision == "half":
        largest = np.finfo(np.float16).max
        values = np.clip(pixels, -largest, largest).astype(np.float16)
    header = {
        "compression": OpenEXR.ZIP_COMPRESSION,
        "type": OpenEXR.scanlineimage,
        "chromaticities": _REC709,
        "colorInteropID": _LINEAR,
        **({} if recipe is None else {KEYWORD: recipe}),
    }
    channels = {"RGB": np.ascontiguousarray(values[..., :3]), COVERAGE: np.ascontiguousarray(values[..., 3])}
    if pixels.shape[2] == 8:
        channels |= {name: np.ascontiguousarray(values[..., 4 + axis]) for axis, name in enumerate(NORMAL)}
        away = pixels[..., 7]
        channels[DISTANCE] = np.where(away > 0.0, away, np.float32(np.inf))
    buffer = io.BytesIO()
    # In this thread: the render workers and the other pictures use the other cores.
    OpenEXR.File(header, channels, num_threads=0).write(buffer)
    return buffer.getvalue()


def recipe_in_exr(content: bytes) -> str | None:
    """Return the recipe of an OpenEXR file, or None. Raises ``RuntimeError`` for a damaged file."""
    if not content.startswith(_MAGIC):
        return None
    import OpenEXR

    file = OpenEXR.File(io.BytesIO(content), header_only=True, num_threads=0)
    found = file.header().get(KEYWORD)
    return found if isinstance(found, str) else None
