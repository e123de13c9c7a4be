"""Errors of pictures that were made so that the answer is known."""

import numpy as np
import pytest

from seafoam.accuracy import metrics


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
