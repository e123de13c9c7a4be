"""Open sea in float64: its waves, bounds, seeds and the cover of its whitecaps."""

import math
from typing import Literal

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.basics import spectrum as sea_spectrum
from seafoam.ocean.waves import cascades as sea_tiles
from seafoam.ocean.waves.cascades import BAND, Cascade
from seafoam.reference.waves import sea as truth
from seafoam.reference.waves.sea import TileSample
from seafoam.scene import Foam, Scene, Sea, WhitecapSaturation
from seafoam.textures.store import texture
from seafoam.textures.waves import SeaSpectrum
from support.pictures import rms
from support.report import Report
from support.scenes.seas import SEAS
from support.sweep import REST

POINTS = 800


def summed(cascade: Cascade, time: float, x: NDArray[np.float64], z: NDArray[np.float64]) -> TileSample:
    """A tile as the sum of all its waves, at every place (m, (r,)) at a time, s."""
    step = 2.0 * math.pi / cascade.size
    rows, columns = np.nonzero(cascade.h0)
    kx, kz = step * (columns - BAND), step * (rows - BAND)
    k = np.hypot(kx, kz)
    h = 2.0 * truth.amplitudes(cascade, time)[rows, columns]
    parts: list[list[NDArray[np.float64]]] = []
    for start in range(0, x.size, 256):
        here = slice(start, start + 256)
        wave = np.exp(1j * (kx[:, None] * x[here] + kz[:, None] * z[here]))
        factors = (1.0, 1j * kx, 1j * kz, 1j * kx / k, 1j * kz / k, -kx * kx / k, -kx * kz / k, -kz * kz / k)
        parts.append([np.real((h * factor) @ wave) for factor in factors])
    return TileSample(*(np.concatenate(part) for part in zip(*parts, strict=True)))


@pytest.mark.parametrize("name", SEAS)
def test_the_reference_is_the_sum_of_its_waves(report: Report, name: str) -> None:
    """The grids, splines and Newton steps of the reference against direct sums over every wave."""
    sea = SEAS[name]
    random = np.random.default_rng(3)
    for i, of in enumerate(sea_tiles.cascades(sea, None)):
        count = POINTS if i == 0 else 300
        x, z = random.uniform(0.0, of.size, (2, count))
        wanted = summed(of, 12.5, x, z)
        got = truth.grids(of, 12.5, truth.TEXELS)
        tile = truth.tile(of, 12.5, sea.choppiness)
        surface = truth.SeaSurface((tile,), (of,), (0.0, 0.0), ())
        choppy = of.choppiness(sea.choppiness)
        p_x, p_z = x + choppy * wanted.d_x, z + choppy * wanted.d_z
        folds = wanted.jacobian(choppy)
        steep_x = ((1 + choppy * wanted.zz) * wanted.h_x - choppy * wanted.xz * wanted.h_z) / folds
        height = surface.height(p_x, p_z)
        seen_x, _ = surface.shading(p_x, p_z)
        deviation, slope = math.sqrt(of.variance), math.sqrt(of.mean_square_slope)
        away = height - wanted.h
        spline = np.abs(surface.read(3, tile, truth.coefficients(got.d_x), x, z) - wanted.d_x).max()
        # Bilinear between texels, and slopes by a spline that is not interpolating: part of the model.
        report.within(
            "The reference's tiles against direct sums (in standard deviations of height and slope)",
            model=name,
            tile=of.size,
            displacement=(spline / deviation, 2e-3),
            height=(rms(away) / deviation, 0.02),
            slope=(rms(seen_x - steep_x) / slope, 0.1),
        )


def test_a_seed_is_a_sea() -> None:
    seas = [SeaSpectrum(sea=SEAS["fft"].model_copy(update={"seed": seed})) for seed in (1, 1, 2)]
    sea_tiles.cascades.cache_clear()
    texture.cache_clear()
    first = texture(seas[0]).sha256
    sea_tiles.cascades.cache_clear()
    texture.cache_clear()
    assert texture(seas[1]).sha256 == first
    assert texture(seas[2]).sha256 != first


