"""Foam in float64: its looks and saturations, octaves of a mask, and how light scatters in it."""

import math

import numpy as np
import pytest

from seafoam.masks.catalogue import load_mask, mask_by_name
from seafoam.masks.prefilter import OCTAVE_RAMP, ramp_threshold
from seafoam.reference import Assets, sampling
from seafoam.reference.foam import coverage as looked
from seafoam.reference.foam import looks
from seafoam.reference.foam.front import (
    FRONT_CONSTANTS,
    front_saturation,
    front_saturation_filtered,
    group,
    seen_phases,
)
from seafoam.reference.light import light
from seafoam.reference.light.light import foam_layer
from seafoam.reference.renderer.sources import joined
from seafoam.reference.waves.parametric import wave_set
from seafoam.scene import Foam, FoamScattering, Light, ParametricWave, Scene

WAVE = ParametricWave(amplitude=0.8, wavelength=11.0, direction=0.4, exponent=2.0, phase=0.3)


@pytest.mark.parametrize(
    ("constants", "delta", "base", "spatial"),
    [("text", math.pi / 2, math.e, 2 * math.pi), ("listing", 1.07, 2.718, 6.28)],
)
def test_front_is_the_papers_formula(constants: str, delta: float, base: float, spatial: float) -> None:
    x = np.linspace(-40.0, 40.0, 3001)
    z = 0.2 * x
    time = 3.1
    k = FRONT_CONSTANTS[constants]
    at = group(wave_set(Scene(waves=(WAVE,)), time, (0.0, 0.0), k.spatial), x, z, k.delta)
    omega = math.sqrt(9.81 * 2.0 * math.pi / WAVE.wavelength)
    theta = omega * time - spatial / WAVE.wavelength * (x * math.cos(0.4) + z * math.sin(0.4)) + WAVE.phase
    away = np.abs(np.sin(0.5 * theta + delta + 0.5 * math.pi)) > 0.05
    literal = np.minimum(base ** (-np.tan(0.5 * theta[away] + delta)) / 4.0, 4.0)
    np.testing.assert_allclose(front_saturation(at.X, at.Y, 4.0, k.base)[away], literal, rtol=1e-9)
    assert np.count_nonzero(away) > 2800


@pytest.mark.parametrize("intensity", [0.25, 1.0, 4.0, 100.0])
def test_filtered_front_is_the_mean(intensity: float) -> None:
    rng = np.random.default_rng(6)
    psi = rng.uniform(-math.pi, math.pi, 60)
    psi[:4] = [0.0, 1e-3, -1e-3, math.pi]
    width = 10.0 ** rng.uniform(-2.0, 1.3, 60)
    count = 40_001
    inner = psi[:, None] + width[:, None] * ((np.arange(count) + 0.5) / count - 0.5)
    expected = np.minimum(front_saturation(np.cos(inner), np.sin(inner), intensity), 1.0).mean(axis=1)
    np.testing.assert_allclose(front_saturation_filtered(psi, width, intensity), expected, atol=2.0 / count)


@pytest.mark.parametrize("q", [0.01, 0.1, 0.3, 0.5, 0.7, 0.9])
@pytest.mark.parametrize("toward", [1.0, -1.0])
def test_seen_phases_are_those_before_the_eye(q: float, toward: float) -> None:
    """A sinusoid y = cos(psi)/k, looked at along x from far off by rays that fall by q of its slope."""
    psi = np.linspace(-math.pi, math.pi, 200_001)
    # Before the eye: nothing between a place and the eye rises above the ray; the nearest three waves can.
    nearer = toward * np.arange(0.0, 8.0 * math.pi, 1e-2)
    shown = np.array([(np.cos(at) + q * (np.abs(nearer)) >= np.cos(at - nearer) - 1e-9).all() for at in psi[::100]])
    arc = 2.0 * math.pi * shown.mean()
    sums = np.exp(1j * psi[::100][shown]).sum()
    middle = math.atan2(sums.imag, sums.real)
    one = np.ones(1)
    moved, width = seen_phases(0.3 * one, 50.0 * one, (toward * one, one), (q * one, one), 1.0, 0.0)
    assert float(width[0]) == pytest.approx(arc, rel=0.12)
    assert float(moved[0]) == pytest.approx(middle, abs=0.15)
    # A footprint of less than the arc stays as it is; from below, troughs are crests.
    narrow = seen_phases(0.3 * one, 0.9 * width, (toward * one, one), (q * one, one), 1.0, 0.0)
    np.testing.assert_array_equal(narrow, (0.3 * one, 0.9 * width))
    below = seen_phases(0.3 * one, 50.0 * one, (toward * one, one), (-q * one, one), 1.0, math.pi)
    np.testing.assert_allclose(below, (moved, width), atol=1e-12)


