"""Filtering tables: what a footprint of any size covers is the saturation."""

import numpy as np
import pytest

from seafoam.masks import bspline_weights, footprint_deviations, load_mask, moments, quantile_lookup
from seafoam.masks.prefilter import (
    QUANTILE_ENTRIES,
    bspline_samples,
    quantile_position,
    quantile_saturation,
    thresholds,
)
from seafoam.masks.shipped import SHIPPED

NAMES = [mask.name for mask in SHIPPED]
SATURATIONS = (0.01, 0.03, 0.1, 0.25, 0.55, 0.9, 0.97)


@pytest.mark.parametrize("name", NAMES)
def test_magnified_cover_is_the_saturation(name):
    """Judged at other subtexel positions than the table was made from."""
    mask = load_mask(name)
    samples = bspline_samples(mask.ranks, 3)
    for s in (*SATURATIONS, 0.002, 0.998):
        assert float((samples < quantile_lookup(mask.quantile, s)).mean()) == pytest.approx(s, abs=0.001)
    assert not (samples < quantile_lookup(mask.quantile, 0.0)).any()
    assert (samples <= quantile_lookup(mask.quantile, 1.0)).all()


def test_without_the_table_magnified_cover_is_wrong():
    samples = bspline_samples(load_mask("vac-1.5").ranks, 3)
    assert float((samples < 0.1).mean()) < 0.01


@pytest.mark.parametrize("name", NAMES)
def test_quantile_tables_rise(name):
    table = np.array(load_mask(name).quantile)
    assert table.size == QUANTILE_ENTRIES
    assert (np.diff(table) >= 0.0).all()
    assert table[0] >= 0.0
    assert table[-1] <= 1.0


def test_quantile_abscissa_inverts():
    s = np.linspace(0.0, 1.0, 1001)
    t = quantile_position(s)
    assert np.allclose(quantile_saturation(t), s, atol=1e-12)
    assert (np.diff(t) > 0.0).all()
    assert quantile_position([-0.5, 0.0, 0.5, 1.0, 2.0]).tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]


def test_bspline_weights_sum_to_one_and_meet_between_texels():
    for f in np.linspace(0.0, 0.999, 17):
        assert sum(bspline_weights(float(f))) == pytest.approx(1.0)
    assert bspline_weights(0.0) == pytest.approx((1 / 6, 2 / 3, 1 / 6, 0.0))
    assert bspline_weights(1.0 - 1e-12) == pytest.approx((0.0, 1 / 6, 2 / 3, 1 / 6), abs=1e-9)


def test_bspline_samples_are_those_of_the_formula():
    ranks = load_mask("mix").ranks
    u = thresholds(ranks)
    samples = bspline_samples(ranks, 4)
    for y, x, j, i in ((0, 0, 0, 0), (511, 3, 3, 1), (100, 511, 2, 3)):
        wy, wx = bspline_weights((j + 0.5) / 4), bspline_weights((i + 0.5) / 4)
        value = sum(wy[a] * wx[b] * u[(y - 1 + a) % 512, (x - 1 + b) % 512] for a in range(4) for b in range(4))
        assert samples[4 * y + j, 4 * x + i] == pytest.approx(value, abs=1e-6)


@pytest.mark.parametrize("name", ["vac-24", "mix"])
def test_moments_are_box_means_at_every_level(name):
    mask = load_mask(name)
    u = mask.thresholds
    chain = mask.moments
    assert [level.shape for level in chain] == [(512 >> level, 512 >> level, 2) for level in range(10)]
    for level in chain:
        assert level.dtype == np.float32
        assert level[..., 0].mean(dtype=np.float64) == pytest.approx(0.5, abs=1e-6)
        assert level[..., 1].mean(dtype=np.float64) == pytest.approx((u * u).mean(), abs=1e-6)
        assert (level[..., 1] >= level[..., 0] ** 2 - 1e-6).all()
    assert chain[3][5, 7, 0] == pytest.approx(u[40:48, 56:64].mean(), abs=1e-6)
    assert chain[-1][0, 0, 0] == pytest.approx(u.mean(), abs=1e-7)
    assert np.array_equal(moments(mask.ranks)[2], chain[2])


def test_footprint_deviations_grow_from_none_to_the_uniform_one():
    for name in NAMES:
        deviations = footprint_deviations(load_mask(name).ranks)
        assert len(deviations) == 10
        assert deviations[0] == pytest.approx(0.0, abs=1e-7)
        assert (np.diff(deviations) >= 0.0).all()
        assert deviations[-1] == pytest.approx(12**-0.5, abs=1e-6)
        assert load_mask(name).sigma_l == pytest.approx(deviations, abs=1e-6)
    chain = load_mask("clump").moments[2].astype(np.float64)
    inside = np.sqrt((chain[..., 1] - chain[..., 0] ** 2).mean())
    assert load_mask("clump").sigma_l[2] == pytest.approx(inside, abs=1e-5)


def bilinear(level, y, x):
    """Level's value at texture coordinates y, x in 0..1, texel centres at (i + 0.5) / size."""
    size = level.shape[0]
    v, u = y * size - 0.5, x * size - 0.5
    i, j = np.floor(v).astype(int), np.floor(u).astype(int)
    fy, fx = (v - i)[:, None], (u - j)[:, None]
    upper = level[i % size, j % size] * (1 - fx) + level[i % size, (j + 1) % size] * fx
    lower = level[(i + 1) % size, j % size] * (1 - fx) + level[(i + 1) % size, (j + 1) % size] * fx
    return upper * (1 - fy) + lower * fy


def box_cover(chain, level, s, y, x):
    """Cover of footprints of 2^level texels by the uniform closure over mean -+ sqrt 3 deviations."""
    mean, second = np.moveaxis(bilinear(chain[level].astype(np.float64), y, x), -1, 0)
    half = np.maximum(np.sqrt(3.0 * np.maximum(second - mean**2, 0.0)), 5e-4)
    return np.clip((s - mean + half) / (2.0 * half), 0.0, 1.0)


@pytest.mark.parametrize(("level", "within"), [(1, 0.01), (2, 0.01), (3, 0.001), (4, 0.001), (5, 0.001), (6, 0.001)])
def test_minified_cover_is_the_saturation(level, within):
    """Of a footprint of few texels the uniform closure paints foam thinner than 0.03 too full (0.025 for 0.01)."""
    chain = load_mask("vac-1.5").moments
    rng = np.random.default_rng(9)
    y, x = rng.random((2, 200_000))
    for s in (0.03, 0.1, 0.25, 0.4, 0.55, 0.7, 0.9):
        assert box_cover(chain, level, s, y, x).mean() == pytest.approx(s, abs=within)


def test_thresholding_an_averaged_mask_loses_the_cover():
    """The naive way that the tables replace: far away a tenth of cover vanishes."""
    mean = load_mask("vac-1.5").moments[4][..., 0]
    assert float((mean < 0.1).mean()) == 0.0
