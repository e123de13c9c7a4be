"""Saturations, reading images, and the looks."""

import math

import numpy as np
import pytest

from seafoam.masks.catalogue import mask_by_name
from seafoam.reference import Assets, sampling
from seafoam.reference.foam import coverage as looked
from seafoam.reference.foam import looks
from seafoam.reference.foam.front import (
    CAP,
    FRONT_CONSTANTS,
    front_integral,
    front_saturation,
    front_saturation_filtered,
    gate,
    group,
    phase_gradient,
    phase_width,
    seen_phases,
)
from seafoam.reference.renderer.sources import front_source, height_saturation, joined
from seafoam.reference.types import SurfacePoints
from seafoam.reference.waves.parametric import wave_set
from seafoam.scene.foam import FrontSaturation
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave

WAVE = ParametricWave(amplitude=0.8, wavelength=11.0, direction=0.4, exponent=2.0, phase=0.3)
EVEN = np.linspace(0.0, 1.0, sampling.QUANTILE_ENTRIES)


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


def test_front_at_and_around_the_pole() -> None:
    X = np.array([1.0, 1.0, 1.0, -1.0, 0.0, -1.0])
    Y = np.array([0.0, 1e-9, -1e-9, 0.0, 0.0, -0.0])
    np.testing.assert_allclose(front_saturation(X, Y, 4.0), [4.0, 4.0, 0.0, 0.25, 0.25, 0.25], atol=1e-30)


def test_equal_waves_front_as_one() -> None:
    x, z = np.linspace(-20.0, 20.0, 200), np.linspace(0.0, 5.0, 200)
    one = group(wave_set(Scene(waves=(WAVE,)), 2.0, (0.0, 0.0)), x, z, 1.07)
    three = group(wave_set(Scene(waves=(WAVE,) * 3), 2.0, (0.0, 0.0)), x, z, 1.07)
    for name in ("X", "Y", "slope_of_x", "slope_of_y", "rho"):
        np.testing.assert_allclose(getattr(three, name), getattr(one, name), atol=1e-13)
    np.testing.assert_allclose(one.rho, 1.0, atol=1e-14)


def test_flat_waves_weigh_the_same() -> None:
    flat = WAVE.model_copy(update={"amplitude": 0.0})
    x = np.linspace(0.0, 9.0, 50)
    one = group(wave_set(Scene(waves=(WAVE,)), 2.0, (0.0, 0.0)), x, x, 1.0)
    two = group(wave_set(Scene(waves=(flat, flat)), 2.0, (0.0, 0.0)), x, x, 1.0)
    np.testing.assert_allclose(two.X, one.X, atol=1e-14)


def test_without_waves_there_is_no_front() -> None:
    x = np.zeros(3)
    waves = wave_set(Scene(), 2.0, (0.0, 0.0))
    f = front_source(FrontSaturation(), waves, SurfacePoints(x, x, x, None, 4.0, 2.0, (0.0, 0.0)), 2.0)
    np.testing.assert_array_equal(f, 0.0)


