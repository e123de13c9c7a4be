"""docs/nature.md: its figures are of the presets as they are, and what measures them finds what was put in."""

import json
import math

import numpy as np
import pytest
from docs import make_nature
from docs.nature import laws, measure

from seafoam.scene.presets import load_preset

FIGURES = json.loads(make_nature.FIGURES.read_text(encoding="utf-8"))


def test_the_figures_are_of_the_presets_and_in_the_page() -> None:
    stale = [name for name, of in FIGURES.items() if of["of"] != make_nature.measured_of(load_preset(name))]
    assert not stale, "run python docs/make_nature.py"
    assert tuple(FIGURES) == make_nature.PRESETS
    page = make_nature.PAGE.read_text(encoding="utf-8")
    assert page == make_nature.filled(page, FIGURES), "run python docs/make_nature.py"


def test_nine_of_ten_quantities_lie_within_what_was_published() -> None:
    """Every sea that is measured has more than half of its own there, too."""
    rows = laws.rows(FIGURES)
    inside = [row.preset for row in rows if row.side == "within"]
    assert len(inside) >= 0.9 * len(rows)
    for name in make_nature.PRESETS:
        assert inside.count(name) > 0.5 * sum(row.preset == name for row in rows)


def test_what_lies_out_of_a_band_says_why_and_bands_have_what_was_published() -> None:
    row = laws.Row("path", "storm", 0.9, 1.0, 2.0)
    assert row.side == "below"
    assert make_nature.reason(row) in make_nature.table([row])
    with pytest.raises(KeyError):
        make_nature.table([laws.Row("decay", "storm", 9.0, 1.0, 2.0)])
    # Coverage at 10 m/s from both articles; slopes of Cox and Munk at 13.9 m/s; full growth.
    least, greatest = laws.coverage_band(10.0)
    assert least * laws.SCATTER == pytest.approx(0.00795, rel=0.01)
    assert greatest / laws.SCATTER == pytest.approx(0.00987, rel=0.01)
    along, across = laws.slope_bands(13.9)
    assert np.mean(along) == pytest.approx(0.0439, rel=0.01)
    assert np.mean(across) == pytest.approx(0.0297, rel=0.01)
    (_, height), (_, period) = laws.growth(20.0, 1e6)
    assert (height, period) == pytest.approx((211.5 * 0.72 / 9.81, 239.8 * 0.72**0.5 / 9.81), rel=0.01)
    assert laws.growth(20.0, 1e5)[0][0] < laws.growth(20.0, 1e6)[0][0]


def test_patches_that_shrink_have_their_decay_time() -> None:
    """A disc that grows and decays with 6 steps; one that is cut by the picture's side, and a speck, do not count."""
    y, x = np.mgrid[:64, :64]
    film = np.zeros((40, 64, 64), bool)
    for i in range(1, 39):
        area = 500.0 * min(0.2 * i, math.exp(-(i - 5) / 6.0))
        film[i] = ((x - 32) ** 2 + (y - 32) ** 2) * math.pi < area
        film[i, :5, :5] = True
    film[3, 60, 60] = True
    assert measure.patch_times(film, 0.5, 4.0) == pytest.approx([3.0], rel=0.06)
