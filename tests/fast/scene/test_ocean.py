"""Analytic tests of what is computed once of the ocean and of the sky over it."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.water.water import bed_sun
from seafoam.ocean.arrays import smoothstep
from seafoam.ocean.basics.dispersion import wavenumber
from seafoam.ocean.basics.spectrum import frequency_spectrum, peak_frequency
from seafoam.ocean.coast.rocks import rocks, splash_height
from seafoam.ocean.coast.seabed import floor_grid
from seafoam.ocean.constants import GRAVITY, WATER_INDEX
from seafoam.ocean.foam.whitecaps import whitecaps
from seafoam.ocean.sky import air, skylight
from seafoam.ocean.waves import stokes
from seafoam.ocean.waves.cascades import cascades, slope_heading
from seafoam.ocean.waves.groups import group_speed, group_velocity
from seafoam.ocean.waves.rings import ring_height, trains
from seafoam.ocean.waves.ripples import SURFACE_TENSION, ripple_cascades
from seafoam.ocean.waves.wakes import wakes
from seafoam.scene.boats import Boat
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore
from seafoam.scene.spray import Spray
from seafoam.scene.water import Ripples, Water
from seafoam.scene.waves import ParametricWave, Ring, Sea

SEAS = ((6.0, 2e4), (10.0, 1e5), (15.0, 3e5))
"""Wind (m/s) and fetch (m)."""


def variance(wind: float, fetch: float) -> float:
    """Integral of the frequency spectrum, m²."""
    omega: NDArray[np.float64] = np.linspace(0.02, 40.0, 400_000)
    return float(np.trapezoid(frequency_spectrum(omega, wind, fetch), omega))


def test_gravity_and_whitecaps_are_as_published() -> None:
    assert pytest.approx(9.80665, rel=4e-4) == GRAVITY
    # About 1 % at 10 m/s, 4 % at 15 m/s (Monahan and O'Muircheartaigh 1980, figure 1).
    assert whitecaps(10.0) == pytest.approx(0.00987, rel=0.01)
    assert whitecaps(15.0) == pytest.approx(0.0393, rel=0.01)
    assert whitecaps(0.0) == 0.0


@pytest.mark.parametrize(("wind", "fetch"), SEAS)
def test_the_spectrum_has_the_integral_of_jonswap_and_tiles_its_variance(wind: float, fetch: float) -> None:
    """Pierson and Moskowitz's is αg²/(5ωₚ⁴); a peak enhancement of 3.3 multiplies it by 1.525 (Yamaguchi 1984)."""
    alpha = 0.076 * (wind**2 / (fetch * GRAVITY)) ** 0.22
    moskowitz = alpha * GRAVITY**2 / (5.0 * peak_frequency(wind, fetch) ** 4)
    assert variance(wind, fetch) / moskowitz == pytest.approx(1.525, rel=0.01)
    tiles = cascades(Sea(wind=wind, fetch=fetch), None)
    assert sum(tile.variance for tile in tiles) == pytest.approx(variance(wind, fetch), rel=1e-3)


def test_slopes_of_a_sea_lie_along_its_wind() -> None:
    """Over cos^2s(θ/2) the mean of cos 2θ, the second Fourier coefficient, is s(s − 1)/((s + 1)(s + 2))."""
    for spread in (0.0, 1.0, 6.0, 30.0):
        sea = Sea(wind=9.0, fetch=5e4, spread=spread, against=1.0, wind_direction=0.7)
        mean = spread * (spread - 1.0) / ((spread + 1.0) * (spread + 2.0))
        want = (mean * math.cos(1.4), mean * math.sin(1.4))
        assert slope_heading(cascades(sea, None)) == pytest.approx(want, abs=0.01)
    assert slope_heading(cascades(Sea(wind=0.0), None)) == (0.0, 0.0)


def test_wavenumbers_have_the_limits_of_deep_and_shallow_water() -> None:
    for deep in (0.01, 0.3, 4.0):
        assert wavenumber(deep, None) == deep
        assert wavenumber(deep, 50.0 / deep) == pytest.approx(deep, rel=1e-12)
        # Shallow: ω² = g·deep = g h k², so the phase speed is √(g h).
        assert wavenumber(deep, 1e-4 / deep) == pytest.approx(deep / math.sqrt(1e-4), rel=1e-4)