def test_phase_width_is_the_phase_over_the_footprint() -> None:
    other = ParametricWave(amplitude=0.3, wavelength=7.0, direction=-1.0)
    waves = wave_set(Scene(waves=(WAVE, other)), 2.0, (0.0, 0.0))
    x, z, step = np.linspace(-20.0, 20.0, 99), np.linspace(3.0, -8.0, 99), 1e-6

    def psi(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        at = group(waves, x, z, 1.2)
        return np.arctan2(at.Y, at.X)

    gradient = phase_gradient(group(waves, x, z, 1.2))
    width = phase_width(gradient, (np.full((99, 2), [step, 0.0]), np.full((99, 2), [0.0, 2.0 * step])))
    turn = 2.0 * math.pi
    along_x = np.abs(np.remainder(psi(x + step, z) - psi(x, z) + math.pi, turn) - math.pi)
    along_z = np.abs(np.remainder(psi(x, z + 2.0 * step) - psi(x, z) + math.pi, turn) - math.pi)
    np.testing.assert_allclose(width, along_x + along_z, rtol=1e-4)


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


def test_all_phases_are_seen_from_above() -> None:
    psi, width = np.linspace(-3.0, 3.0, 50), np.geomspace(1e-3, 1e3, 50)
    one = np.ones(50)
    for q in (1.0, 1.5, 1e30):
        seen = seen_phases(psi, width, (one, one), (q * one, one), 1.0, 0.0)
        np.testing.assert_allclose(seen, (psi, width), rtol=1e-12)
    # No relief, no way, no eye above: finite, and no wider than before.
    for relief, away, over in ((0.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0)):
        moved, seen = seen_phases(psi, width, (one, one), (over * one, away * one), relief, 0.0)
        assert np.isfinite(moved).all()
        assert (seen <= width).all()


def test_sharp_filtered_front_is_the_front() -> None:
    psi = np.linspace(-3.1, 3.1, 500)
    sharp = np.minimum(front_saturation(np.cos(psi), np.sin(psi), 4.0), 1.0)
    for width in (0.0, 1e-9, 2e-6):
        filtered = front_saturation_filtered(psi, np.full(500, width), 4.0)
        np.testing.assert_allclose(filtered, sharp, atol=1e-5)
    jump = front_saturation_filtered(np.array([-2.5e-8, 0.0, 2.5e-8]), np.full(3, 1e-7), 4.0)
    np.testing.assert_allclose(jump, [0.25, 0.5, 0.75], atol=1e-9)


def test_front_integral_starts_full() -> None:
    full = 2.0 * math.atan2(1.0, math.log(4.0))
    np.testing.assert_allclose(front_integral(4.0)(np.array([0.0, 0.5, full])), [0.0, 0.5, full], atol=1e-14)


def test_gate() -> None:
    rho = np.array([0.0, 0.2, 0.4, 0.6, 1.0])
    np.testing.assert_array_equal(gate(rho, (0.0, 0.0)), 1.0)
    np.testing.assert_allclose(gate(rho, (0.2, 0.6)), [0.0, 0.0, 0.5, 1.0, 1.0], atol=1e-15)
    np.testing.assert_allclose(gate(rho, (0.4, 0.4)), [0.0, 0.0, 0.0, 1.0, 1.0])


def test_height_saturation() -> None:
    H = np.array([-5.0, 0.3, 0.6, 0.9, 99.0])
    np.testing.assert_allclose(height_saturation(H, 0.3, 0.9), [0.0, 0.0, 0.5, 1.0, CAP], atol=1e-15)


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


@pytest.mark.parametrize("fade", [0.0, 0.2])
@pytest.mark.parametrize("texels", [0.2, 1.0, 1.2, 2.0, 2.8, 7.0, 40.0])
def test_filtered_coverage_is_the_saturation_on_average(texels: float, fade: float) -> None:
    for s in (0.15, 0.5, 0.8):
        A = covered(s, texels, fade)
        assert (A >= 0.0).all()
        assert (A <= 1.0).all()
        # The ramp of a fade ends at s, not around it: half a width is lost, at most.
        assert A.mean() == pytest.approx(s * s / (2.0 * fade) if s < fade else s - 0.5 * fade, abs=0.035)


@pytest.mark.parametrize("fade", [0.0, None])
@pytest.mark.parametrize("texels", [1e-9, 0.7, 1.0, 1.3, 9.0, 1e4])
def test_filtered_coverage_ends_exactly(texels: float, fade: float | None) -> None:
    np.testing.assert_array_equal(covered(0.0, texels, fade), 0.0)
    np.testing.assert_array_equal(covered(1.0, texels, fade), 1.0)


@pytest.mark.parametrize(("texels", "within"), [(0.5, 0.04), (1.0, 0.08), (2.0, 0.08), (4.0, 0.08), (8.0, 0.04)])
def test_filtered_coverage_is_the_share_of_the_footprint(texels: float, within: float) -> None:
    """Against 24 x 24 hard thresholds of the B-spline mask, at every scale the one limit; root mean square."""
    u, v = np.random.default_rng(8).random((2, 20_000))[:, :600]
    steps = (np.arange(24) + 0.5) / 24.0 - 0.5
    across, down = np.meshgrid(steps * texels / 64.0, steps * 0.6 * texels / 64.0)
    b = sampling.bspline(MASK.thresholds, (u[:, None] + across.ravel()).ravel(), (v[:, None] + down.ravel()).ravel())
    for s in (0.1, 0.4, 0.8):
        hard = looks.converged_coverage(np.full(b.value.size, s), b.value, MASK.quantiles[0], 0.0)
        errors = covered(s, texels, 0.0)[:600] - hard.reshape(600, -1).mean(axis=1)
        assert float(np.sqrt((errors**2).mean())) <= within


def test_levels_follow_one_another_without_a_step() -> None:
    for texels in (3.0, 6.0, 12.0):
        before, after = (covered(0.4, texels * scale, 0.0) for scale in (1.0 - 1e-7, 1.0 + 1e-7))
        np.testing.assert_allclose(before, after, atol=1e-4)


def test_magnified_coverage_is_the_hard_threshold() -> None:
    rng = np.random.default_rng(10)
    b = rng.uniform(0.0, 1.0, 500)
    s = rng.uniform(0.05, 0.95, 500)
    clear = np.abs(sampling.quantile(EVEN, s) - b) > 1e-3
    sharp = looks.magnified_coverage(b, np.zeros(500), sampling.quantile(EVEN, s), np.zeros(500))
    np.testing.assert_allclose(sharp[clear], looks.converged_coverage(s, b, EVEN, 0.0)[clear], atol=1e-12)


def test_quantile_is_exact_at_its_entries() -> None:
    i = np.arange(sampling.QUANTILE_ENTRIES)
    position = i / (sampling.QUANTILE_ENTRIES - 1)
    s = np.where(position <= 0.5, 2.0 * position**2, 1.0 - 2.0 * (1.0 - position) ** 2)
    table = np.sort(np.random.default_rng(11).random(sampling.QUANTILE_ENTRIES))
    np.testing.assert_allclose(sampling.quantile(table, s), table, atol=1e-12)


def test_texel_centres() -> None:
    image = np.random.default_rng(12).random((8, 8))
    column, row = np.meshgrid(np.arange(8), np.arange(8))
    u, v = ((column + 0.5) / 8 - 3.0).ravel(), ((row + 0.5) / 8 + 5.0).ravel()
    np.testing.assert_allclose(sampling.bilinear(image, u, v), image.ravel(), atol=1e-13)
    np.testing.assert_array_equal(sampling.nearest(image, u, v), image.ravel())


def test_trilinear_blends_levels() -> None:
    chain = sampling.box_chain(np.random.default_rng(13).random((16, 16)))
    u, v = np.random.default_rng(14).random((2, 300))
    level = np.full(300, 1.25)
    expected = 0.75 * sampling.bilinear(chain[1], u, v) + 0.25 * sampling.bilinear(chain[2], u, v)
    np.testing.assert_allclose(sampling.trilinear(chain, u, v, level), expected, atol=1e-14)
    np.testing.assert_allclose(sampling.trilinear(chain, u, v, level + 50.0), chain[0].mean(), atol=1e-14)
    np.testing.assert_allclose(sampling.trilinear(chain, u, v, level - 50.0), sampling.bilinear(chain[0], u, v))


def test_bspline_of_a_ramp_is_the_ramp() -> None:
    ramp = np.arange(32.0)[None, :] + 2.0 * np.arange(32.0)[:, None]
    u, v = np.random.default_rng(15).uniform(0.2, 0.8, (2, 200))
    spline = sampling.bspline(ramp, u, v)
    np.testing.assert_allclose(spline.value, (32.0 * u - 0.5) + 2.0 * (32.0 * v - 0.5), atol=1e-12)
    np.testing.assert_allclose(spline.u, 32.0, atol=1e-10)
    np.testing.assert_allclose(spline.v, 64.0, atol=1e-10)
    for second in (spline.uu, spline.vv, spline.uv):
        np.testing.assert_allclose(second, 0.0, atol=1e-9)


def test_bspline_derivatives() -> None:
    image = np.random.default_rng(16).random((16, 16))
    u, v = np.random.default_rng(17).uniform(-2.0, 2.0, (2, 200))
    step = 1e-6
    spline = sampling.bspline(image, u, v)
    for first, second, cross, du, dv in (
        (spline.u, spline.uu, spline.uv, step, 0.0),
        (spline.v, spline.vv, spline.uv, 0.0, step),
    ):
        after, before = sampling.bspline(image, u + du, v + dv), sampling.bspline(image, u - du, v - dv)
        np.testing.assert_allclose(first, (after.value - before.value) / (2 * step), atol=1e-6)
        along, other = (
            ((after.u - before.u), (after.v - before.v)) if du else ((after.v - before.v), (after.u - before.u))
        )
        np.testing.assert_allclose(second, along / (2 * step), atol=1e-3)
        np.testing.assert_allclose(cross, other / (2 * step), atol=1e-3)


def test_spline_over_a_footprint_is_the_mean_there() -> None:
    image = np.random.default_rng(18).random((16, 16))
    u, v = np.random.default_rng(19).uniform(0.0, 1.0, (2, 50))
    side = np.column_stack([np.full(50, 0.2 / 16), np.full(50, 0.05 / 16)])
    other = np.column_stack([np.full(50, -0.03 / 16), np.full(50, 0.15 / 16)])
    mean, half = looks.spline_over_footprint(sampling.bspline(image, u, v), side, other)
    offsets = (np.arange(12) + 0.5) / 12 - 0.5
    values = np.stack(
        [
            sampling.bspline(image, u + a * side[:, 0] + b * other[:, 0], v + a * side[:, 1] + b * other[:, 1]).value
            for a in offsets
            for b in offsets
        ]
    )
    np.testing.assert_allclose(mean, values.mean(axis=0), atol=1e-4)
    np.testing.assert_allclose(half, np.sqrt(3.0) * values.std(axis=0), atol=2e-3)
