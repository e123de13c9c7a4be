"""Saturations, reading images, and the looks."""

import math

import numpy as np
import pytest

from seafoam.masks.catalogue import mask_by_name
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
from seafoam.reference.renderer.sources import joined
from seafoam.reference.waves.parametric import wave_set
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave

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


def test_looks_are_the_papers_equations() -> None:
    rng = np.random.default_rng(7)
    f, m, t = rng.uniform(0.0, 4.0, 999), rng.uniform(0.0, 1.0, 999), rng.uniform(0.0, 1.0, 999)
    got = (
        looks.textured(f, t),
        looks.halftone(f, m),
        looks.fading(f, m),
        looks.halftone_textured(f, m, t),
        looks.listing(f, m, t),
    )
    for i in range(999):
        over = f[i] > m[i]
        half = min(max(f[i] / 2.0 - m[i], 0.0), 1.0) if over else 0.0
        expected = (
            min(f[i], 1.0) * t[i],
            1.0 if over else 0.0,
            half,
            half * t[i],
            min(max(f[i] - m[i], 0.15), 3.0) * t[i] if over else 0.0,
        )
        assert tuple(float(a[i]) for a in got) == pytest.approx(expected)


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
