"""Masks as they are written, and as shaders read them."""

import io
import struct

import numpy as np
import pytest
from masks.bake import encode_ranks
from PIL import Image

from seafoam.masks import prefilter
from seafoam.masks.catalogue import load_catalogue, load_mask
from seafoam.masks.formats import decode_ranks, to_dds, to_npy, to_png8, to_png16, to_u16

SMALL, LARGER = (
    np.random.default_rng(1).permutation(size**2).astype(np.uint32).reshape(size, size) for size in (32, 256)
)


def expected(ranks, bits):
    return np.floor(ranks.astype(object) * 2**bits / ranks.size).astype(np.int64)


def png_chunks(content):
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    place, kinds = 8, []
    while place < len(content):
        length, kind = struct.unpack_from(">I4s", content, place)
        kinds.append(kind)
        place += 12 + length
    return kinds


def linear(content):
    """Whether a PNG says before its pixels that it has gamma 1, and nothing else of colour."""
    at = content.index(b"gAMA")
    said = int.from_bytes(content[at + 4 : at + 8], "big") == 100_000 and at < content.index(b"IDAT")
    return said and set(png_chunks(content)) == {b"IHDR", b"gAMA", b"IDAT", b"IEND"}


@pytest.mark.parametrize("size", [32, 256, 512])
def test_every_format_holds_the_ranks(size):
    ranks = {32: SMALL, 256: LARGER}.get(size)
    ranks = load_mask("vac-24").ranks if ranks is None else ranks
    values = np.frombuffer(to_u16(ranks), "<u2").reshape(ranks.shape)
    assert np.array_equal(values, expected(ranks, 16))
    assert int(values.max()) >= 65535 - 65536 // ranks.size
    # The stored threshold is the mask's within a step of what is coarser, the 16 bits or the ranks.
    error = np.abs((values + 0.5) / 65536 - (ranks + 0.5) / ranks.size).max()
    assert error <= 0.5 * max(1 / 65536, 1 / ranks.size)
    content = to_png16(ranks)
    image = Image.open(io.BytesIO(content))
    assert image.mode == "I;16"
    assert np.array_equal(np.asarray(image), expected(ranks, 16))
    assert content[24:26] == bytes([16, 0])  # bit depth, greyscale
    assert linear(content)
    values = np.load(io.BytesIO(to_npy(ranks)), allow_pickle=False)
    assert values.dtype == np.dtype("<f4")
    assert np.array_equal(values.astype(np.float64) * ranks.size - 0.5, ranks)
    content = encode_ranks(ranks)
    assert len(content) * 8 == 18 * ranks.size
    assert np.array_equal(decode_ranks(content, ranks.shape[0]), ranks)


def test_png8_holds_an_equal_number_of_every_value():
    content = to_png8(load_mask("bubble").ranks)
    image = Image.open(io.BytesIO(content))
    assert image.mode == "L"
    assert (np.bincount(np.asarray(image).ravel(), minlength=256) == 1024).all()
    assert linear(content)


def test_dds_header_and_pixels():
    ranks = load_mask("mix").ranks
    content = to_dds(ranks)
    magic, size, flags, height, width, pitch, depth, levels = struct.unpack_from("<4s7I", content)
    assert (magic, size, height, width, pitch, depth, levels) == (b"DDS ", 124, 512, 512, 1024, 1, 1)
    assert flags & 0x1007 == 0x1007
    pixel_size, pixel_flags, fourcc = struct.unpack_from("<2I4s", content, 76)
    assert (pixel_size, pixel_flags, fourcc) == (32, 4, b"DX10")
    assert struct.unpack_from("<I", content, 108) == (0x1000,)
    assert struct.unpack_from("<5I", content, 128) == (56, 3, 0, 1, 0)
    assert content[148:] == to_u16(ranks)


def test_rank_files_of_another_size_are_refused():
    content = encode_ranks(SMALL)
    with pytest.raises(ValueError, match="64 x 64"):
        decode_ranks(content, 64)
    with pytest.raises(ValueError, match="18 bits"):
        encode_ranks(np.full((2, 2), 2**18, np.uint32))


NAMES = list(load_catalogue())
SATURATIONS = (0.01, 0.03, 0.1, 0.25, 0.55, 0.9, 0.97)


