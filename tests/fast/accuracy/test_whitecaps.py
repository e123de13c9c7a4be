"""Whitecaps in photographs: the threshold that AWE finds, and the sizes of patches, on pictures of known coverage."""

import math

import numpy as np
import pytest
from docs.whitecaps_measure import Rule, awe_coverage, grey, levelled, patches
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from support.report import Report

SIZE = (480, 640)


def photograph(coverage: float, seed: int, water: float = 0.35, foam: float = 0.85) -> NDArray[np.uint8]:
    """Grey water with noise of all sizes, and blobs of uneven foam over so much of it, edges a pixel wide."""
    random = np.random.default_rng(seed)
    smooth = gaussian_filter(random.normal(size=SIZE), 12.0)
    level = np.quantile(smooth, 1.0 - coverage) if coverage > 0.0 else np.inf
    share = gaussian_filter((smooth > level).astype(np.float64), 0.7)
    sea = water + 0.03 * random.normal(size=SIZE) + 0.02 * np.linspace(1.0, -1.0, SIZE[0])[:, None]
    white = foam + 0.06 * random.normal(size=SIZE)
    return np.round(255.0 * np.clip(sea + share * (white - sea), 0.0, 1.0)).astype(np.uint8)


@pytest.mark.parametrize("coverage", [0.005, 0.02, 0.08, 0.25])
@pytest.mark.parametrize("rule", ["program", "least"])
def test_awe_finds_a_known_coverage(report: Report, coverage: float, rule: Rule) -> None:
    found = awe_coverage([photograph(coverage, seed) for seed in range(4)], rule)
    report.add(
        "AWE on synthetic photographs",
        rule=rule,
        coverage=f"{100 * coverage:.2f} %",
        found=" ".join(f"{100 * share:.2f}" for share in found),
    )
    assert np.abs(found / coverage - 1.0).max() <= 0.2


@pytest.mark.parametrize("coverage", [0.02, 0.08])
def test_awe_finds_a_known_coverage_on_a_slope(coverage: float) -> None:
    """Under light that falls to 0.4 from the top to the bottom AWE misses; levelled it finds what is there."""
    slope = np.linspace(1.15, 0.45, SIZE[0])[:, None]
    found = []
    for seed in range(4):
        lit = np.clip(photograph(coverage, seed) / 255.0 * slope, 0.0, 1.0)
        picture = np.repeat(np.round(255.0 * lit).astype(np.uint8)[..., None], 3, axis=2)
        found.append([float(awe_coverage([image])[0]) / coverage for image in (grey(picture), levelled(picture))])
    plain, levels = np.abs(np.array(found) - 1.0).max(axis=0)
    assert levels <= 0.2 < plain


def test_patches_of_known_shape() -> None:
    """An ellipse turned by half a radian: area, length, axes; what touches the edge or is small is left out."""
    y, x = np.mgrid[:400, :400]
    u = (x - 200) * math.cos(0.5) + (y - 200) * math.sin(0.5)
    v = -(x - 200) * math.sin(0.5) + (y - 200) * math.cos(0.5)
    foam = (u / 100.0) ** 2 + (v / 40.0) ** 2 <= 1.0
    foam[:10, :10] = True
    foam[390, 390] = True
    found = patches(foam, 0.25)
    assert found.areas == pytest.approx([math.pi * 25.0 * 10.0], rel=0.01)
    assert found.lengths == pytest.approx([50.0], rel=0.02)
    assert found.axis_ratios == pytest.approx([0.4], rel=0.03)


def test_discs_are_smooth_and_their_sizes_are_recovered_unless_there_are_none() -> None:
    """Discs with areas of a density A^−2: outlines of dimension 1, and the exponent."""
    foam = np.zeros((3000, 3000), bool)
    y, x = np.mgrid[-60:61, -60:61]
    random = np.random.default_rng(1)
    for i in range(24):
        for j in range(24):
            area = min(100.0 / (1.0 - random.uniform()), 10_000.0)
            foam[62 + 122 * i - 60 : 62 + 122 * i + 61, 62 + 122 * j - 60 : 62 + 122 * j + 61] |= (
                np.pi * (x**2 + y**2) <= area
            )
    found = patches(foam, 1.0)
    assert found.dimension() == pytest.approx(1.0, abs=0.02)
    assert found.exponent() == pytest.approx(2.0, abs=0.15)
    with pytest.raises(ValueError, match="patches need"):
        patches(np.zeros((2, 2), bool), 0.0)
    none = patches(np.zeros((9, 9), bool), 1.0)
    with pytest.raises(ValueError, match="no dimension"):
        none.dimension()
    with pytest.raises(ValueError, match="too few"):
        none.exponent()