def test_a_river_has_no_wave_against_its_wind() -> None:
    for name, sea in SEAS.items():
        river = sea.model_copy(update={"against": 0.0, "wind": 6.0, "fetch": 2e3})
        for of in sea_tiles.cascades(river, 3.0):
            rows, columns = np.nonzero(of.h0)
            along = (columns - sea_tiles.BAND) * math.cos(river.downwind) + (rows - sea_tiles.BAND) * math.sin(
                river.downwind
            )
            assert (along > -1e-9).all(), name


@pytest.mark.parametrize("wind", [12.0, 60.0])
def test_slopes_stay_under_the_marchs_bound(wind: float) -> None:
    """The bound is a quantile: over these tiles no pair of neighbouring texels passes it, and no height its limit."""
    for seed in (1, 2):
        sea = SEAS["fft"].model_copy(update={"wind": wind, "seed": seed, "choppiness": 1.0})
        for of in sea_tiles.cascades(sea, None)[: sea_tiles.RAISED]:
            tile = truth.tile(of, 40.0 * seed, 1.0, 256)
            step = of.size / 256
            across = [np.diff(tile.height, axis=axis, append=np.take(tile.height, [0], axis)) / step for axis in (0, 1)]
            assert np.hypot(*across).max() <= of.max_slope
            assert np.abs(tile.height).max() <= of.limit


def test_shallow_water_lowers_and_shortens_the_sea() -> None:
    deep, shallow = (sea_tiles.cascades(Sea(wind=15.0), depth) for depth in (None, 4.0))
    assert sum(of.variance for of in shallow) < 0.5 * sum(of.variance for of in deep)
    assert shallow[0].size < deep[0].size
    k = np.geomspace(1e-3, 10.0, 200)
    omega, group, factor = sea_spectrum.dispersion(k, 4.0)
    assert np.abs(omega**2 - 9.81 * k * np.tanh(4.0 * k)).max() <= 1e-9 * omega.max() ** 2
    numeric = np.gradient(omega, k, edge_order=2)
    assert np.abs(numeric / group - 1.0).max() <= 5e-3
    assert (factor <= 1.0).all()
    assert (np.diff(factor) >= -1e-12).all()


LASTING = WhitecapSaturation(lasting=True, decay=3.7)


@pytest.mark.parametrize(
    ("model", "wind", "foam", "texels"),
    [
        ("fft", 5.0, WhitecapSaturation(), 256),
        ("gerstner", 12.5, WhitecapSaturation(), 256),
        ("fft", 7.5, LASTING, 512),
        pytest.param("fft", 20.0, LASTING, 512, marks=REST),
    ],
    ids=lambda value: "" if isinstance(value, WhitecapSaturation) else str(value),
)
def test_whitecaps_cover_what_the_wind_raises(
    report: Report, model: Literal["fft", "gerstner"], wind: float, foam: WhitecapSaturation, texels: int
) -> None:
    """Within 20 % of Monahan and O'Muircheartaigh (1980); masks are rank-uniform, so mean saturation is coverage.

    Foam of larger waves that stays for 11 s is shared out anew, so it covers as much.
    """
    found = []
    for seed in (1, 4):
        scene = Scene(sea=Sea(model=model, wind=wind, fetch=5e5, seed=seed), foam=Foam(saturation=(foam,)))
        surface = truth.sea_surface(scene, 70.0 * seed, (0.0, 0.0), texels)
        assert surface is not None
        x, z = np.random.default_rng(seed).uniform(0.0, 2e4, (2, 100_000))
        found.append(float(truth.whitecap_saturation(scene, foam, surface, x, z).mean()))
    wanted = 3.84e-6 * wind**3.41
    report.within(
        "Whitecaps: share of the sea under foam over the law, less 1",
        sea=model,
        lasting=foam.lasting,
        wind=wind,
        off=(abs(float(np.mean(found)) / wanted - 1.0), 0.2),
    )
