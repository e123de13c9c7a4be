"""Frames as files: what is read back is what was drawn."""

import io
import struct

import numpy as np
import pytest
from PIL import Image

from seafoam.render.encode import encode


def drawn(height: int, width: int) -> np.ndarray:
    """Noise over a ramp, with both ends of the range, so that differences wrap."""
    rng = np.random.default_rng(height * 10007 + width)
    pixels = rng.integers(0, 256, (height, width, 4), dtype=np.uint8)
    pixels[height // 2 :, :, :3] = (np.arange(width, dtype=np.uint32)[:, None] * (3, 5, 7)).astype(np.uint8)
    pixels[0, ::2], pixels[0, 1::2] = 0, 255
    return pixels


@pytest.mark.parametrize("size", [(1, 1), (1, 7), (9, 1), (37, 53), (720, 1280)])
@pytest.mark.parametrize("format", ["png", "webp"])
def test_pixels_come_back(format: str, size: tuple[int, int]) -> None:
    pixels = drawn(*size)
    read = Image.open(io.BytesIO(encode(pixels, format)))
    assert (read.mode, read.size) == ("RGB", size[::-1])
    np.testing.assert_array_equal(np.asarray(read), pixels[..., :3])
    # A frame that lies bottom-up in memory is the same frame.
    assert encode(pixels[::-1][::-1], format) == encode(pixels.copy(), format)
    upside_down = Image.open(io.BytesIO(encode(pixels[::-1], format)))
    np.testing.assert_array_equal(np.asarray(upside_down), pixels[::-1, :, :3])


def test_a_png_holds_the_picture_and_nothing_else() -> None:
    content = encode(drawn(5, 6), "png")
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    kinds, at = [], 8
    while at < len(content):
        (length,) = struct.unpack(">I", content[at : at + 4])
        kinds.append(content[at + 4 : at + 8])
        at += 12 + length
    assert kinds == [b"IHDR", b"IDAT", b"IEND"]
    assert Image.open(io.BytesIO(content)).info == {}


def test_a_recipe_is_beside_the_picture() -> None:
    pixels, recipe = drawn(5, 6), '{"name":"Mörk – λ"}'
    content = encode(pixels, "png", recipe)
    read = Image.open(io.BytesIO(content))
    assert read.text == {"seafoam": recipe}
    np.testing.assert_array_equal(np.asarray(read), pixels[..., :3])
    bare = encode(pixels, "png")
    # Signature and IHDR, the chunk, the rest.
    assert (content[:33], content[-(len(bare) - 33) :]) == (bare[:33], bare[33:])
    assert encode(pixels, "webp", recipe) == encode(pixels, "webp")


@pytest.mark.parametrize(
    ("shape", "type", "format"),
    [((4, 4, 3), np.uint8, "png"), ((4, 4, 4), np.float32, "png"), ((4, 4), np.uint8, "png")],
)
def test_other_pictures_are_refused(shape: tuple[int, ...], type: type, format: str) -> None:
    with pytest.raises(ValueError, match="requires"):
        encode(np.zeros(shape, type), format)
