"""Measures of pictures that were made so that the answer is known."""

import math
from functools import cache

import numpy as np
import pytest
from bench.drawn.motion import excess, flicker
from docs.whitecaps_measure import Rule, awe_coverage
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from seafoam.accuracy import metrics
from support.report import Report


def picture(value=0.5, coverage=0.0, size=(40, 60)):
    made = np.full((*size, 4), value, np.float32)
    made[..., 3] = coverage
    return made


def test_errors_are_in_levels_of_what_is_displayed():
    same = picture()
    found = metrics.errors([same, same], same, "filmic")
    assert (found.rmse, found.max, found.flip, found.coverage, found.flipped) == (0.0, 0.0, 0.0, 0.0, 0.0)
    assert found.popping is None
    other = picture()
    other[:20, :, :3] += 0.1
    assert metrics.rmse(other, picture()) == pytest.approx(25.5 * np.sqrt(0.5), rel=1e-5)
    assert metrics.greatest(other, picture()) == pytest.approx(25.5, rel=1e-5)
    assert metrics.rmse(picture(7.0), picture(1.0)) == 0.0
    assert metrics.rmse(picture(-0.2), picture(0.0)) == 0.0
    assert metrics.rmse(picture(coverage=1.0), picture()) == 0.0
    assert metrics.coverage(picture(coverage=0.25), picture(coverage=0.5)) == pytest.approx(0.25)
    other[:10, :, 3] = 0.9
    other[10:, :, 3] = 0.5
    assert metrics.flipped(other, picture()) == pytest.approx(0.25)


@pytest.mark.parametrize("curve", [None, "filmic", "photographic"])
def test_flip_sees_what_is_displayed(curve):
    noise = np.random.default_rng(1).random((40, 60, 4)).astype(np.float32)
    small, middling, large = (
        metrics.flip(picture(a), picture(b), curve) for a, b in ((0.21, 0.2), (0.5, 0.2), (0.0, 9.0))
    )
    assert 0.0 < small < middling < large <= 1.0
    assert metrics.flip(noise, picture(), curve) > 0.1


def test_popping_is_the_worst_loss_of_living_foam():
    frames = [picture() for _ in range(4)]
    frames[0][:10, :10, 3] = 1.0  # 100 pixels live
    frames[1][:10, :10, 3] = 1.0
    frames[1][5:10, :10, 3] = 0.4  # 50 are lost
    frames[2][:10, :10, 3] = 1.0  # and come back, which is no loss
    frames[3][:9, :10, 3] = 1.0
    assert metrics.popping(frames) == pytest.approx(0.5)
    assert metrics.popping(frames[2:]) == pytest.approx(0.1)
    assert metrics.popping(frames[1:2]) is None
    assert metrics.popping([picture(), picture(coverage=1.0)]) is None


Frames = list[NDArray[np.float64]]


def pan(step: float, count: int = 12) -> Frames:
    """A wave of 32 pixels that moves by so many a frame."""
    x = np.arange(64.0)
    return [np.tile(0.5 + 0.5 * np.sin(2.0 * math.pi * (x - step * i) / 32.0), (16, 1)) for i in range(count)]


def specks(share: float, count: int = 12) -> Frames:
    """Still grey, in which every frame another share of the pixels is white."""
    random = np.random.default_rng(2)
    return [np.where(random.uniform(size=(64, 64)) < share, 1.0, 0.5) for _ in range(count)]


def test_flicker_is_the_high_pass_it_says() -> None:
    """A pan at f cycles a frame: 4 sin²(πf) times the wave's root mean square."""
    for step in (0.5, 2.0, 8.0):
        wanted = 255.0 * 4.0 * math.sin(math.pi * step / 32.0) ** 2 * 0.5 / math.sqrt(2.0)
        assert flicker(pan(step)) == pytest.approx(wanted, rel=1e-9)
    frames = [np.zeros((4, 4)) for _ in range(5)]
    frames[2] = np.full((4, 4), 0.1)
    assert flicker(frames) == pytest.approx(25.5 * math.sqrt(6.0 / 3.0))


def test_excess_is_over_the_truth() -> None:
    assert excess(pan(2.0), pan(2.0)) == 1.0
    noisy = [frame + 0.2 * pops[:16] for frame, pops in zip(pan(2.0), specks(0.2), strict=True)]
    assert excess(noisy, pan(2.0)) > 2.0
    assert np.isfinite(excess(specks(0.1), [np.zeros((64, 64))] * 12))


SIZE = (480, 640)


@cache
def photograph(coverage: float, seed: int, water: float = 0.35, foam: float = 0.85) -> NDArray[np.uint8]:
    """Grey water with noise of all sizes, and blobs of uneven foam over so much of it, edges a pixel wide."""
    random = np.random.default_rng(seed)
    smooth = gaussian_filter(random.normal(size=SIZE), 12.0)
    level = np.quantile(smooth, 1.0 - coverage) if coverage > 0.0 else np.inf
    share = gaussian_filter((smooth > level).astype(np.float64), 0.7)
    sea = water + 0.03 * random.normal(size=SIZE) + 0.02 * np.linspace(1.0, -1.0, SIZE[0])[:, None]
    white = foam + 0.06 * random.normal(size=SIZE)
    return np.round(255.0 * np.clip(sea + share * (white - sea), 0.0, 1.0)).astype(np.uint8)


@pytest.mark.parametrize("coverage", [0.005, 0.08])
@pytest.mark.parametrize("rule", ["program", "least"])
def test_awe_finds_a_known_coverage(report: Report, coverage: float, rule: Rule) -> None:
    found = awe_coverage([photograph(coverage, seed) for seed in range(4)], rule)
    off = np.abs(found / coverage - 1.0).max()
    report.within("AWE on synthetic photographs", rule=rule, coverage=coverage, off=(off, 0.2))
