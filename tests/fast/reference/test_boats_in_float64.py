"""Boats and wakes in float64 and in plans: smoothing, bounds, Kelvin's angle, what a scene without boats has."""

import math

import numpy as np
import pytest

from seafoam.effects.foam.wake_foam import wake_limit
from seafoam.ocean.waves.wakes import Wake
from seafoam.reference.boats import floating
from seafoam.reference.boats import wake as wakes_of
from seafoam.reference.boats.floating import FORMS
from seafoam.scene.boats import Boat
from seafoam.scene.foam import Foam, WakeSaturation
from seafoam.scene.models import Scene
from support.scenes.fleet import WAKES, around


def test_smoothing_is_the_mean_over_a_disc() -> None:
    """Radon's seven points against 2 J1(kR)/(kR), the mean of a wave over a disc: exact to the fifth degree."""
    for k_r, allowed in ((0.5, 1e-5), (1.0, 4e-4), (2.0, 0.03)):
        reach = 1.5
        k = k_r / reach
        turns = np.linspace(0.0, math.pi, 20001)
        bessel = np.trapezoid(np.cos(turns - k_r * np.sin(turns)), turns) / math.pi
        for heading in (0.0, 0.3, 0.5):
            wave = floating.mean_height(
                lambda x, z, h=heading, n=k: np.cos(n * (x * math.cos(h) + z * math.sin(h))), (0.0, 0.0), reach
            )
            assert abs(wave - 2.0 * bessel / k_r) <= allowed


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


def test_white_water_lies_along_a_moving_hull_alone() -> None:
    """Beside the drawn water line, at the bow densest, aft widest; none at rest, none a beam away; within its limit."""
    boat = Boat(length=10.0, speed=4.0, heel=0.0, radius=200.0)
    at = floating.course_of(boat, 0.0, (0.0, 0.0))
    source = WakeSaturation(amount=0.0, bow=0.0, contact=1.0)
    form = FORMS["sail"]
    for ahead, low, high in ((0.35, 0.01, 0.05), (0.0, 0.02, 0.09), (-0.4, 0.03, 0.12)):
        half = form.beam - form.fine * (ahead + 0.12) ** 2 - form.flare * form.widest**2
        out = np.linspace(0.0, 0.4, 4001)
        x = at.place[0] + 10.0 * (ahead * at.heading[0] - (half + out) * at.heading[1])
        z = at.place[1] + 10.0 * (ahead * at.heading[1] + (half + out) * at.heading[0])
        band = wakes_of.contact(boat, at, x, z, np.full_like(x, 0.5), None)
        assert band[0] == band.max() > 0.2
        assert low < float(np.interp(0.5, (1.0 - band / band[0]), out)) < high
        assert (band[out > 0.15] == 0.0).all()
    scene = Scene(boats=(boat,), foam=Foam(saturation=(source,)))
    x, z = around(boat, 3, 40000)
    assert (
        0.1 < wakes_of.wake_set(scene, 0.0, (0.0, 0.0)).foam(source, x, z, 4.0, None).max() <= wake_limit(source, scene)
    )
    still = scene.model_copy(update={"boats": (boat.model_copy(update={"speed": 0.0}),)})
    assert (wakes_of.wake_set(still, 0.0, (0.0, 0.0)).foam(source, x, z, 4.0, None) == 0.0).all()
    assert wake_limit(source, still) == 0.0
