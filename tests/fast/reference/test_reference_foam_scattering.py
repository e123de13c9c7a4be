"""Foam as a layer of bubbles: limits, energy, and its glow against the sun."""

import math

import numpy as np
import pytest

from seafoam.reference.light import light
from seafoam.reference.light.light import foam_layer, lumpy_cosine
from seafoam.reference.types import unit
from seafoam.scene.foam import FoamScattering
from seafoam.scene.light import Light

UP = np.array([[0.0, 1.0, 0.0]])


def test_a_thick_smooth_layer_without_a_lobe_is_matt_foam() -> None:
    air = light.air(Light(sun_elevation=0.7))
    matt = FoamScattering(optical_depth=1000.0, roughness=0.0, forward=0.0)
    d = unit(np.array([[1.0, -0.5, 0.3]]))
    got, opacity = foam_layer(air, matt, 0.9, UP, d, np.ones(1))
    np.testing.assert_allclose(opacity, 1.0, atol=2e-3)
    np.testing.assert_allclose(got, opacity[:, None] * light.foam(air, 0.9, UP), rtol=1e-12)


@pytest.mark.parametrize("slope", [0.2, 0.7, 1.5])
def test_lumps_have_the_mean_cosine_of_gaussian_slopes(slope: float) -> None:
    """Mean of max(c + s g, 0) over a Gaussian g; the closed form is within 0.071 s of it."""
    g = np.linspace(-8.0, 8.0, 20001)
    weights = np.exp(-0.5 * g * g)
    weights /= weights.sum()
    for c in (-0.6, -0.1, 0.0, 0.1, 0.5, 1.0):
        want = float((np.maximum(c + slope * g, 0.0) * weights).sum())
        assert abs(float(lumpy_cosine(np.array([c]), slope)[0]) - want) <= 0.071 * slope
        if c == 0.0:
            assert float(lumpy_cosine(np.array([c]), slope)[0]) == pytest.approx(want, rel=1e-5)


@pytest.mark.parametrize("elevation", [0.02, 0.1, 0.4, 1.5])
@pytest.mark.parametrize("forward", [0.0, 0.6, 1.0])
def test_smooth_foam_sends_back_no_more_than_arrives(elevation: float, forward: float) -> None:
    """Flux of the reflected sunlight over the hemisphere, by the midpoint rule in cosine and azimuth."""
    air = light.air(Light(sun_elevation=elevation))
    scattering = FoamScattering(optical_depth=1000.0, roughness=0.0, forward=forward)
    mu = (np.arange(400) + 0.5) / 400
    turn = (np.arange(720) + 0.5) * (2.0 * math.pi / 720)
    level = np.sqrt(1.0 - mu * mu)
    out = np.stack(
        (np.outer(level, np.cos(turn)), np.repeat(mu[:, None], 720, axis=1), np.outer(level, np.sin(turn))), -1
    ).reshape(-1, 3)
    n = np.broadcast_to(UP, out.shape)
    whole, _ = foam_layer(air, scattering, 1.0, n, -out, np.ones(len(out)))
    dark, _ = foam_layer(air, scattering, 1.0, n, -out, np.ones(len(out)), np.zeros(len(out)))
    flux = ((whole - dark) * out[:, 1:2]).mean(axis=0) * 2.0 * math.pi
    arrives = air.sun_irradiance * math.sin(elevation)
    assert (flux <= 1.001 * arrives).all()
    assert (flux > 0.01 * arrives).all()


def test_foam_before_a_low_sun_is_brighter_than_foam_after_it() -> None:
    air = light.air(Light(sun_elevation=0.15, sun_azimuth=0.0))
    toward, away = (unit(np.array([[x, -0.15, 0.0]])) for x in (1.0, -1.0))
    glow, _ = foam_layer(air, FoamScattering(), 0.9, UP, toward, np.ones(1))
    plain, _ = foam_layer(air, FoamScattering(), 0.9, UP, away, np.ones(1))
    assert (glow > 2.0 * plain).all()
