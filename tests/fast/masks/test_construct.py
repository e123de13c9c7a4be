"""Masks as they are made: by every method and in every family."""

import math

import numpy as np
import pytest

from seafoam.masks.catalogue import load_mask
from seafoam.masks.construct.make import estimated_seconds, make_mask
from seafoam.masks.families import FAMILIES, check_parameters, parse_parameters, sigma_range
from seafoam.masks.judge.morphology import euler_number, hole_areas, largest_piece, measure_morphology
from seafoam.masks.judge.spectrum import measure_spectrum
from seafoam.masks.torus import wrapped_gaussian


def is_permutation(ranks):
    return ranks.dtype == np.uint32 and np.array_equal(np.sort(ranks, axis=None), np.arange(ranks.size))


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("size", [(64, 64), (96, 40), (33, 65), (32, 300)])
def test_a_seed_determines_a_permutation_of_any_width_and_height(family, size):
    """And without a seam: across the tile's edges values differ as they do inside."""
    ranks = make_mask(family, sigma=4.0, size=size, seed=7)
    assert ranks.shape == size[::-1]
    assert is_permutation(ranks)
    assert np.array_equal(ranks, make_mask(family, sigma=4.0, size=size, seed=7))
    assert not np.array_equal(ranks, make_mask(family, sigma=4.0, size=size, seed=8))
    for axis in (0, 1):
        steps = np.abs(np.diff(ranks.astype(np.float64), axis=axis, append=ranks.take([0], axis)))
        along = steps.mean(axis=1 - axis)
        assert along[-1] < along[:-1].mean() + 5.0 * along[:-1].std()
    foam = ranks < 0.3 * ranks.size
    assert abs(foam.sum() - 0.3 * foam.size) <= 1
    assert measure_spectrum(ranks).frequency[0] == 1 / min(size)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_ends_of_the_sigma_range_are_buildable(family):
    """On tiles whose side limits sigma, and on others."""
    for size in (32, 256):
        for sigma in sigma_range(family, size):
            if estimated_seconds(check_parameters(family, sigma, size, 1)) < 1.0:
                ranks = make_mask(family, sigma=sigma, size=size, seed=1)
                assert ranks.shape == (size, size)
                assert is_permutation(ranks)


def test_batches_keep_the_spectrum_of_the_exact_order():
    for grey in (1 / 4, 1 / 2):
        powers = []
        for method in ("exact", "batched"):
            found = measure_spectrum(make_mask("vac", sigma=1.5, size=128, seed=5, method=method), greys=(grey,))
            bands = np.digitize(found.frequency, (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7))
            powers.append([found.greys[0].raps[bands == band].mean() for band in range(7)])
            assert powers[-1][0] < 0.05
        assert powers[1][2:] == pytest.approx(powers[0][2:], rel=0.15)


def test_exact_order_is_a_permutation_that_fills_the_largest_void():
    """From the 129th texel on, with the Gaussian no longer widened, each texel minimises the filtered pattern."""
    for sigma in (0.5, 1.5, 4.0, 8.0):
        assert is_permutation(make_mask("vac", sigma=sigma, size=64, seed=3, method="exact"))
    size, sigma = 64, 6.0
    ranks = make_mask("vac", sigma=sigma, size=size, seed=2, method="exact")
    kernel = wrapped_gaussian((size, size), sigma)
    for count in (200, 1000, 3000):
        ones = ranks < count
        energy = np.fft.irfft2(np.fft.rfft2(ones) * np.fft.rfft2(kernel), s=(size, size))
        chosen = energy[ranks == count][0]
        assert chosen == pytest.approx(energy[~ones].min(), abs=1e-9)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ({"family": "vac", "size": (64, 1025)}, "size 1025"),
        ({"family": "vac", "size": True}, "size True"),
        ({"family": "vac", "seed": 1.5}, r"seed 1\.5"),
        ({"family": "vac", "sigma": 9.0, "size": (512, 64)}, r"0\.5\.\.8 texels for vac at 512 x 64"),
        ({"family": "vac", "sigma": 0.4}, r"sigma 0\.4 is outside 0\.5\.\.24"),
        ({"family": "vac", "sigma": float("nan")}, "sigma nan"),
    ],
)
def test_bad_arguments_are_named(arguments, named):
    """Those that only Python can give; others: test_api_errors.py and test_refusals.py."""
    with pytest.raises(ValueError, match=named):
        make_mask(**arguments)


def test_estimates_tell_slow_requests_from_quick_ones_and_default_sigma_fits_small_tiles():
    for family, sigma, least, most in (
        ("vac", 1.5, 0.0, 2.0),
        ("vac", 6.0, 0.0, 5.0),
        ("vac", 7.0, 5.0, math.inf),
        ("vac", 24.0, 30.0, math.inf),
        *((family, 4.0, 0.0, 2.0) for family in ("blur", "clump", "bubble", "mix", "lace")),
    ):
        assert least < estimated_seconds(check_parameters(family, sigma, 512, 0)) < most, (family, sigma)
    assert check_parameters("vac", None, 64, 0).sigma == 8.0
    assert check_parameters("clump", None, 512, 0).sigma == 1.5


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


@pytest.mark.parametrize("name", SHIPPED)
def test_holes_grow_as_foam_thins_as_recorded(name):
    mask = load_mask(name)
    measured = measure_morphology(mask.ranks)
    assert measured == mask.tables.morphology
    shapes = {one.saturation: one for one in measured.saturations}
    medians = [shapes[s].hole_diameters[1] for s in (0.9, 0.7, 0.5, 0.3)]
    assert medians == sorted(medians)
    assert medians[-1] > 4.0 * medians[0]
    assert measured.joined_from <= 0.25
    assert shapes[0.3].largest_piece > 0.9


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
