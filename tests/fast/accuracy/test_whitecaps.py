"""Whitecaps in photographs: the threshold that AWE finds, and the sizes of patches, on pictures of known coverage."""

import numpy as np
import pytest
from docs.whitecaps_measure import Rule, awe_coverage, grey, levelled
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
