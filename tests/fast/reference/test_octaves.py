"""Octaves of the mask: the cover stays the saturation at every zoom, and on approach only grey resolves."""

import numpy as np
import pytest

from seafoam.masks.catalogue import load_mask
from seafoam.masks.prefilter import OCTAVE_RAMP, ramp_threshold
from seafoam.reference import Assets
from seafoam.reference.foam import coverage as looked
from seafoam.reference.foam import looks
from seafoam.scene.foam import Foam

SIDE = 100
"""Places along each side of the tile, one in each square."""
NEEDLE = np.array([[1.0, 0.0], [0.3, 0.8]])


@pytest.fixture(scope="module")
def lace() -> Assets:
    return Assets.of(load_mask("lace"), np.ones((1, 1)))


def places(seed: int) -> np.ndarray:
    """(2, SIDE^2) places in [0, 1), jittered."""
    row, column = np.mgrid[:SIDE, :SIDE]
    jitter = np.random.default_rng(seed).random((2, SIDE, SIDE))
    return ((np.stack((column, row)) + jitter) / SIDE).reshape(2, -1)


def amount(
    assets: Assets, s: float, texels: float, octaves: int, at: np.ndarray | None = None, fade: float = 0.0
) -> np.ndarray:
    """Cover at places under footprints of so many texels; (places,)."""
    u, v = places(3) if at is None else at
    points = looked.MaskPoints(u, v, *(np.broadcast_to(side * texels / 512.0, (u.size, 2)) for side in NEEDLE))
    return looked.coverage(Foam(octaves=octaves, fade=fade), assets, np.full(u.size, s), points, filtering=True)


@pytest.mark.parametrize("texels", 2.0 ** np.arange(-6.0, 7.0, 2.0))
def test_the_cover_is_the_saturation_at_every_scale(lace: Assets, texels: float) -> None:
    for s in (0.02, 0.1, 0.3, 0.5, 0.75, 0.95):
        for octaves in (2, 4):
            # Within 0.002 over ten times as many places; so few scatter by 0.0015.
            assert amount(lace, s, texels, octaves).mean() == pytest.approx(s, abs=0.006)


@pytest.mark.parametrize("fade", [0.2, 0.6])
def test_octaves_cover_as_much_as_the_fade(lace: Assets, fade: float) -> None:
    for s in (0.1, 0.5, 1.0):
        share = s * s / (2.0 * fade) if s < fade else s - 0.5 * fade
        assert amount(lace, s, 0.1, 3, fade=fade).mean() == pytest.approx(share, abs=0.006)


def test_the_ramp_covers_the_saturation_of_even_thresholds() -> None:
    u = (np.arange(100_000) + 0.5) / 100_000
    for s in (0.0, 1e-3, 0.2, 0.3, 0.5, 0.7, 0.8, 0.999, 1.0):
        covered = np.clip((float(ramp_threshold(s)) - u) / OCTAVE_RAMP, 0.0, 1.0).mean()
        assert covered == pytest.approx(s, abs=1e-5)
    assert OCTAVE_RAMP == looks.OCTAVE_RAMP


def test_six_octaves_only_resolve_grey() -> None:
    """On the texels themselves, in whole numbers: each octave is a permutation of the tile, whole and clear stay."""
    ranks = load_mask("lace").ranks.astype(np.int64)
    size, count = ranks.shape[0], ranks.size
    y, x = np.mgrid[:size, :size]
    # Cover in whole parts of a ramp, which is so many ranks wide.
    ramp = round(OCTAVE_RAMP * count)
    left = np.full(ranks.shape, round(0.4 * ramp), np.int64)
    for _ in range(6):
        threshold = np.rint(ramp_threshold(left / ramp) * count).astype(np.int64)
        whole, clear = left == ramp, left == 0
        own = np.clip(threshold - ranks[y, x], 0, ramp)
        assert (own[whole] == ramp).all()
        assert (own[clear] == 0).all()
        # Rounding of thresholds to ranks, and how far octaves are from independent.
        assert own.mean() / ramp == pytest.approx(0.4, abs=0.002)
        left = own
        x, y = (4 * x - 3 * y) % size, (3 * x + 4 * y) % size
        assert np.array_equal(np.sort((y * size + x).ravel()), np.arange(count))
    grey = (left > 0) & (left < ramp)
    assert grey.mean() < 0.02
