"""docs/nature.md: its figures are of the presets as they are, and what measures them finds what was put in."""

import json
import math

import numpy as np
import pytest
from docs import make_nature
from docs.nature import laws, measure

from seafoam.scene.camera import Camera
from seafoam.scene.light import direction
from seafoam.scene.presets import load_preset

FIGURES = json.loads(make_nature.FIGURES.read_text(encoding="utf-8"))


def test_the_figures_are_of_the_presets_and_in_the_page() -> None:
    stale = [name for name, of in FIGURES.items() if of["of"] != make_nature.measured_of(load_preset(name))]
    assert not stale, "run python docs/make_nature.py"
    assert tuple(FIGURES) == make_nature.PRESETS
    page = make_nature.PAGE.read_text(encoding="utf-8")
    assert page == make_nature.filled(page, FIGURES), "run python docs/make_nature.py"


def test_what_lies_out_of_a_band_says_why_and_bands_have_what_was_published() -> None:
    row = laws.Row("above", "storm", 0.9, 1.0, 2.0)
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


def test_slopes_are_found_in_a_picture_of_glitter() -> None:
    view = measure.rays(Camera(pitch=-0.5 * math.pi, fov=1.9), (96, 96))
    sun = direction(0.4, 1.2)
    picture = 7.0 * measure.glitter(view, sun, 0.9, (0.031, 0.018)) + 0.2
    assert measure.fitted_variances(picture, view, sun, 0.9) == pytest.approx((0.031, 0.018), rel=1e-3)


def test_the_glitter_mirrors_no_more_than_falls_on_it() -> None:
    """Over all directions upward it sends back what water reflects, its facets facing straight up to a few degrees."""
    view = measure.rays(Camera(pitch=-0.5 * math.pi, fov=1.6), (400, 400))
    down = -view[..., 1]
    pixel = (2.0 * math.tan(0.8) / 400) ** 2 * down**3
    sent = float((measure.glitter(view, (0.0, 1.0, 0.0), 0.0, (0.002, 0.002)) * down * pixel).sum())
    assert sent == pytest.approx(0.0204, rel=0.02)


def test_a_paths_width_is_two_and_a_half_deviations() -> None:
    lamp = (0.3, 0.25)
    view = measure.path_view(lamp)[1]
    aside = np.arctan2(view[..., 2], view[..., 0]) - lamp[0]
    picture = 3.0 + np.exp(-0.5 * (aside / 0.08) ** 2)
    assert measure.equivalent_width(picture, view, lamp) == pytest.approx(math.sqrt(2.0 * math.pi) * 0.08, rel=0.03)


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