def test_ripples_obey_the_dispersion_of_gravity_and_capillarity() -> None:
    """ω² = gk + (σ/ρ)k³, up to whole turns; the slopes' mean squares add up to the setting's."""
    waves = [wave for cascade in ripple_cascades(Ripples(slope=0.15)) for wave in cascade]
    assert sum(wave.slope**2 / 2.0 for wave in waves) == pytest.approx(0.15**2, rel=1e-9)
    for wave in waves:
        assert wave.omega == pytest.approx(math.sqrt(GRAVITY * wave.k + SURFACE_TENSION * wave.k**3), rel=1e-9)


def test_rings_and_wakes_travel_at_the_phase_speed() -> None:
    ring = Ring(wavelength=5.0, amplitude=0.1)
    (deep,), (shallow,) = (trains(Scene(rings=(ring,), water=Water(depth=depth))) for depth in (None, 0.05))
    assert deep.speed == pytest.approx(math.sqrt(GRAVITY * 5.0 / (2.0 * math.pi)))
    # At kh = 0.25 the speed is √(gh) to 1 %.
    assert shallow.speed == pytest.approx(math.sqrt(GRAVITY * 0.05), rel=0.015)
    assert ring_height(Scene(rings=(ring,))) == pytest.approx(0.1, rel=0.01)
    # 2πv²/g: 16.0 m at 5 m/s (Kelvin 1887).
    (wake,) = wakes((Boat(speed=5.0),))
    assert wake.wavelength == pytest.approx(16.01, rel=1e-3)


def test_stokes_drift_is_that_of_a_sine() -> None:
    """a²kω at the surface of deep water (Stokes 1847), a the first harmonic: A/2 for the exponent 1, a sine."""
    assert stokes.first_harmonic(3.0, 1.0) == pytest.approx(1.5)
    wave = ParametricWave(amplitude=0.8, wavelength=20.0, direction=0.0, exponent=1.0)
    k = 2.0 * math.pi / 20.0
    x, z = stokes.waves_drift(Scene(waves=(wave,)))
    assert x == pytest.approx(0.4**2 * k * math.sqrt(GRAVITY * k), rel=1e-6)
    assert z == pytest.approx(0.0, abs=1e-12)


def test_refraction_of_the_sun_obeys_snell() -> None:
    for elevation in (0.1, 0.8, 1.5):
        (rule,) = bed_sun(Light(sun_elevation=elevation))["u_bed_sun"].rules
        assert math.cos(elevation) == pytest.approx(WATER_INDEX * math.sin(math.acos(rule.value[0])), rel=1e-6)


def test_the_seabed_ends_at_its_depth_and_steps_without_a_kink() -> None:
    shore = Shore(kind="island", depth=12.0)
    ground = floor_grid(shore, 64)[..., 0]
    edge = np.concatenate((ground[0], ground[-1], ground[:, 0], ground[:, -1]))
    assert np.allclose(edge, -shore.deep, atol=0.02)
    ends = smoothstep(2.0, 4.0, np.array([2.0, 3.0, 4.0, 2.0 + 1e-6]))
    assert ends[:3].tolist() == [0.0, 0.5, 1.0]
    assert ends[3] < 1e-11


def test_rocks_of_spray_lie_on_the_coast() -> None:
    shore = Shore(kind="island")
    found = rocks(shore, 0.0)
    assert np.hypot(found[:, 2], found[:, 3]) == pytest.approx(1.0, abs=2e-3)
    texels = 256
    ground, texel = floor_grid(shore, texels)[..., 0], shore.size / texels
    column, row = ((found[:, i] + 0.5 * shore.size) / texel - 0.5 for i in (0, 1))
    near = [
        ground[np.round(row + dz).astype(int), np.round(column + dx).astype(int)]
        for dz in (-1, 0, 1)
        for dx in (-1, 0, 1)
    ]
    # Each place has land and water within a texel.
    assert (np.max(near, axis=0) >= 0.0).all()
    assert (np.min(near, axis=0) < 0.0).all()


def test_groups_have_the_slope_of_the_dispersion_relation_and_the_pace_of_the_steepest_waves() -> None:
    depth = 5.0
    rates = [math.sqrt(GRAVITY * k * math.tanh(k * depth)) for k in (0.1999, 0.2001)]
    deep = 0.2 * math.tanh(0.2 * depth)
    speed = group_speed(ParametricWave(wavelength=2.0 * math.pi / deep), depth)
    assert speed == pytest.approx((rates[1] - rates[0]) / 0.0002, rel=1e-4)
    # Flat waves have none, and every quality draws the steepest wave.
    flat = ParametricWave(amplitude=0.0, wavelength=500.0)
    assert group_velocity(Scene(waves=(flat,))) == (0.0, 0.0)
    steep = ParametricWave(amplitude=0.4, wavelength=10.0, direction=0.3)
    waves = (ParametricWave(amplitude=0.5, wavelength=40.0), steep, flat)
    x, z = group_velocity(Scene(waves=waves))
    assert (math.hypot(x, z), math.atan2(z, x)) == pytest.approx((group_speed(steep, None), 0.3), abs=1e-5)
    assert group_velocity(Scene(waves=waves[1:])) == group_velocity(Scene(waves=waves))


