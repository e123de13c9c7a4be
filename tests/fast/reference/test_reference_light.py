"""Sun, sky, water and the picture's curves."""

import math

import numpy as np
import pytest

from seafoam.reference.light import display, light
from seafoam.reference.types import unit
from seafoam.scene.light import Light, Sky
from seafoam.scene.water import Water

ELEVATIONS = [-1.57, -0.05, 0.0, 0.01, 0.6, 1.5707]


def sphere(count: int, seed: int = 0) -> np.ndarray:
    """Unit vectors (count, 3), even over the sphere."""
    return unit(np.random.default_rng(seed).standard_normal((count, 3)))


def test_sky_is_the_pages_formula() -> None:
    y, up, gamma = 0.3, 0.2, 0.5
    of = Light(sun_elevation=math.asin(y), turbidity=2.0)
    level, sun_level = math.sqrt(1.0 - up * up), math.sqrt(1.0 - y * y)
    turn = math.acos((gamma - up * y) / (level * sun_level))
    got = light.air(of).sky(np.array([level * math.cos(turn), up, level * math.sin(turn)]))
    for channel, rayleigh in enumerate((0.055, 0.108, 0.215)):
        mie = 0.05
        tau = rayleigh + mie
        in_air = 20.0 * math.exp(-0.5 * tau / (y + 0.03)) + 0.002
        phase = rayleigh * 3.0 / (16.0 * math.pi) * (1.0 + gamma**2)
        phase += mie * (1.0 - 0.76**2) / (4.0 * math.pi * (1.0 + 0.76**2 - 1.52 * gamma) ** 1.5)
        expected = in_air * (phase / tau + 0.04) * (1.0 - math.exp(-tau / (up + 0.09)))
        assert got[channel] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("elevation", ELEVATIONS)
def test_sky_irradiance_is_the_mean_of_random_directions(elevation: float) -> None:
    air = light.air(Light(sun_elevation=elevation, turbidity=3.0))
    d = sphere(400_000, 3)
    d[:, 1] = np.abs(d[:, 1])
    expected = 2.0 * math.pi * (air.sky(d) * d[:, 1:2]).mean(axis=0)
    np.testing.assert_allclose(air.sky_irradiance, expected, rtol=0.01)


def test_fresnel_is_the_mean_of_both_polarisations() -> None:
    c = np.linspace(0.01, 1.0, 100)
    inner = np.sqrt(1.0 - (1.0 - c * c) / 1.34**2)
    across, along = (c - 1.34 * inner) / (c + 1.34 * inner), (1.34 * c - inner) / (1.34 * c + inner)
    np.testing.assert_allclose(light.fresnel(c), 0.5 * (across**2 + along**2), rtol=1e-12)


def test_tone_rises_from_black_to_white() -> None:
    x = np.linspace(0.0, 40.0, 5000)
    y = display.tone(x)
    assert y[0] == 0.0
    assert y[-1] == 1.0
    assert (np.diff(y) >= 0.0).all()
    shown = display.srgb(np.array([0.0, 0.0031308, 0.5, 1.0]))
    np.testing.assert_allclose(shown, [0.0, 0.04045, 0.7354, 1.0], atol=1e-4)


def test_disc_is_where_the_sun_is() -> None:
    air = light.air(Light(sun_elevation=0.5, sun_azimuth=1.0))
    np.testing.assert_allclose(light.sun_disc(air, air.sun), np.minimum(air.sun_irradiance / 6.8e-5, 3000.0))
    np.testing.assert_array_equal(light.sun_disc(air, unit(air.sun + np.array([0.02, 0.0, 0.0]))), 0.0)
    assert (light.sun_disc(light.air(Light(sun_elevation=-0.1)), air.sun) == 0.0).all()


def test_haze_ends_in_the_sky_at_the_horizon() -> None:
    air, d = light.air(Light()), sphere(100, 5)
    d[0] = [0.0, -1.0, 0.0]
    L = np.full((100, 3), 0.3)
    np.testing.assert_allclose(light.haze(air, 1000.0, L, d, np.zeros(100)), L)
    far = light.haze(air, 1000.0, L, d, np.full(100, 1e9))
    np.testing.assert_allclose(far[1:], air.sky(unit(d[1:] * [1.0, 0.0, 1.0])))
    seen = light.haze(air, 1000.0, np.zeros((100, 3)), d, np.full(100, 1000.0))
    np.testing.assert_allclose(seen / far, 0.98, atol=1e-3)


def test_haze_before_a_low_sun_does_not_glow_at_ones_feet() -> None:
    """A layered sky: at the horizon haze is the sky's light; under the sun, but steeply down, half of that at most."""
    air = light.air(Light(sun_azimuth=0.0, sun_elevation=0.05, sky=Sky()))
    y = np.array([0.0, -0.2, -0.5, -0.8])
    d = np.stack((np.sqrt(1.0 - y * y), y, np.zeros(4)), axis=-1)
    seen = light.haze(air, 1000.0, np.zeros((4, 3)), d, np.full(4, 1e9))
    np.testing.assert_allclose(seen[0], air.sky(d[:1])[0], rtol=1e-12)
    assert (np.diff(seen, axis=0) < 0.0).all()
    assert (seen[2] < 0.5 * seen[0]).all()


def test_an_endless_plume_is_water_that_scatters_as_much() -> None:
    d = unit(np.array([[0.6, -0.5, 0.2], [0.0, -1.0, 0.0]]))
    n = np.tile((0.0, 1.0, 0.0), (2, 1))
    plume = Water(aeration=0.2, plume_depth=20.0, scattering=0.1)
    hit = light.WaterHit(d, n, np.zeros(2), (0.0, 0.0), saturation=np.ones(2))
    got, want = (light.water(light.air(Light()), body, hit) for body in (plume, Water(scattering=0.3)))
    np.testing.assert_allclose(got, want, rtol=1e-4)
