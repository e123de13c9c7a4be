"""Flicker: a smooth pan has little, what pops much."""

import math

import numpy as np
import pytest
from bench.drawn.motion import excess, flicker
from numpy.typing import NDArray

Frames = list[NDArray[np.float64]]


def pan(step: float, count: int = 12) -> Frames:
    """A wave of 32 pixels that moves by so many a frame."""
    x = np.arange(64.0)
    return [np.tile(0.5 + 0.5 * np.sin(2.0 * math.pi * (x - step * i) / 32.0), (16, 1)) for i in range(count)]


def popping(share: float, count: int = 12) -> Frames:
    """Still grey, in which every frame another share of the pixels is white."""
    random = np.random.default_rng(2)
    return [np.where(random.uniform(size=(64, 64)) < share, 1.0, 0.5) for _ in range(count)]


def test_a_smooth_pan_scores_low_popping_high_and_what_stays_or_fades_evenly_nothing() -> None:
    smooth, popped = flicker(pan(0.1)), flicker(popping(0.05))
    assert smooth < 0.1
    assert popped > 100.0 * smooth
    still = np.random.default_rng(1).uniform(size=(8, 9))
    assert flicker([still] * 4) == 0.0
    assert flicker([0.1 * i * still for i in range(6)]) < 1e-9


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
    noisy = [frame + 0.2 * pops[:16] for frame, pops in zip(pan(2.0), popping(0.2), strict=True)]
    assert excess(noisy, pan(2.0)) > 2.0
    assert np.isfinite(excess(popping(0.1), [np.zeros((64, 64))] * 12))
