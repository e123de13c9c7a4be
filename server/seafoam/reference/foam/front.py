"""Section 4: foam of fronts, at a point, averaged over a footprint, and left behind by past fronts."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from seafoam.reference.noise import fractal
from seafoam.reference.types import Floats, Pair, SurfacePoints, Vec2, smoothstep
from seafoam.reference.waves.parametric import WaveSet, noise_place
from seafoam.scene import FrontSaturation

TURN = 2.0 * math.pi
CAP = 4.0
EXPONENT = 80.0
CELLS = 16384  # cells of the tabulated integral, interpolated by cubics: error below 10⁻¹²
LISTING_SPATIAL = 6.28 / (2.0 * math.pi)  # factor of the wavenumbers in the published code
GATE_LEAST = 1e-4
LEAST_RATE = 1e-3  # least mean frequency of the waves for drifting water, rad/s
GROUP_LEAST = 1e-4  # least ρ² in ∇ψ
PATCH_OCTAVES, PATCH_SEED, PATCH_CHANGE = 3, 64 * 91, 25.0
"""Octaves of the noise of patches, its seed, and the time in which it changes, s."""


@dataclass(frozen=True)
class FrontConstants:
    """δ (rad), the base E and the factor of the wavenumbers."""

    delta: float
    base: float
    spatial: float


FRONT_CONSTANTS: dict[Literal["text", "listing"], FrontConstants] = {
    "text": FrontConstants(math.pi / 2.0, math.e, 1.0),
    "listing": FrontConstants(1.07, 2.718, LISTING_SPATIAL),
}


@dataclass(frozen=True)
class Group:
    """The waves' sum as an analytic signal at r places: ρ e^{iψ} = X + iY, and the gradients of X and Y, (r, 2)."""

    X: Floats
    Y: Floats
    slope_of_x: Floats
    slope_of_y: Floats

    @property
    def rho(self) -> Floats:
        """Length of the sum, in [0, 1]."""
        return np.hypot(self.X, self.Y)


def group_weights(waves: WaveSet) -> Floats:
    """Each wave's amplitude over the sum of all amplitudes, equal weights if that sum is 0; (waves,)."""
    total, count = float(waves.amplitude.sum()), waves.amplitude.size
    return waves.amplitude / total if total > 0.0 else np.full(count, 1.0 / max(count, 1))


def group(waves: WaveSet, x: Floats, z: Floats, delta: float) -> Group:
    """The analytic signal of the waves at (x, z), its phase moved by 2δ − π; without waves it is zero."""
    X, Y = np.zeros_like(x), np.zeros_like(x)
    slope_of_x, slope_of_y = np.zeros((*x.shape, 2)), np.zeros((*x.shape, 2))
    weights = group_weights(waves)
    for i, theta in enumerate(waves.theta(x, z)):
        psi = theta + (2.0 * delta - math.pi)
        cosine, sine = weights[i] * np.cos(psi), weights[i] * np.sin(psi)
        X += cosine
        Y += sine
        slope_of_x += sine[:, None] * np.array([waves.kx[i], waves.kz[i]])
        slope_of_y -= cosine[:, None] * np.array([waves.kx[i], waves.kz[i]])
    if waves.groups is None:
        return Group(X, Y, slope_of_x, slope_of_y)
    factor = waves.groups(x, z)
    return Group(factor * X, factor * Y, factor[:, None] * slope_of_x, factor[:, None] * slope_of_y)


def gate(rho: Floats, thresholds: Vec2) -> Floats:
    """Factor on f for a sum of waves of length ρ, in [0, 1]; thresholds (0, 0): 1."""
    low, high = thresholds
    if low == 0.0 and high == 0.0:
        return np.ones_like(rho)
    return smoothstep(low, max(high, low + GATE_LEAST), rho)


def front_saturation(X: Floats, Y: Floats, intensity: float, base: float = math.e) -> Floats:
    """f = E^(cot(ψ/2))/C of ψ = atan2(Y, X), at most 4, as at ψ = 0, and E⁰/C at X = Y = 0; without the gate."""
    half = 0.5 * np.arctan2(Y, X)
    pole = (Y == 0.0) & (X > 0.0)
    sine = np.sin(np.where(pole, 0.5, half))
    nowhere = (Y == 0.0) & (X == 0.0)
    cotangent = np.cos(half) / np.where(nowhere, 1.0, sine)
    exponent = np.clip(np.where(nowhere, 0.0, cotangent) * math.log(base), -EXPONENT, EXPONENT)
    f = np.minimum(np.exp(exponent) / intensity, CAP)
    return np.where(pole, CAP, f)


