"""Waves, wakes and boats in float64."""

import math

import numpy as np
import pytest

from seafoam.ocean.waves.wakes import Wake
from seafoam.reference.boats import wake as wakes_of
from seafoam.reference.renderer import intersect
from seafoam.reference.waves.parametric import reduced, ripple_set, wave_set, wavenumber
from seafoam.scene import Boat, ParametricWave, Ripples, Scene
from support.scenes.fleet import WAKES, around

SEA = Scene(
    waves=tuple(
        ParametricWave(amplitude=a, wavelength=length, direction=heading, exponent=K, phase=phase)
        for a, length, heading, K, phase in (
            (0.7, 22.0, 0.2, 2.0, 0.0),
            (0.4, 13.0, -0.4, 2.5, 1.0),
            (0.25, 7.5, 0.9, 2.0, 2.0),
            (0.15, 4.6, -0.9, 1.6, 3.0),
        )
    )
)


def directions(rng: np.random.Generator, count: int, low: float, high: float) -> np.ndarray:
    """Unit vectors (count, 3) whose elevation is even in [low, high] rad."""
    azimuth, elevation = rng.uniform(0.0, 2.0 * math.pi, count), rng.uniform(low, high, count)
    level = np.cos(elevation)
    return np.stack((level * np.cos(azimuth), np.sin(elevation), level * np.sin(azimuth)), axis=-1)


@pytest.mark.parametrize("depth", [0.05, 1.0, 30.0, 11000.0])
@pytest.mark.parametrize("wavelength", [0.05, 12.0, 2000.0])
def test_dispersion(wavelength: float, depth: float) -> None:
    k = wavenumber(wavelength, depth)
    assert k * math.tanh(k * depth) == pytest.approx(2.0 * math.pi / wavelength, rel=1e-12)


def test_reduction_is_exact_for_far_times() -> None:
    # 2²⁰ turns of a rounded 2π differ from whole turns by 2²⁰ times its rounding, far below one float of the product.
    tau_error = 2.4492935982947064e-16
    assert reduced((2.0 * math.pi, 2.0**20)) == pytest.approx(2.0 * math.pi - 2.0**20 * tau_error, abs=1e-15)


def test_ripples_have_the_slope_asked_for() -> None:
    rng = np.random.default_rng(0)
    c_x, c_z = ripple_set(Ripples(slope=0.2), 1.0, (0.0, 0.0)).gradient(*rng.uniform(-1e4, 1e4, (2, 200_000)))
    # Ripples that share a wavenumber add up in phase, so the mean square is near what was asked for, not exact.
    assert np.mean(c_x**2 + c_z**2) == pytest.approx(0.04, rel=0.1)


@pytest.mark.parametrize("K", [0.1, 0.5, 1.0, 2.0, 100.0])
def test_crossings_lie_on_the_surface(K: float) -> None:
    waves = wave_set(Scene(waves=(ParametricWave(amplitude=1.3, wavelength=9.0, exponent=K),)), 1.0, (0.0, 0.0))
    d = directions(np.random.default_rng(2), 4000, -1.57, -0.02)
    s = intersect.first_crossing(waves, 2.5, d)
    assert np.isfinite(s).all()
    residual = 2.5 + d[:, 1] * s - waves.height(d[:, 0] * s, d[:, 2] * s)
    assert np.abs(residual).max() < 1e-9


@pytest.mark.parametrize("eye_y", [6.0, 1.2, 0.3, -2.0])
def test_crossings_are_the_first(eye_y: float) -> None:
    waves = wave_set(SEA, 2.7, (0.0, 0.0))
    rng = np.random.default_rng(3)
    d = directions(rng, 40, -0.25, -0.02) if eye_y > 0.0 else directions(rng, 40, 0.02, 0.25)
    s = intersect.first_crossing(waves, eye_y, d)
    start = max(eye_y - waves.bounds.top, 0.0, waves.bounds.trough - eye_y)
    for i in range(d.shape[0]):
        low = start / abs(d[i, 1])
        along = np.linspace(low, min(s[i], low + 200.0), 40_000)[1:-1]
        G = eye_y + d[i, 1] * along - waves.height(d[i, 0] * along, d[i, 2] * along)
        assert (G > 0.0).all() or (G < 0.0).all()


@pytest.mark.parametrize("boat", WAKES, ids=lambda boat: f"{boat.speed:g} m/s")
def test_wakes_stay_within_their_bounds_and_slope_as_they_rise(boat: Boat) -> None:
    x, z = around(boat, 1, 40000)
    wake = wakes_of.wake_set(Scene(boats=(boat,)), 0.0, (0.0, 0.0))
    height, slope, step = wake.height(x, z), wake.gradient(x, z), 1e-6
    assert np.ptp(height) > 0.3 * boat.wake
    assert (np.abs(height) <= Wake(boat).height).all()
    assert np.hypot(*slope).max() <= Wake(boat).max_slope
    numeric = (
        (wake.height(x + step, z) - wake.height(x - step, z)) / (2.0 * step),
        (wake.height(x, z + step) - wake.height(x, z - step)) / (2.0 * step),
    )
    assert max(float(np.abs(a - b).max()) for a, b in zip(slope, numeric, strict=True)) < 1e-6


def test_a_wake_is_kelvins() -> None:
    """Waves across run as fast as the boat: behind it they stand 2 pi v^2/g apart; all lie inside 19.47 degrees."""
    boat = Boat(speed=4.0, length=3.0, radius=2000.0)
    wake = Wake(boat)
    x = np.linspace(3.0 * wake.wavelength, 5.0 * wake.wavelength, 4001)
    height = wakes_of.pattern(wake, x, np.zeros_like(x))[0]
    crests = x[1:-1][(height[1:-1] > height[:-2]) & (height[1:-1] > height[2:])]
    assert np.diff(crests) == pytest.approx(2.0 * math.pi * 16.0 / 9.81, rel=0.01)
    outside = wakes_of.pattern(wake, x, x * math.tan(math.asin(1.0 / 3.0)) * 1.0001)[0]
    assert (outside == 0.0).all()


def test_a_wider_boat_than_its_circle_is_refused() -> None:
    with pytest.raises(ValueError, match="radius"):
        Boat(length=20.0, radius=10.0)
