"""Files of masks, read back by other means than they were written with."""

import io
import struct

import numpy as np
import pytest
from PIL import Image

from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.masks.formats import decode_ranks, encode_ranks, to_dds, to_npy, to_png8, to_png16, to_u16

SMALL = make_mask("vac", sigma=1.5, size=32, seed=1)
EVERY_SIZE = [SMALL, make_mask("clump", sigma=1.5, size=256, seed=1), load_mask("vac-24").ranks]


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


@pytest.mark.parametrize("ranks", EVERY_SIZE, ids=lambda ranks: str(ranks.shape[0]))
def test_every_format_holds_the_ranks(ranks):
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
