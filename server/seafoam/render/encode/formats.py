"""Files of a frame other than PNG, and the recipe that they carry: OpenEXR for compositing, WebP, and JPEG in motion.

OpenEXR is linear light, by the project's own library. WebP is lossless, with the recipe as a property of its XMP packet
(ISO 16684-1). Functions import OpenEXR and Pillow themselves, because most frames are PNG.
"""

import io
from html import escape
from typing import Any, Literal
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

KEYWORD = "seafoam"
"""Name of the recipe: keyword of PNG's chunk, attribute of OpenEXR's header, prefix of its property in XMP."""


class NoRecipeError(ValueError):
    """A file is no picture with a recipe; the text says what it is instead."""


Precision = Literal["half", "float"]
COVERAGE = "coverage"
"""Channel of foam coverage. Not ``A``, which readers take for opacity."""
NORMAL = ("N.X", "N.Y", "N.Z")
"""Channels of the unit normal, y up."""
DISTANCE = "distance"
"""Channel of the distance from the camera, m. Not ``Z``, which readers take along the view axis."""
_EXR, _PNG = b"v/1\x01", b"\x89PNG"
"""Beginnings of files."""
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


EFFORT = 10
"""Pillow's ``quality`` of lossless WebP, 0..100, which controls effort, not loss."""
_OURS = "urn:seafoam:recipe:"
_PACKET = (
    '<x:xmpmeta xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" '
    f'xmlns:{KEYWORD}="{_OURS}" xmlns:x="adobe:ns:meta/"><rdf:RDF><rdf:Description rdf:about="">'
    f"<{KEYWORD}:recipe>{{}}</{KEYWORD}:recipe></rdf:Description></rdf:RDF></x:xmpmeta>"
)


def encode_webp(pixels: NDArray[np.uint8], recipe: str | None) -> bytes:
    """Encode RGB of (height, width, 3 or 4), and the recipe, if any."""
    packet = b"" if recipe is None else _PACKET.format(escape(recipe, quote=False)).encode()
    return _saved(pixels, "WEBP", lossless=True, quality=EFFORT, method=0, xmp=packet)


def recipe_of(content: bytes) -> str | None:
    """Return the recipe of a PNG, WebP or OpenEXR file, or None.

    Raises ``OSError``, ``RuntimeError``, ``ValueError`` or ``ElementTree.ParseError`` for a damaged file.
    """
    if content.startswith(_EXR):
        import OpenEXR

        file = OpenEXR.File(io.BytesIO(content), header_only=True, num_threads=0)
        in_exr: str | None = file.header().get(KEYWORD)
        return in_exr
    if not content.startswith((_PNG, b"RIFF")):
        return None
    from PIL import Image

    with Image.open(io.BytesIO(content), formats=("PNG", "WEBP")) as picture:
        in_png: str | None = picture.info.get(KEYWORD)
        packet = picture.info.get("xmp")
    if in_png is not None or not packet:
        return in_png
    return ElementTree.fromstring(packet).findtext(f".//{{{_OURS}}}recipe")


QUALITY = 85
"""Of libjpeg-turbo, 0..100. ``default``, 640 × 360 pixels, processor time: 1.1 ms, RMSE 3.1 levels, 45 kB, and 1.6 ms
to decode it; WebP of the same bytes 8.6 and 5.4 ms, a tenth of what the frame takes to draw, for an RMSE of 2.9."""


def encode_jpeg(pixels: NDArray[np.uint8]) -> bytes:
    """Encode RGB of (height, width, 3 or 4), colours at half the size (4:2:0), without recipe."""
    return _saved(pixels, "JPEG", quality=QUALITY, subsampling="4:2:0")


def _saved(pixels: NDArray[np.uint8], format: str, **options: Any) -> bytes:
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels[..., :3])).save(buffer, format, **options)
    return buffer.getvalue()