def test_joined() -> None:
    parts = [np.array([0.5, 3.0, 0.0]), np.array([2.0, 3.0, 9.0])]
    np.testing.assert_array_equal(joined(parts, "max", 4.0), [2.0, 3.0, 4.0])
    np.testing.assert_array_equal(joined(parts, "product", 4.0), [1.0, 4.0, 0.0])
    np.testing.assert_array_equal(joined(parts, "product", 1.0), [0.5, 1.0, 0.0])


MASK = mask_by_name("vac:1.5:64:5")


ASSETS = Assets.of(MASK, np.ones((1, 1)))


def covered(s: float, texels: float, fade: float | None, aspect: float = 0.6) -> np.ndarray:
    """A(s) of 20 000 footprints of the mask, as wide and as high as they are told."""
    u, v = np.random.default_rng(8).random((2, 20_000))
    foot_u, foot_v = np.full((u.size, 2), [texels / 64.0, 0.0]), np.full((u.size, 2), [0.0, aspect * texels / 64.0])
    return looked.covered(ASSETS, np.full(u.size, s), looked.MaskPoints(u, v, foot_u, foot_v), fade)


@pytest.mark.parametrize(("texels", "within"), [(0.5, 0.04), (1.0, 0.08), (2.0, 0.08), (4.0, 0.08), (8.0, 0.04)])
def test_filtered_coverage_is_the_share_of_the_footprint(texels: float, within: float) -> None:
    """Against 24 x 24 hard thresholds of the B-spline mask, at every scale the one limit; root mean square."""
    u, v = np.random.default_rng(8).random((2, 20_000))[:, :600]
    steps = (np.arange(24) + 0.5) / 24.0 - 0.5
    across, down = np.meshgrid(steps * texels / 64.0, steps * 0.6 * texels / 64.0)
    b = sampling.bspline(MASK.thresholds, (u[:, None] + across.ravel()).ravel(), (v[:, None] + down.ravel()).ravel())
    for s in (0.1, 0.4, 0.8):
        hard = looks.converged_coverage(np.full(b.value.size, s), b.value, MASK.filtering.quantiles[0], 0.0)
        errors = covered(s, texels, 0.0)[:600] - hard.reshape(600, -1).mean(axis=1)
        assert float(np.sqrt((errors**2).mean())) <= within


UP = np.array([[0.0, 1.0, 0.0]])


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


SIDE = 100
"""Places along each side of the tile, one in each square."""
NEEDLE = np.array([[1.0, 0.0], [0.3, 0.8]])


@pytest.fixture(scope="module")
def lace() -> Assets:
    return Assets.of(load_mask("lace"), np.ones((1, 1)))


def places(seed: int) -> np.ndarray:
    """(2, SIDE^2) places in [0, 1), jittered."""
    row, column = np.mgrid[:SIDE, :SIDE]
    jitter = np.random.default_rng(seed).random((2, SIDE, SIDE))
    return ((np.stack((column, row)) + jitter) / SIDE).reshape(2, -1)


def amount(
    assets: Assets, s: float, texels: float, octaves: int, at: np.ndarray | None = None, fade: float = 0.0
) -> np.ndarray:
    """Cover at places under footprints of so many texels; (places,)."""
    u, v = places(3) if at is None else at
    points = looked.MaskPoints(u, v, *(np.broadcast_to(side * texels / 512.0, (u.size, 2)) for side in NEEDLE))
    return looked.coverage(Foam(octaves=octaves, fade=fade), assets, np.full(u.size, s), points, filtering=True)


@pytest.mark.parametrize("texels", 2.0 ** np.arange(-6.0, 7.0, 2.0))
def test_the_cover_is_the_saturation_at_every_scale(lace: Assets, texels: float) -> None:
    for s in (0.02, 0.1, 0.3, 0.5, 0.75, 0.95):
        for octaves in (2, 4):
            # Within 0.002 over ten times as many places; so few scatter by 0.0015.
            assert amount(lace, s, texels, octaves).mean() == pytest.approx(s, abs=0.006)


@pytest.mark.parametrize("fade", [0.2, 0.6])
def test_octaves_cover_as_much_as_the_fade(lace: Assets, fade: float) -> None:
    for s in (0.1, 0.5, 1.0):
        share = s * s / (2.0 * fade) if s < fade else s - 0.5 * fade
        assert amount(lace, s, 0.1, 3, fade=fade).mean() == pytest.approx(share, abs=0.006)


def test_the_ramp_covers_the_saturation_of_even_thresholds() -> None:
    u = (np.arange(100_000) + 0.5) / 100_000
    for s in (0.0, 1e-3, 0.2, 0.3, 0.5, 0.7, 0.8, 0.999, 1.0):
        covered = np.clip((float(ramp_threshold(s)) - u) / OCTAVE_RAMP, 0.0, 1.0).mean()
        assert covered == pytest.approx(s, abs=1e-5)
    assert OCTAVE_RAMP == looks.OCTAVE_RAMP