@pytest.mark.parametrize("name", NAMES)
def test_magnified_cover_is_the_saturation_by_a_table_that_rises(name):
    """Judged at other subtexel positions than the table was made from."""
    mask = load_mask(name)
    samples = prefilter.bspline_samples(mask.ranks, 3)
    for s in (*SATURATIONS, 0.002, 0.998):
        assert float((samples < prefilter.quantile_lookup(mask.quantile, s)).mean()) == pytest.approx(s, abs=0.001)
    assert not (samples < prefilter.quantile_lookup(mask.quantile, 0.0)).any()
    assert (samples <= prefilter.quantile_lookup(mask.quantile, 1.0)).all()
    table = np.array(load_mask(name).quantile)
    assert table.size == prefilter.QUANTILE_ENTRIES
    assert (np.diff(table) >= 0.0).all()
    assert table[0] >= 0.0
    assert table[-1] <= 1.0


@pytest.mark.parametrize("name", ["vac-1.5", "mix"])
def test_spans_say_where_the_thresholds_of_a_texel_lie_in_whole_numbers_as_endless_digits_would(name):
    mask = load_mask(name)
    assert [level.shape for level in mask.spans] == [(512 >> level, 512 >> level, 2) for level in range(10)]
    for level in mask.spans:
        assert level.dtype == np.float32
        low, width = np.moveaxis(level.astype(np.float64), -1, 0)
        assert width.min() >= 1.0 / 256.0
        assert low.min() >= 0.0
        assert (low + width).max() <= 1.0
        assert np.array_equal(256.0 * level, np.rint(256.0 * level))
        assert (low + 0.5 * width).mean() == pytest.approx(0.5, abs=1e-3)
    shares = np.linspace(0.0, 1.0, prefilter.QUANTILE_ENTRIES)
    places = np.interp(prefilter.bspline_samples(mask.ranks, 4), mask.quantile, shares)
    even = np.roll(prefilter.quantile_saturation(places), 2, axis=(0, 1))
    for level, chain in enumerate(mask.spans[:5]):
        side = 512 >> level
        blocks = even.reshape(side, 2048 // side, side, 2048 // side)
        mean, half = blocks.mean(axis=(1, 3)), np.sqrt(3.0) * blocks.std(axis=(1, 3))
        half = np.minimum(half, np.minimum(mean, 1.0 - mean))
        width = np.clip(np.rint(512.0 * half), 1.0, 256.0)
        low = np.clip(np.rint(256.0 * mean - 0.5 * width), 0.0, 256.0 - width)
        off = np.abs(256.0 * chain - np.stack((low, width), axis=-1))
        assert off.max() <= 1.0
        assert (off > 0.0).mean() < 0.006


def test_a_fetch_of_the_atlas_gets_four_texels_of_a_level():
    mask = load_mask("vac-6")
    image = prefilter.atlas(mask.ranks, mask.spans)
    assert image.shape == (512, 1280, 2)
    assert image.dtype == np.uint32
    for level, x, y in ((0, 0, 0), (0, 511, 300), (1, 0, 255), (2, 127, 5), (9, 0, 0)):
        side = 512 >> level
        column, row = (1024 + x, 512 - 2 * side + y) if level else (512 + x, y)
        for channel in range(4):
            at = (y, (x - 1 + channel) % side)
            word = int(image[row, column, channel // 2]) >> 16 * (channel % 2)
            assert ((word & 255) / 256, ((word >> 8 & 255) + 1) / 256) == tuple(mask.spans[level][at])
    for x, y in ((0, 0), (511, 300)):
        words = [int(image[y, x, channel // 2]) >> 16 * (channel % 2) & 65535 for channel in range(4)]
        assert words == [int(mask.ranks[y, (x - 1 + channel) % 512]) >> 2 for channel in range(4)]


def cover(level, thresholds):
    """Mean cover of a level's texels, each thresholded at the same values; as many as there are of these."""
    low, width = np.moveaxis(level.astype(np.float64).reshape(-1, 2), -1, 0)
    return np.array([np.clip((threshold - low) / width, 0.0, 1.0).mean() for threshold in thresholds])


@pytest.mark.parametrize("name", ["vac-1.5", "clump", "mix"])
def test_minified_cover_is_the_saturation(name):
    mask = load_mask(name)
    assert mask.filtering.quantiles.shape == (11, prefilter.QUANTILE_ENTRIES)
    assert np.array_equal(mask.filtering.quantiles[0], mask.quantile)
    for level, table in zip(mask.spans, mask.filtering.quantiles[1:], strict=True):
        assert cover(level, prefilter.quantile_lookup(table, SATURATIONS)) == pytest.approx(SATURATIONS, abs=1e-3)
