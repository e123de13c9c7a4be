"""Frames as files: what is read back is what was drawn."""

import io
import struct
from contextlib import suppress

import numpy as np
import OpenEXR
import pytest
from PIL import Image

from seafoam.masks.catalogue import load_mask
from seafoam.render.encode import NoRecipeError, encode, read_recipe
from seafoam.render.encode.png import MASK, dithered


def drawn(height: int, width: int) -> np.ndarray:
    """Noise over a ramp, with both ends of the range, so that differences wrap."""
    rng = np.random.default_rng(height * 10007 + width)
    pixels = rng.integers(0, 256, (height, width, 4), dtype=np.uint8)
    pixels[height // 2 :, :, :3] = (np.arange(width, dtype=np.uint32)[:, None] * (3, 5, 7)).astype(np.uint8)
    pixels[0, ::2], pixels[0, 1::2] = 0, 255
    return pixels


SIZES = [(1, 1), (1, 7), (9, 1), (37, 53)]


@pytest.mark.parametrize(
    ("format", "size"),
    [*(("webp", size) for size in SIZES), *(("png", size) for size in (*SIZES, (720, 1280), (1081, 1920)))],
)
def test_pixels_come_back(format: str, size: tuple[int, int]) -> None:
    """Only PNG is made of stripes, of which a large picture has more."""
    pixels = drawn(*size)
    read = Image.open(io.BytesIO(encode(pixels, format)))
    assert (read.mode, read.size) == ("RGB", size[::-1])
    np.testing.assert_array_equal(np.asarray(read), pixels[..., :3])
    # A frame that lies bottom-up in memory is the same frame.
    assert encode(pixels[::-1][::-1], format) == encode(pixels.copy(), format)
    upside_down = Image.open(io.BytesIO(encode(pixels[::-1], format)))
    np.testing.assert_array_equal(np.asarray(upside_down), pixels[::-1, :, :3])


def test_a_png_holds_the_picture_tagged_as_srgb_beside_its_recipe_and_nothing_else() -> None:
    content = encode(drawn(5, 6), "png")
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    kinds, at = [], 8
    while at < len(content):
        (length,) = struct.unpack(">I", content[at : at + 4])
        kinds.append(content[at + 4 : at + 8])
        at += 12 + length
    assert kinds == [b"IHDR", b"sRGB", b"IDAT", b"IEND"]
    assert Image.open(io.BytesIO(content)).info == {"srgb": 0}
    pixels, recipe = drawn(5, 6), '{"name":"Mörk – λ"}'
    content = encode(pixels, "png", recipe)
    read = Image.open(io.BytesIO(content))
    assert read.text == {"seafoam": recipe}
    np.testing.assert_array_equal(np.asarray(read), pixels[..., :3])
    bare = encode(pixels, "png")
    # Signature, IHDR and sRGB, the chunk, the rest.
    assert (content[:46], content[-(len(bare) - 46) :]) == (bare[:46], bare[46:])


@pytest.mark.parametrize("format", ["png", "webp", "exr"])
@pytest.mark.parametrize("recipe", ['{"name":"Mörk – λ"}', "{}", '{"a":"<&>\\"\\n"}', "x" * 100_000])
def test_a_recipe_is_read_from_every_picture(format: str, recipe: str) -> None:
    pixels = drawn(5, 6) if format != "exr" else drawn(5, 6).astype(np.float32)
    content = encode(pixels, format, recipe)
    assert read_recipe(content) == recipe
    assert encode(pixels, format, recipe) == content
    for other in (format, "npy" if format == "exr" else format):
        with pytest.raises(NoRecipeError, match="no PNG, WebP or OpenEXR picture with a recipe"):
            read_recipe(encode(pixels, other))
    # A file that was cut off is no picture, or has its recipe before the cut: it never raises anything else.
    for end in range(0, min(len(content), 2000), 37):
        read = None
        with suppress(NoRecipeError):
            read = read_recipe(content[:end])
        assert read in (None, recipe)


@pytest.mark.parametrize(("precision", "type"), [("float", np.float32), ("half", np.float16)])
def test_open_exr_holds_linear_light_and_coverage(precision: str, type: type) -> None:
    pixels = np.random.default_rng(1).normal(0.5, 2.0, (37, 53, 4)).astype(np.float32)
    pixels[0, 0] = (1e6, -1e6, 0.0, 1.0)
    content = encode(pixels, "exr", precision=precision)
    file = OpenEXR.File(io.BytesIO(content))
    channels = file.channels()
    assert set(channels) == {"RGB", "coverage"}
    limit = float(np.finfo(type).max)
    want = np.clip(pixels, -limit, limit).astype(type)
    np.testing.assert_array_equal(channels["RGB"].pixels, want[..., :3])
    np.testing.assert_array_equal(channels["coverage"].pixels, want[..., 3])
    assert channels["coverage"].pixels.dtype == type
    assert file.header()["chromaticities"][:2] == pytest.approx((0.64, 0.33))
    assert file.header()["colorInteropID"] == "lin_rec709_scene"
    assert encode(pixels, "exr", precision=precision) == content


@pytest.mark.parametrize("precision", ["half", "float"])
def test_open_exr_holds_normal_and_distance(precision: str) -> None:
    """Distances past a half float's range, and infinite where the renderer gives 0."""
    pixels = np.random.default_rng(1).normal(0.5, 2.0, (9, 14, 8)).astype(np.float32)
    pixels[..., 7] = np.geomspace(0.1, 1e5, 9 * 14).reshape(9, 14)
    pixels[0, :, 4:] = 0.0
    channels = OpenEXR.File(io.BytesIO(encode(pixels, "exr", precision=precision))).channels()
    assert set(channels) == {"RGB", "coverage", "N.X", "N.Y", "N.Z", "distance"}
    for axis, name in enumerate(("N.X", "N.Y", "N.Z")):
        np.testing.assert_allclose(channels[name].pixels, pixels[..., 4 + axis], rtol=1e-3, atol=1e-6)
    distance = channels["distance"].pixels
    assert distance.dtype == np.float32
    assert np.isinf(distance[0]).all()
    np.testing.assert_array_equal(distance[1:], pixels[1:, :, 7])


def test_a_dithered_picture_has_the_mean_of_its_values_and_black_stays_black() -> None:
    side = len(load_mask(MASK).ranks)
    rng = np.random.default_rng(2)
    for value in (1, 127, 128, 129, 257, 300, 32767, 40000, *rng.integers(0, 65536, 6), 65534):
        levels = dithered(np.full((side, side, 4), value, np.uint16)).astype(float)
        exact = value * 255 / 65535
        # In a mean at most a hundredth of a level, in a pixel less than one.
        np.testing.assert_allclose(levels.mean(axis=(0, 1)), exact, atol=0.01)
        assert np.abs(levels - exact).max() < 1.01
    assert (dithered(np.zeros((40, 700, 4), np.uint16)) == 0).all()
    assert (dithered(np.full((40, 700, 4), 65535, np.uint16)) == 255).all()


def test_a_dithered_ramp_has_no_bands() -> None:
    """Over four levels in 1280 pixels, means of 16 × 16 pixels follow the ramp; rounded, they stand in steps."""
    ramp = np.linspace(20.0, 24.0, 1280)[None, :, None] * 257
    values = np.broadcast_to(ramp, (256, 1280, 4)).astype(np.uint16)
    blocks = (16, 16, 80, 16)

    def error(levels: np.ndarray) -> float:
        off = levels[..., 0] - values[..., 0] * (255 / 65535)
        return float(np.abs(off.reshape(blocks).mean(axis=(1, 3))).max())

    assert error(dithered(values).astype(float)) < 0.1
    assert error(np.round(values * (255 / 65535))) > 0.4


@pytest.mark.parametrize(("format", "size"), [("webp", (50, 70)), ("png", (50, 70)), ("png", (719, 1281))])
def test_16_bits_are_dithered(format: str, size: tuple[int, int]) -> None:
    """The larger picture is encoded in stripes, whose places in the mask go on from each other."""
    pixels = np.random.default_rng(3).integers(0, 65536, (*size, 4)).astype(np.uint16)
    read = np.asarray(Image.open(io.BytesIO(encode(pixels, format))))
    np.testing.assert_array_equal(read, dithered(pixels)[..., :3])
