"""The masks that are shipped, their spectra, and masks that somebody asks for."""

import io
import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from docs.masks.sheets import contact_sheet, magnified_sheet
from masks import bake
from PIL import Image

from seafoam.masks.catalogue import Mask, Thresholds, load_mask, mask_by_name, rank_sha256, read_catalogue
from seafoam.masks.construct.make import make_mask
from seafoam.masks.families import GENERATOR, check_parameters
from seafoam.masks.formats import decode_ranks
from seafoam.masks.judge.plots import plot_spectrum
from seafoam.masks.judge.spectrum import MaskSpectrum, measure_spectrum
from seafoam.masks.prefilter import quantile_table
from seafoam.resources import data_dir
from support.sweep import spread

NAMES = list(bake.SHIPPED)
VAC = [name for name in NAMES if name.startswith("vac-")]


def test_the_catalogue_lists_every_mask_in_order():
    catalogue = {name: entry for name, (entry, _) in read_catalogue(data_dir("masks")).items()}
    assert list(catalogue) == NAMES
    for name, entry in catalogue.items():
        assert entry.name == name
        assert (entry.parameters.width, entry.parameters.height) == (512, 512)
        assert entry.generator == GENERATOR
        assert entry.license == "CC0-1.0"
        assert entry.parameters.method == ("exact" if entry.family == "vac" else None)
    assert all("never published" in catalogue[name].summary for name in VAC)
    assert "CC0 1.0 Universal" in (data_dir("masks") / "LICENSE").read_text("utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_ranks_are_the_recorded_permutation_with_the_recorded_spectra(name):
    mask = load_mask(name)
    assert np.array_equal(np.sort(mask.ranks, axis=None), np.arange(512**2))
    assert rank_sha256(mask.ranks) == mask.entry.sha256
    assert not mask.ranks.flags.writeable
    again = measure_spectrum(mask.ranks)
    for recorded, measured in zip(mask.tables.spectrum.greys, again.greys, strict=True):
        assert np.allclose(recorded.raps, measured.raps, rtol=1e-4, atol=1e-12)
        assert np.allclose(recorded.anisotropy_db, measured.anisotropy_db, rtol=1e-4, atol=1e-4, equal_nan=True)


@pytest.mark.parametrize("name", spread(NAMES, 5))
def test_recorded_tables_are_those_of_the_ranks(name):
    mask = load_mask(name)
    assert np.allclose(mask.quantile, quantile_table(mask.ranks), atol=1e-5)
    computed = Mask(mask.entry, mask.ranks, mask.measured)
    assert np.allclose(mask.filtering.quantiles, computed.filtering.quantiles, rtol=0.0, atol=1e-9)
    assert np.allclose(mask.filtering.ramps, computed.filtering.ramps, rtol=0.0, atol=1e-9)
    assert not mask.filtering.quantiles.flags.writeable
    assert not mask.filtering.ramps.flags.writeable


@pytest.mark.parametrize("name", ["blur-6", "clump", "bubble", "mix", "streak"])
def test_the_recorded_arguments_make_the_mask_again(name):
    """All but bitwise: another processor's FFT may order a few nearly equal texels otherwise."""
    entry = load_mask(name).entry
    own = entry.parameters
    lace = {"aspect": own.aspect, "age": own.age} if entry.family == "lace" else {}
    ranks = make_mask(entry.family, sigma=own.sigma, size=own.width, seed=own.seed, method="exact", **lace)
    moved = np.abs(ranks.astype(np.int64) - load_mask(name).ranks.astype(np.int64))
    assert np.median(moved) <= 1


def test_ring_statistics_are_those_of_the_definition():
    size, level = 32, 0.5
    ranks = make_mask("vac", sigma=1.5, size=size, seed=4)
    spectrum = measure_spectrum(ranks, greys=(level,))
    pattern = (ranks < level * ranks.size) - level
    power = np.abs(np.fft.fft2(pattern)) ** 2 / size**2 / (level * (1 - level))
    rings: dict[int, list[float]] = {}
    for ky in range(-size // 2 + 1, size // 2 + 1):
        for kx in range(-size // 2 + 1, size // 2 + 1):
            own_twin = ky in (0, size // 2) and kx in (0, size // 2)
            right = 0 < kx < size // 2
            upper = kx in (0, size // 2) and 0 < ky < size // 2
            if (own_twin or right or upper) and (ky, kx) != (0, 0):
                rings.setdefault(round(np.hypot(ky, kx)), []).append(power[ky, kx])
    for ring, values in rings.items():
        assert spectrum.bins[ring - 1] == len(values)
        assert spectrum.greys[0].raps[ring - 1] == pytest.approx(np.mean(values))
        if len(values) > 1:
            expected = 10 * np.log10(np.var(values, ddof=1) / np.mean(values) ** 2)
            assert spectrum.greys[0].anisotropy_db[ring - 1] == pytest.approx(expected)


def test_json_round_trip_and_bad_measurements():
    ranks = make_mask("blur", sigma=2.0, size=64, seed=1)
    spectrum = measure_spectrum(ranks)
    again = MaskSpectrum.model_validate_json(json.dumps(spectrum.model_dump(), allow_nan=False))
    for before, after in zip(spectrum.greys, again.greys, strict=True):
        assert after.grey == before.grey
        assert np.allclose(after.raps, before.raps, rtol=1e-4)
        assert np.array_equal(np.isnan(after.anisotropy_db), np.isnan(before.anisotropy_db))
    with pytest.raises(ValueError, match="grey 1"):
        measure_spectrum(ranks, greys=(1.0,))


def test_pictures_are_png_also_from_threads():
    ranks = make_mask("blur", sigma=2.0, size=64, seed=1)
    spectrum = measure_spectrum(ranks)
    with ThreadPoolExecutor(3) as threads:
        images = list(threads.map(lambda _: plot_spectrum(spectrum, "blur"), range(3)))
    assert {Image.open(io.BytesIO(image)).size for image in images} == {(1350, 1050)}
    assert Image.open(io.BytesIO(contact_sheet([("blur", ranks, spectrum)]))).format == "PNG"
    table = [0.0, 1.0]
    assert Image.open(io.BytesIO(magnified_sheet([("blur", ranks, table)]))).format == "PNG"


def test_a_request_is_answered_from_the_cache_the_second_time_and_names_its_sigma():
    first = mask_by_name("vac:1.5:64:9")
    assert mask_by_name("vac:1.5:64:9") is first
    assert first.entry.parameters.method == "batched"
    assert first.entry.name == "vac-1.5-64-9"
    assert first.entry.sha256 == rank_sha256(first.ranks)
    assert not first.ranks.flags.writeable
    assert not first.spans[0].flags.writeable
    assert check_parameters("blur", None, 64, 0).sigma == 6.0


def test_tables_are_measured_when_asked_for():
    mask = mask_by_name("clump:1.5:128:4")
    assert "tables" not in vars(mask)
    assert len(mask.quantile) == 65
    assert mask.tables.spectrum.frequency[0] == 1 / 128
    assert mask.sidecar()["spectrum"]


def test_baking_writes_what_the_catalogue_reads(tmp_path, monkeypatch):
    small = {name: replace(mask, width=64, height=64) for name, mask in bake.SHIPPED.items() if mask.sigma <= 8.0}
    monkeypatch.setattr(bake, "SHIPPED", small)
    with ThreadPoolExecutor(1) as pool:
        bake.bake_all(tmp_path / "masks", pool)
    catalogue = read_catalogue(tmp_path / "masks")
    assert list(catalogue) == list(small)
    for name, (entry, tables) in catalogue.items():
        ranks = decode_ranks((tmp_path / "masks" / f"{name}.ranks").read_bytes(), entry.parameters.width)
        assert rank_sha256(ranks) == entry.sha256
        baked = Thresholds.from_bytes((tmp_path / "masks" / f"{name}.tables").read_bytes())
        computed = Mask(entry, ranks, tables)
        assert baked.quantiles.shape == (8, 65)
        assert np.allclose(baked.quantiles, computed.filtering.quantiles, rtol=0.0, atol=1e-4)
        assert np.allclose(baked.ramps, computed.filtering.ramps, rtol=0.0, atol=1e-4)
        assert np.isfinite(tables.quantile.entries).all()
