"""The baked masks are what their catalogue says, and have the spectra they are shipped for."""

from itertools import pairwise

import numpy as np
import pytest

from seafoam.masks.bake import SHIPPED, SHIPPED_SIZE
from seafoam.masks.catalogue import Mask, load_catalogue, load_mask, rank_sha256
from seafoam.masks.construct.make import make_mask
from seafoam.masks.families import GENERATOR
from seafoam.masks.judge.spectrum import measure_spectrum
from seafoam.masks.prefilter import quantile_table
from seafoam.resources import data_dir
from support.sweep import spread

NAMES = [mask.name for mask in SHIPPED]
VAC = [name for name in NAMES if name.startswith("vac-")]


def test_the_catalogue_lists_every_mask_in_order():
    catalogue = load_catalogue()
    assert list(catalogue) == NAMES
    for name, entry in catalogue.items():
        assert entry.name == name
        assert (entry.parameters.width, entry.parameters.height) == (SHIPPED_SIZE, SHIPPED_SIZE)
        assert entry.generator == GENERATOR
        assert entry.license == "CC0-1.0"
        assert entry.parameters.method == ("exact" if entry.family == "vac" else None)
    assert all("never published" in catalogue[name].summary for name in VAC)
    assert "CC0 1.0 Universal" in (data_dir("masks") / "LICENSE").read_text("utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_ranks_are_the_recorded_permutation_with_the_recorded_spectra(name):
    mask = load_mask(name)
    assert np.array_equal(np.sort(mask.ranks, axis=None), np.arange(SHIPPED_SIZE**2))
    assert rank_sha256(mask.ranks) == mask.entry.sha256
    assert not mask.ranks.flags.writeable
    again = measure_spectrum(mask.ranks)
    for recorded, measured in zip(mask.tables.spectrum.greys, again.greys, strict=True):
        assert np.allclose(recorded.raps, measured.raps, rtol=1e-4, atol=1e-12)
        assert np.allclose(recorded.anisotropy, measured.anisotropy, rtol=1e-4, atol=1e-4, equal_nan=True)


@pytest.mark.parametrize("name", spread(NAMES, 3))
def test_recorded_tables_are_those_of_the_ranks(name):
    mask = load_mask(name)
    assert np.allclose(mask.quantile, quantile_table(mask.ranks), atol=1e-5)
    computed = Mask(mask.entry, mask.ranks, mask.measured)
    assert np.allclose(mask.filtering.quantiles, computed.filtering.quantiles, rtol=0.0, atol=1e-9)
    assert np.allclose(mask.filtering.ramps, computed.filtering.ramps, rtol=0.0, atol=1e-9)
    assert not mask.filtering.quantiles.flags.writeable
    assert not mask.filtering.ramps.flags.writeable


@pytest.mark.parametrize("name", ["blur-6", "clump", "bubble", "mix", "lace", "lacetorn", "streak"])
def test_the_recorded_arguments_make_the_mask_again(name):
    """All but bitwise: another processor's FFT may order a few nearly equal texels otherwise."""
    entry = load_mask(name).entry
    own = entry.parameters
    lace = {"aspect": own.aspect, "age": own.age} if entry.family == "lace" else {}
    ranks = make_mask(entry.family, sigma=own.sigma, size=own.width, seed=own.seed, method="exact", **lace)
    moved = np.abs(ranks.astype(np.int64) - load_mask(name).ranks.astype(np.int64))
    assert np.median(moved) <= 1


def test_low_frequencies_are_suppressed_and_only_void_and_cluster_keeps_high_ones():
    for name in VAC:
        assert load_mask(name).tables.spectrum.mean_raps(1 / 2, 0.0, 0.02) < 0.03
    for name in ("blur-1.5", "blur-6", "blur-24"):
        assert load_mask(name).tables.spectrum.mean_raps(1 / 2, 0.0, 0.02) > 3.0
    for sigma in ("1.5", "6", "24"):
        vac, blur = load_mask(f"vac-{sigma}").tables.spectrum, load_mask(f"blur-{sigma}").tables.spectrum
        assert vac.mean_raps(1 / 2, 0.5, 0.7) > 0.7
        assert blur.mean_raps(1 / 2, 0.5, 0.7) < 0.2
    power = [
        load_mask(name).tables.spectrum.mean_raps(1 / 2, 0.5, 0.7) for name in ("vac-1.5", "vac-3", "vac-6", "vac-12")
    ]
    assert all(first > second for first, second in pairwise(power))
    assert load_mask("vac-24").tables.spectrum.mean_raps(1 / 2, 0.5, 0.7) < 0.9


@pytest.mark.parametrize("name", VAC)
def test_void_and_cluster_masks_are_isotropic(name):
    spectrum = load_mask(name).tables.spectrum
    assert spectrum.isotropic_reference == 0.0
    for grey in spectrum.greys:
        assert abs(spectrum.mean_anisotropy(grey.grey)) < 0.3
        assert spectrum.max_anisotropy(grey.grey) < 5.0


def test_masks_are_loaded_once_and_one_without_recorded_tables_measures_them():
    assert load_mask("mix") is load_mask("mix")
    shipped = load_mask("clump")
    fresh = Mask(shipped.entry, shipped.ranks)
    assert fresh.quantile == pytest.approx(shipped.quantile, abs=1e-6)
