"""Lace is the walls of a foam: in one piece when thin, its holes grow as it thins, no direction before another."""

import numpy as np
import pytest

from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.masks.families import check_parameters, parse_parameters
from seafoam.masks.judge.morphology import euler_number, hole_areas, largest_piece, measure_morphology
from seafoam.masks.judge.spectrum import measure_spectrum

SHIPPED = ("lace", "lacetorn", "streak")


def pattern(*rows):
    return np.array([[texel == "#" for texel in row] for row in rows])


def test_shapes_are_counted_round_the_torus():
    assert largest_piece(pattern("#..#", "....", "....", "#..#")) == 1.0
    assert largest_piece(pattern("##..", "....", "..#.", "....")) == pytest.approx(2 / 3)
    # Touching corners join foam; the third is apart.
    assert largest_piece(pattern("#....", ".#...", ".....", "...#.", ".....")) == pytest.approx(2 / 3)
    assert largest_piece(np.zeros((4, 4), bool)) == 0.0


def test_euler_numbers_of_known_patterns():
    for number, foam in (
        (1, pattern("....", ".##.", ".##.", "....")),
        (0, pattern(".....", ".###.", ".#.#.", ".###.", ".....")),
        (2, pattern("#...", "....", "..#.", "....")),
        # A band round the torus is neither a piece nor a hole more.
        (0, pattern("....", "####", "....", "....")),
        (0, np.ones((4, 4), bool)),
        (0, np.zeros((4, 4), bool)),
    ):
        assert euler_number(foam) == euler_number(np.roll(foam, (2, 1), (0, 1))) == number


def test_chords_and_holes_of_stripes():
    rows = np.arange(64)[:, None] + np.zeros(64, int)[None, :]
    ranks = np.argsort(np.argsort((rows % 16).ravel(), kind="stable"), kind="stable").reshape(64, 64)
    shapes = measure_morphology(ranks.astype(np.uint32)).at(0.5)
    # Four stripes of 8 rows: 256 runs of 8 along columns, no end along rows.
    assert shapes.foam_chord == pytest.approx(16.0)
    assert shapes.hole_diameters == pytest.approx([np.sqrt(4 * 8 * 64 / np.pi)] * 3, rel=1e-3)


@pytest.mark.parametrize("seed", [2011, 1, 7])
def test_thin_lace_holds_together(seed):
    ranks = make_mask("lace", size=512, seed=seed)
    measured = measure_morphology(ranks)
    assert measured.joined_from <= 0.25
    assert measured.at(0.3).largest_piece > 0.9
    spectrum = measure_spectrum(ranks)
    for grey in (1 / 4, 1 / 2):
        assert abs(spectrum.mean_anisotropy(grey)) < 0.2


@pytest.mark.parametrize("name", SHIPPED)
def test_holes_grow_as_foam_thins_as_recorded(name):
    measured = load_mask(name).tables.morphology
    medians = [measured.at(s).hole_diameters[1] for s in (0.9, 0.7, 0.5, 0.3)]
    assert medians == sorted(medians)
    assert medians[-1] > 4.0 * medians[0]
    assert measured.joined_from <= 0.25
    assert measured.at(0.3).largest_piece > 0.9
    mask = load_mask(name)
    assert measure_morphology(mask.ranks) == mask.tables.morphology


def test_discs_do_not_hold_together():
    for name in ("mix", "bubble"):
        assert load_mask(name).tables.morphology.at(0.3).largest_piece < 0.1


def test_streaks_run_along_x_and_old_lace_is_patchier():
    shapes = {}
    for aspect in (1.0, 3.0):
        foam = make_mask("lace", size=256, seed=3, aspect=aspect) < 0.5 * 256**2
        runs = [int((foam & ~np.roll(foam, 1, axis=axis)).sum()) for axis in (1, 0)]
        shapes[aspect] = runs[1] / runs[0]
    assert shapes[1.0] == pytest.approx(1.0, abs=0.1)
    assert shapes[3.0] > 1.8
    # Cover of boxes of 64 texels differs more where foam is old.

    def spread(age):
        boxes = (make_mask("lace", size=512, seed=5, age=age) < 0.3 * 512**2).reshape(8, 64, 8, 64)
        return float(boxes.mean(axis=(1, 3)).std())

    assert spread(1.0) > 1.3 * spread(0.0)


def test_parameters_travel_as_text():
    for text in ("lace:10:256:3:1:0", "lace:12.5:512:7:3:0.7", "vac:1.5:128:9"):
        assert parse_parameters(text).text == text
    assert parse_parameters("lace:10:256:3").text == "lace:10:256:3:1:0"
    for text, named in (
        ("vac:1.5:128", "family:sigma:size:seed"),
        ("lace:10:256:3:7:0", "aspect 7.0 is outside 1..6"),
        ("lace:10:256:3:1:1.5", "age 1.5 is outside 0..1"),
        ("vac:1.5:128:9:2:0", "aspect 2.0 is allowed only for lace, not vac"),
        ("lace:3:256:0", "sigma 3.0 is outside 4..24"),
    ):
        with pytest.raises(ValueError, match=named):
            parse_parameters(text)
    with pytest.raises(ValueError, match="age nan"):
        check_parameters("lace", None, 256, 0, 1.0, float("nan"))


def test_holes_hold_all_the_water():
    ranks = load_mask("lace").ranks
    for saturation in (0.0, 0.3, 0.7, 1.0):
        areas = hole_areas(ranks, saturation)
        assert areas.sum() == np.count_nonzero(ranks >= saturation * ranks.size)
        assert (np.diff(areas) >= 0).all()
    with pytest.raises(ValueError, match="saturation"):
        hole_areas(ranks, 1.5)
