"""Filtering tables: what a footprint of any size covers is the saturation."""

import numpy as np
import pytest

from seafoam.masks import prefilter
from seafoam.masks.bake import SHIPPED
from seafoam.masks.catalogue import load_mask

NAMES = [mask.name for mask in SHIPPED]
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


@pytest.mark.parametrize("name", ["vac-24", "mix"])
def test_spans_say_where_the_thresholds_of_a_texel_lie(name):
    mask = load_mask(name)
    chain = mask.spans
    assert [level.shape for level in chain] == [(512 >> level, 512 >> level, 2) for level in range(10)]
    for level in chain:
        assert level.dtype == np.float32
        low, width = np.moveaxis(level.astype(np.float64), -1, 0)
        assert width.min() >= 1.0 / 256.0
        assert low.min() >= 0.0
        assert (low + width).max() <= 1.0
        assert np.array_equal(256.0 * level, np.rint(256.0 * level))
        assert (low + 0.5 * width).mean() == pytest.approx(0.5, abs=1e-3)
    assert np.array_equal(prefilter.spans(mask.ranks, mask.quantile)[2], chain[2])


@pytest.mark.parametrize("name", ["vac-1.5", "vac-24", "blur-24", "mix"])
def test_whole_numbers_say_what_endless_digits_do(name):
    mask = load_mask(name)
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


@pytest.mark.parametrize("name", ["vac-1.5", "bubble"])
def test_whole_numbers_fit_32_bits(name):
    """What GLSL holds on the way: the least room is 1/16."""
    mask = load_mask(name)
    doubled = 2 * 65535 + 1
    rows = (doubled * prefilter.SPLINE_SCALE + 256) >> 9
    assert rows * prefilter.SPLINE_SCALE + 576 < 1 << 32
    parts = prefilter._spline_quarters(mask.ranks)
    assert max(int(part.max()) for part in parts) < 1 << prefilter.ENTRY_BITS
    even = np.stack([prefilter._even(part, mask.quantile) for part in parts])
    assert even.min() >= 0
    assert even.max() <= 16383
    # At the most, where half of the thresholds are 0 and half 1: 16 (2^13)^2, of which 3 and 4 times are taken.
    assert 4 * 16 * 8192**2 <= 1 << 32


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


def test_footprint_deviations_grow_from_none_to_the_uniform_one():
    for name in NAMES:
        deviations = prefilter.footprint_deviations(load_mask(name).ranks)
        assert len(deviations) == 10
        assert deviations[0] == pytest.approx(0.0, abs=1e-7)
        assert (np.diff(deviations) >= 0.0).all()
        assert deviations[-1] == pytest.approx(12**-0.5, abs=1e-6)
        assert load_mask(name).tables.sigma_l == pytest.approx(deviations, abs=1e-6)
    blocks = load_mask("clump").thresholds.reshape(128, 4, 128, 4)
    inside = np.sqrt(((blocks**2).mean(axis=(1, 3)) - blocks.mean(axis=(1, 3)) ** 2).mean())
    assert load_mask("clump").tables.sigma_l[2] == pytest.approx(inside, abs=1e-5)


def cover(level, thresholds):
    """Mean cover of a level's texels, each thresholded at the same values; as many as there are of these."""
    low, width = np.moveaxis(level.astype(np.float64).reshape(-1, 2), -1, 0)
    return np.array([np.clip((threshold - low) / width, 0.0, 1.0).mean() for threshold in thresholds])


@pytest.mark.parametrize("name", ["vac-1.5", "vac-24", "clump", "mix"])
def test_minified_cover_is_the_saturation(name):
    mask = load_mask(name)
    assert mask.filtering.quantiles.shape == (11, prefilter.QUANTILE_ENTRIES)
    assert np.array_equal(mask.filtering.quantiles[0], mask.quantile)
    assert np.array_equal(prefilter.span_quantiles(mask.spans), mask.filtering.quantiles[1:])
    for level, table in zip(mask.spans, mask.filtering.quantiles[1:], strict=True):
        assert cover(level, prefilter.quantile_lookup(table, SATURATIONS)) == pytest.approx(SATURATIONS, abs=1e-3)