THIN = air.Atmosphere(mie=0.01, haze=0.0)


def test_the_depth_is_the_sum_of_the_layers_overhead_and_chapmans_along_the_horizon() -> None:
    """Scale height times density at the sea, from the eye up; the tent of ozone has the area of 15 km."""
    molecules, haze = (math.exp(-air.EYE / scale) for scale in (air.RAYLEIGH_HEIGHT, air.MIE_HEIGHT))
    want = molecules * air.RAYLEIGH * 8.0 + haze * 0.01 * air.MIE_TINT + air.OZONE * 15.0
    np.testing.assert_allclose(THIN.depth(1.0), want, rtol=6e-3)
    # Of a thin isothermal layer the root of pi R / (2 H): the low haze has its depth along the horizon.
    low = air.Atmosphere(mie=0.0, haze=3.0)
    none = air.Atmosphere(mie=0.0, haze=0.0)
    got = np.array(low.depth(0.0)) - np.array(none.depth(0.0))
    seen = 3.0 * math.exp(-air.EYE / air.HAZE_HEIGHT)
    np.testing.assert_allclose(got / air.MIE_TINT, seen, rtol=0.03)


@pytest.mark.parametrize(("elevation", "most"), [(-0.1, 0.08), (-0.03, 0.07), (0.02, 0.05), (0.2, 0.03), (1.2, 0.03)])
def test_the_closed_form_is_the_integral(elevation: float, most: float) -> None:
    """Root mean square of the logarithm over the sky."""
    mie, haze = 0.07, 0.5
    d = np.random.default_rng(3).normal(size=(2000, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    d[:, 1] = np.abs(d[:, 1])
    height = math.sin(elevation)
    gain = skylight.adapted(height)
    red, green, blue = (power * gain for power in skylight.SUN_POWER)
    gamma = d[:, 0] * math.cos(elevation) + d[:, 1] * height
    smooth, hazy = skylight.atmosphere(mie, haze).sky(d[:, 1], gamma, height, 80)
    phase = ((1.0 - 0.76**2) / (4.0 * math.pi * (1.0 + 0.76**2 - 1.52 * gamma) ** 1.5))[:, None]
    want = np.array((red, green, blue)) * (smooth + hazy * phase) + np.array(skylight.NIGHT)
    of = skylight.glow(mie, haze, height, (red, green, blue), skylight.NIGHT)
    off = np.log(skylight.radiance(of, d[:, 1], d[:, 0], gamma, 0.76) / want)
    assert np.sqrt((off**2).mean()) <= most


def test_ozone_keeps_the_zenith_blue_and_the_belt_of_venus_stands_over_the_shadow_of_the_earth() -> None:
    up, gamma = np.array([1.0]), np.array([0.0])
    with_ozone = THIN.sky(up, gamma, 0.0)[0][0]
    assert with_ozone[2] > 1.5 * with_ozone[0]
    # Opposite the sun, 3 degrees after sunset: dark and blue at the horizon, brighter and redder above it.
    height, up = -0.05, np.array([0.0, 0.12])
    gamma = -np.sqrt(1.0 - up * up) * math.sqrt(1.0 - height * height) + up * height
    shadow, belt = THIN.sky(up, gamma, height)[0]
    assert belt[0] > 1.3 * shadow[0]
    assert belt[0] / belt[2] > shadow[0] / shadow[2]


def test_rock_is_wet_as_high_as_a_mean_drop_rises() -> None:
    shore, spray = Shore(kind="island", slope=0.9), Spray(speed=4.5, steep=0.0)
    speed = 0.65 * 0.7 * 0.625 * spray.speed * math.sqrt(GRAVITY * shore.surf.height / 0.3)
    height, step = 0.0, 1e-4
    while speed > 0.0:
        height += speed * step
        speed -= (GRAVITY + speed / 0.8) * step
    assert splash_height(shore, spray) == pytest.approx(height, rel=1e-3)
    assert splash_height(shore, None) == 0.0
    assert splash_height(shore, spray.model_copy(update={"steep": 2.0})) == 0.0
    assert splash_height(shore, spray.model_copy(update={"threshold": 100.0})) == 0.0