@lru_cache(maxsize=16)
def front_integral(intensity: float, base: float = math.e) -> Callable[[Floats], Floats]:
    """ψ -> I(ψ) = ∫₀^ψ min(f, 1) of the front of one wave, for any ψ, by Gauss–Legendre in cells and cubics between."""
    # f is at least 1 from 0 to this phase.
    full = 2.0 * math.atan2(1.0, math.log(intensity) / math.log(base))
    cell = (TURN - full) / CELLS
    edges = np.linspace(full, TURN, CELLS + 1)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    inner: Floats = edges[:-1, None] + 0.5 * cell * (nodes + 1.0)
    cells = 0.5 * cell * (_front(inner, intensity, base) @ weights)
    sums = full + np.concatenate(([0.0], np.cumsum(cells)))
    tail = CubicHermiteSpline(edges, sums, _front(edges, intensity, base))

    def integral(psi: Floats) -> Floats:
        turns = np.floor(psi / TURN)
        rest = psi - TURN * turns
        result: Floats = turns * sums[-1] + np.where(rest < full, rest, tail(np.maximum(rest, full)))
        return result

    return integral


def front_saturation_filtered(psi: Floats, width: Floats, intensity: float, base: float = math.e) -> Floats:
    """Mean of min(f, 1) over ψ ± Δ/2, ψ in [−π, π] and Δ = ``width``; in [0, 1], without the gate."""
    # For narrower footprints, cancellation in the difference of two integrals exceeds the filter's effect.
    integral, wide = front_integral(intensity, base), np.maximum(width, 1e-6)
    return np.clip((integral(psi + 0.5 * wide) - integral(psi - 0.5 * wide)) / wide, 0.0, 1.0)


def phase_gradient(group: Group) -> Floats:
    """∇ψ at r places; (r, 2) rad/m."""
    squared = np.maximum(group.X * group.X + group.Y * group.Y, GROUP_LEAST)
    return (group.X[:, None] * group.slope_of_y - group.Y[:, None] * group.slope_of_x) / squared[:, None]


def seen_phases(psi: Floats, width: Floats, change: Pair, eye: Pair, relief: float, crest: float) -> Pair:
    """ψ and Δ of the phases under a footprint that are visible, where crests hide what lies behind them; (r,) each.

    ``change``: derivative of ψ along the view, and its greatest in any direction (rad/m); ``eye``: height of the camera
    above the place, and its horizontal distance (m); ``relief``: slope amplitude of a sinusoid with the waves' mean
    square slope; ``crest``: ψ at a crest.
    """
    (along, steepest), (over, away) = change, eye
    q = np.minimum(np.abs(over) * steepest / np.maximum(relief * np.abs(along) * away, 1e-20), 1.0)
    before = np.sqrt(4.0 * math.pi * q)
    arc = np.maximum((q + before) / np.maximum(1.0 - q**16, 1e-6), 1e-5)
    top = np.where(over < 0.0, crest - math.pi, crest)
    middle = top + np.where(along < 0.0, 0.5, -0.5) * (before - q)
    moved = psi + smoothstep(1.0, 2.0, width / arc) * _wrapped(middle - psi)
    return _wrapped(moved), np.minimum(width, arc)


def phases_under(
    psi: Floats, gradient: Floats, points: SurfacePoints, eye_y: float, relief: float, crest: float
) -> Pair:
    """:func:`seen_phases` under the footprints of points, of a phase ψ with a gradient (r, 2), from a height (m)."""
    assert points.footprints is not None
    away = np.hypot(points.x, points.z)
    along = (gradient[:, 0] * points.x + gradient[:, 1] * points.z) / np.maximum(away, 1e-6)
    change = along, np.hypot(gradient[:, 0], gradient[:, 1])
    width: Floats = sum(np.abs((gradient * side).sum(axis=1)) for side in points.footprints)
    return seen_phases(psi, width, change, (eye_y - points.height, away), relief, crest)


@dataclass(frozen=True)
class _Decay:
    """Foam at a place between two fronts: 1 up to the phase ``born``, then exp(−(phase − born)/``life``), rad."""

    born: float
    life: float

    def left(self, phase: Floats) -> Floats:
        """What is left at a phase since the front, in [0, 2π]; of the shape of ``phase``."""
        return np.exp(np.minimum(self.born - phase, 0.0) / self.life)

    def integral(self, phase: Floats) -> Floats:
        """∫₀ of :meth:`left` over the whole fronts in ``phase`` and the rest of it; of the shape of ``phase``."""
        turns = np.floor(phase / TURN)
        rest = phase - TURN * turns
        whole = self.born + self.life * -math.expm1((self.born - TURN) / self.life)
        decayed = self.life * -np.expm1(np.minimum(self.born - rest, 0.0) / self.life)
        return turns * whole + np.minimum(rest, self.born) + decayed


