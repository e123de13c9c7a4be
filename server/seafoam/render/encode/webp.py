"""WebP: lossless, with the recipe as a property of its XMP packet (ISO 16684-1).

Functions import Pillow themselves, because most frames are PNG.
"""

import io
from html import escape
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from seafoam.render.encode.recipes import KEYWORD

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
    from PIL import Image

    buffer = io.BytesIO()
    picture = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    packet = b"" if recipe is None else _PACKET.format(escape(recipe, quote=False)).encode()
    picture.save(buffer, "WEBP", lossless=True, quality=EFFORT, method=0, xmp=packet)
    return buffer.getvalue()


def recipe_in_webp(content: bytes) -> str | None:
    """Return the recipe of a WebP, or None. Raises ``OSError`` or ``ElementTree.ParseError`` for a damaged file."""
    if content[:4] != b"RIFF" or content[8:12] != b"WEBP":
        return None
    from PIL import Image

    with Image.open(io.BytesIO(content)) as picture:
        packet = picture.info.get("xmp")
    if not packet:
        return None
    found = ElementTree.fromstring(packet).find(f".//{{{_OURS}}}recipe")
    return None if found is None else found.text
