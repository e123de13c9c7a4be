"""The integral of the clear sky and its closed form, which effects and reference share."""

import math

import numpy as np
import pytest

from seafoam.ocean.sky import air, skylight

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


@pytest.mark.parametrize("elevation", [-0.08, 0.03, 0.5])
def test_more_steps_change_the_integral_little(elevation: float) -> None:
    up, gamma = np.array([0.0, 0.1, 1.0]), np.array([0.4, 0.4, math.sin(elevation)])
    for coarse, fine in zip(
        THIN.sky(up, gamma, math.sin(elevation)), THIN.sky(up, gamma, math.sin(elevation), 160), strict=True
    ):
        np.testing.assert_allclose(coarse, fine, rtol=0.05, atol=1e-7)


@pytest.mark.parametrize(("elevation", "most"), [(-0.1, 0.08), (-0.03, 0.07), (0.02, 0.05), (0.2, 0.03), (1.2, 0.03)])
@pytest.mark.parametrize(("mie", "haze"), [(0.03, 0.5), (0.07, 0.5)])
def test_the_closed_form_is_the_integral(elevation: float, most: float, mie: float, haze: float) -> None:
    """Root mean square of the logarithm over the sky."""
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