class _Fronts:
    """The gates of past fronts, in water that rests at (x, z) and drifts. ``since``: phase since the last front, rad in
    [0, 2π]. ``more``: what patches add to the sum of the waves, (r,)."""

    def __init__(self, waves: WaveSet, x: Floats, z: Floats, drift: Vec2, group: Vec2, more: Floats) -> None:
        self.place, self.drift, self.groups = (x, z), drift, waves.groups
        self.thetas = waves.theta(x, z)
        self.rates = waves.omega - waves.kx * drift[0] - waves.kz * drift[1]
        self.weights = group_weights(waves)
        self.mean_rate = max(float(self.weights @ self.rates), LEAST_RATE)
        self.group = group
        self.more = more

    def strength(self, ago: Floats) -> Floats:
        """The gate as it was ``ago`` rad of the mean phase before; of the shape of ``ago``."""
        seconds = ago / self.mean_rate
        phases = zip(self.weights, self.rates, self.thetas, strict=True)
        rho = np.abs(sum(weight * np.exp(1j * (theta - rate * seconds)) for weight, rate, theta in phases))
        if self.groups is not None:
            (x, z), (by_x, by_z) = self.place, self.drift
            rho = rho * self.groups(x - by_x * seconds, z - by_z * seconds, seconds)
        return gate(rho + self.more, self.group)

    def last(self, since: Floats, left: float) -> Pair:
        """Strength of the foam of the last front and of the one before. ``left``: of foam after a turn."""
        third = self.strength(since + 2.0 * TURN) * (1.0 - smoothstep(0.5, 1.0, since / TURN))
        before = np.maximum(self.strength(since + TURN), left * third)
        return np.maximum(self.strength(since), left * before), before


def front_patches(source: FrontSaturation, drift: Vec2, points: SurfacePoints, x: Floats, z: Floats) -> Floats:
    """What patches that drift (m/s) add to the sum of the waves at rest positions, filtered to footprints; (r,)."""
    size = source.variation_size
    if source.variation == 0.0:
        return np.zeros_like(x)
    width = np.zeros_like(x)
    if points.footprints is not None:
        width = np.maximum(*(np.hypot(side[:, 0], side[:, 1]) for side in points.footprints)) / size
    place = np.column_stack((x / size, z / size, np.zeros_like(x)))
    place += noise_place(size, PATCH_CHANGE, drift, points.time, points.origin)
    return source.variation * fractal(place, width, PATCH_OCTAVES, PATCH_SEED)


def decaying_front(
    source: FrontSaturation, waves: WaveSet, points: SurfacePoints, eye_y: float, drift: Vec2, orbits: bool
) -> Floats:
    """Foam that the last three fronts left on the water now at points, each gated as it was; (r,) in [0, 1].

    With footprints averaged over what a camera at a height of ``eye_y`` m sees, else at the points. ``drift``: of the
    water, m/s; ``orbits``: whether those of the waves move foam to and fro.
    """
    assert source.decay is not None
    x, z = points.x, points.z
    sum_of = group(waves, x, z, 0.5 * math.pi)
    gradient = phase_gradient(sum_of)
    by_x, by_z = waves.to_rest(x, z) if orbits else np.zeros((2, x.size))
    rest_x, rest_z = x + by_x, z + by_z
    more = front_patches(source, drift, points, rest_x, rest_z)
    fronts = _Fronts(waves, rest_x, rest_z, drift, source.group, more)
    life = fronts.mean_rate * source.decay
    decaying = _Decay(2.0 * math.atan2(1.0, math.log(source.intensity)), life)
    # The phase at the rest position, to first order.
    psi = np.where(sum_of.rho > 0.0, np.arctan2(sum_of.Y, sum_of.X), 0.0)
    psi = _wrapped(psi + gradient[:, 0] * by_x + gradient[:, 1] * by_z)
    since = np.mod(psi, TURN)
    here, before = fronts.last(since, math.exp(-TURN / life))
    if points.footprints is None:
        return here * decaying.left(since)
    psi, width = phases_under(psi, gradient, points, eye_y, waves.relief, 0.5 * math.pi)
    following = np.maximum(gate(sum_of.rho + more, source.group), math.exp(-TURN / life) * here)
    return _mean_over_fronts(decaying, np.mod(psi, TURN), np.maximum(width, 1e-5), (before, here, following))


def _mean_over_fronts(
    decaying: _Decay, since: Floats, width: Floats, strengths: tuple[Floats, Floats, Floats]
) -> Floats:
    """Mean of the foam over ``since`` ± ``width``/2; ``strengths``: of the front before, this one and the next."""
    before, here, following = strengths
    low, high = since - 0.5 * width, since + 0.5 * width
    integral = decaying.integral
    whole = integral(np.full(1, TURN))[0]
    within = np.where(high < TURN, integral(np.minimum(high, TURN)), whole) - integral(np.maximum(low, 0.0))
    covered = here * within - before * integral(np.minimum(low, 0.0))
    covered = covered + following * np.where(high > TURN, integral(high) - whole, 0.0)
    return np.clip(covered / width, 0.0, 1.0)


def _wrapped(angle: Floats) -> Floats:
    """The angle in [−π, π], rad."""
    return angle - 2.0 * math.pi * np.round(angle / (2.0 * math.pi))


def _front(psi: Floats, intensity: float, base: float) -> Floats:
    """min(f, 1) of one wave at ψ, rad; of the shape of ``psi``."""
    return np.minimum(front_saturation(np.cos(psi), np.sin(psi), intensity, base), 1.0)
