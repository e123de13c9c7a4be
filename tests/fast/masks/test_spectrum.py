"""The spectral measures on patterns whose spectra are known."""

import io
import json
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from docs.masks.sheets import contact_sheet, corner_pattern, magnified_sheet
from PIL import Image

from seafoam.masks.construct.make import make_mask
from seafoam.masks.judge.plots import plot_spectrum
from seafoam.masks.judge.spectrum import MaskSpectrum, measure_spectrum


def white(size, seed=0):
    return np.random.default_rng(seed).permutation(size * size).astype(np.uint32).reshape(size, size)


def test_white_noise_is_one_and_isotropic():
    spectrum = measure_spectrum(white(256))
    for grey in spectrum.greys:
        assert grey.raps[20:150].mean() == pytest.approx(1.0, abs=0.02)
        assert abs(spectrum.mean_anisotropy(grey.grey)) < 0.2


def test_each_conjugate_pair_counts_once_and_total_power_is_the_variance():
    """Parseval: the mean of P over all bins but the mean's is 1 / (1 - 1/M^2) of the pattern's share."""
    ranks = white(64)
    grey = measure_spectrum(ranks, greys=(0.25,))
    pattern = (ranks < 0.25 * ranks.size) - 0.25
    full = np.abs(np.fft.fft2(pattern)) ** 2 / ranks.size / (0.25 * 0.75)
    assert full.mean() == pytest.approx(1.0)
    weight = grey.bins * grey.greys[0].raps
    # Two of every pair but for the three bins that are their own twins.
    own = full[0, 32] + full[32, 0] + full[32, 32]
    assert 2 * weight.sum() - own == pytest.approx(full.sum())
    size = 32
    spectrum = measure_spectrum(white(size))
    assert spectrum.bins.sum() == (size * size - 4) // 2 + 3
    assert spectrum.bins[0] == 4
    assert spectrum.frequency[0] == 1 / size


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
            assert spectrum.greys[0].anisotropy[ring - 1] == pytest.approx(expected)


def test_white_noise_is_isotropic_and_a_plaid_reads_as_anisotropic():
    assert measure_spectrum(white(256)).mean_anisotropy(1 / 2) == pytest.approx(0.0, abs=0.7)
    y, x = np.mgrid[:128, :128]
    stripes = np.argsort(np.argsort((np.sin(x * 2 * np.pi / 8) + 0.1 * np.sin(y * 12.9898 + x * 78.233)).ravel()))
    spectrum = measure_spectrum(stripes.reshape(128, 128).astype(np.uint32))
    assert spectrum.max_anisotropy(1 / 2) > 10.0


def test_json_round_trip_and_bad_measurements():
    spectrum = measure_spectrum(white(64))
    again = MaskSpectrum.model_validate_json(json.dumps(spectrum.model_dump(), allow_nan=False))
    for before, after in zip(spectrum.greys, again.greys, strict=True):
        assert after.grey == before.grey
        assert np.allclose(after.raps, before.raps, rtol=1e-4)
        assert np.array_equal(np.isnan(after.anisotropy), np.isnan(before.anisotropy))
    with pytest.raises(ValueError, match="grey 1"):
        measure_spectrum(white(64), greys=(1.0,))
    with pytest.raises(KeyError):
        measure_spectrum(white(64)).grey(0.3)


def test_pictures_are_png_also_from_threads():
    ranks = make_mask("blur", sigma=2.0, size=64, seed=1)
    spectrum = measure_spectrum(ranks)
    with ThreadPoolExecutor(3) as threads:
        images = list(threads.map(lambda _: plot_spectrum(spectrum, "blur"), range(3)))
    assert {Image.open(io.BytesIO(image)).size for image in images} == {(1350, 1050)}
    assert Image.open(io.BytesIO(contact_sheet([("blur", ranks, spectrum)]))).format == "PNG"
    table = [0.0, 1.0]
    assert Image.open(io.BytesIO(magnified_sheet([("blur", ranks, table)]))).format == "PNG"


def test_the_sheet_shows_the_corner_of_four_tiles():
    ranks = white(512)
    pattern = corner_pattern(ranks, 0.5)
    half = pattern.shape[0] // 2
    ones = ranks < ranks.size // 2
    assert np.array_equal(pattern[half:, half:], ones[:half, :half])
    assert np.array_equal(pattern[:half, :half], ones[-half:, -half:])
