"""Section 4: foam of fronts, at a point, under a footprint, and of fronts that passed."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from seafoam.reference.types import Floats, smoothstep
from seafoam.reference.waves.parametric import WaveSet
from seafoam.scene.foam import FrontSaturation

CAP = 4.0

EXPONENT = 80.0

CELLS = 16384
"""Cells of the tabulated integral; cubic between them, off by less than 10⁻¹²."""

LISTING_SPATIAL = 6.28 / (2.0 * math.pi)
"""What the published code makes of a wavenumber."""

GATE_LEAST = 1e-4

LEAST_RATE = 1e-3
"""Least mean frequency of the waves for drifting water, rad/s."""

GROUP_LEAST = 1e-4
"""Least ρ² in ∇ψ."""


@dataclass(frozen=True)
class History:
    """How foam moves on the water after it is born."""

    drift: tuple[float, float]
    """(x, z) m/s."""
    carried: bool
    """Whether waves carry it to and fro."""


STILL = History((0.0, 0.0), False)


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


def group(waves: WaveSet, x: Floats, z: Floats, delta: float) -> Group:
    """The analytic signal of the waves at (x, z), its phase moved by 2δ − π; without waves it is zero."""
    X, Y = np.zeros_like(x), np.zeros_like(x)
    slope_of_x, slope_of_y = np.zeros((*x.shape, 2)), np.zeros((*x.shape, 2))
    count = waves.amplitude.size
    all_crests = float(waves.amplitude.sum())
    weights = waves.amplitude / all_crests if all_crests > 0.0 else np.full(count, 1.0 / max(count, 1))
    for i, theta in enumerate(waves.theta(x, z)):
        psi = theta + (2.0 * delta - math.pi)
        cosine, sine = weights[i] * np.cos(psi), weights[i] * np.sin(psi)
        X += cosine
        Y += sine
        slope_of_x += sine[:, None] * np.array([waves.kx[i], waves.kz[i]])
        slope_of_y -= cosine[:, None] * np.array([waves.kx[i], waves.kz[i]])
    return Group(X, Y, slope_of_x, slope_of_y)


def gate(rho: Floats, thresholds: tuple[float, float]) -> Floats:
    """Share of f that a group of length ρ lets through, in [0, 1]; (0, 0) is no gate."""
    low, high = thresholds
    if low == 0.0 and high == 0.0:
        return np.ones_like(rho)
    return smoothstep(low, max(high, low + GATE_LEAST), rho)


def front_saturation(X: Floats, Y: Floats, intensity: float, base: float = math.e) -> Floats:
    """f = E^(cot(ψ/2))/C of ψ = atan2(Y, X), capped at 4, without the gate; of the shape of X.

    At the pole, ψ = 0, f is 4. At X = Y = 0 it is E⁰/C.
    """
    half = 0.5 * np.arctan2(Y, X)
    pole = (Y == 0.0) & (X > 0.0)
    sine = np.sin(np.where(pole, 0.5, half))
    nowhere = (Y == 0.0) & (X == 0.0)
    cotangent = np.cos(half) / np.where(nowhere, 1.0, sine)
    exponent = np.clip(np.where(nowhere, 0.0, cotangent) * math.log(base), -EXPONENT, EXPONENT)
    f = np.minimum(np.exp(exponent) / intensity, CAP)
    result: Floats = np.where(pole, CAP, f)
    return result


class FrontIntegral:
    """I(ψ) = ∫₀^ψ min(f, 1) of the front of one wave, for any ψ, by Gauss–Legendre in cells and cubics between."""

    def __init__(self, intensity: float, base: float) -> None:
        self.full = 2.0 * math.atan2(1.0, math.log(intensity) / math.log(base))
        """ψ₁: f is 1 or more from 0 to here."""
        self.cell = (2.0 * math.pi - self.full) / CELLS
        edges = np.linspace(self.full, 2.0 * math.pi, CELLS + 1)
        nodes, weights = np.polynomial.legendre.leggauss(8)
        inner: Floats = edges[:-1, None] + 0.5 * self.cell * (nodes + 1.0)
        cells = 0.5 * self.cell * (_front(inner, intensity, base) @ weights)
        self.sums = self.full + np.concatenate(([0.0], np.cumsum(cells)))
        self.values = _front(edges, intensity, base)

    def __call__(self, psi: Floats) -> Floats:
        """I at ψ, rad; of the shape of ``psi``."""
        turns = np.floor(psi / (2.0 * math.pi))
        rest = psi - 2.0 * math.pi * turns
        place = np.maximum(rest - self.full, 0.0) / self.cell
        i = np.minimum(place.astype(np.intp), CELLS - 1)
        t = np.minimum(place - i, 1.0)
        step, y0, y1 = self.cell, self.sums[i], self.sums[i + 1]
        d0, d1 = self.values[i] * step, self.values[i + 1] * step
        rise = y1 - y0
        tail = y0 + t * (d0 + t * ((3.0 * rise - 2.0 * d0 - d1) + t * (d0 + d1 - 2.0 * rise)))
        result: Floats = turns * self.sums[-1] + np.where(rest < self.full, rest, tail)
        return result

    def mean(self, psi: Floats, width: Floats) -> Floats:
        """Mean of min(f, 1) over ψ ± Δ/2, Δ > 0, in [0, 1]; of the shape of ``psi``."""
        total = self(psi + 0.5 * width) - self(psi - 0.5 * width)
        result: Floats = np.clip(total / width, 0.0, 1.0)
        return result


@lru_cache(maxsize=16)
def front_integral(intensity: float, base: float = math.e) -> FrontIntegral:
    """The integral of one front, kept for later calls."""
    return FrontIntegral(intensity, base)


def front_saturation_filtered(psi: Floats, width: Floats, intensity: float, base: float = math.e) -> Floats:
    """Mean of min(f, 1) over ψ ± Δ/2, ψ in [−π, π] and Δ = ``width``; in [0, 1], without the gate."""
    # Narrower than this, the difference of two integrals has lost more digits than the filter changes.
    sharp = width < 1e-6
    mean = front_integral(intensity, base).mean(psi, np.where(sharp, 1.0, width))
    crosses = sharp & (np.abs(psi) < 0.5 * width)
    jump = np.clip(0.5 + psi / np.where(crosses, width, 1.0), 0.0, 1.0)
    result: Floats = np.where(
        crosses,
        jump,
        np.where(sharp, np.minimum(front_saturation(np.cos(psi), np.sin(psi), intensity, base), 1.0), mean),
    )
    return result


def phase_gradient(of: Group) -> Floats:
    """∇ψ at r places; (r, 2) rad/m."""
    squared = np.maximum(of.X * of.X + of.Y * of.Y, GROUP_LEAST)
    result: Floats = (of.X[:, None] * of.slope_of_y - of.Y[:, None] * of.slope_of_x) / squared[:, None]
    return result


def phase_width(gradient: Floats, foot_x: Floats, foot_y: Floats) -> Floats:
    """Δ = |∇ψ·∂x/∂X| + |∇ψ·∂x/∂Y| over footprints (r, 2) m; (r,) rad."""
    result: Floats = np.abs((gradient * foot_x).sum(axis=1)) + np.abs((gradient * foot_y).sum(axis=1))
    return result


def seen_phases(
    psi: Floats, width: Floats, along: Floats, across: Floats, over: Floats, away: Floats, relief: float, crest: float
) -> tuple[Floats, Floats]:
    """ψ and Δ of the phases under a footprint that the eye sees, waves hiding their backs; (r,) each.

    ``along``: how fast ψ grows along the view, ``across``: at most, in any direction (rad/m); ``over``: how far the
    eye is above the place, ``away``: how far off along the level (m); ``relief``: slope amplitude of the sinusoid that
    is as steep as the waves; ``crest``: ψ on a crest.
    """
    q = np.minimum(np.abs(over) * across / np.maximum(relief * np.abs(along) * away, 1e-20), 1.0)
    before = np.sqrt(4.0 * math.pi * q)
    arc = np.maximum((q + before) / np.maximum(1.0 - q**16, 1e-6), 1e-5)
    top = np.where(over < 0.0, crest - math.pi, crest)
    middle = top + np.where(along < 0.0, 0.5, -0.5) * (before - q)
    moved = psi + smoothstep(1.0, 2.0, width / arc) * _wrapped(middle - psi)
    return _wrapped(moved), np.minimum(width, arc)


def living_front(
    source: FrontSaturation,
    decay: float,
    waves: WaveSet,
    x: Floats,
    z: Floats,
    footprints: tuple[Floats, Floats] | None,
    over: Floats,
    history: History,
) -> Floats:
    """Foam that the last three fronts left on the water now at (x, z), the gate of each in it; (r,) in [0, 1].

    With footprints averaged over what an eye ``over`` (r,) m higher sees, else at the place.
    """
    sum_of = group(waves, x, z, 0.5 * math.pi)
    gradient = phase_gradient(sum_of)
    way_x, way_z = waves.carry(x, z) if history.carried else (np.zeros_like(x), np.zeros_like(x))
    rates = waves.omega - waves.kx * history.drift[0] - waves.kz * history.drift[1]
    all_crests, count = float(waves.amplitude.sum()), waves.amplitude.size
    weights = waves.amplitude / all_crests if all_crests > 0.0 else np.full(count, 1.0 / count)
    mean_rate = max(float(weights @ rates), LEAST_RATE)
    turn = 2.0 * math.pi
    life, born = mean_rate * decay, 2.0 * math.atan2(1.0, math.log(source.intensity))
    # The phase where the water rests, to first order.
    psi = np.where(sum_of.rho > 0.0, np.arctan2(sum_of.Y, sum_of.X), 0.0)
    psi = _wrapped(psi + gradient[:, 0] * way_x + gradient[:, 1] * way_z)
    since = np.mod(psi, turn)
    thetas = waves.theta(x + way_x, z + way_z)

    def strength(phase: Floats) -> Floats:
        """The gate so much of the mean phase ago."""
        ago = phase / mean_rate
        signal = sum(w * np.exp(1j * (theta - r * ago)) for w, r, theta in zip(weights, rates, thetas, strict=True))
        return gate(np.abs(signal), source.group)

    left = math.exp(-turn / life)
    third = strength(since + 2.0 * turn) * (1.0 - smoothstep(0.5, 1.0, since / turn))
    before = np.maximum(strength(since + turn), left * third)
    here = np.maximum(strength(since), left * before)

    def kept(phase: Floats) -> Floats:
        """What is left of foam of strength 1; of the shape of ``phase``, in [0, 2π]."""
        result: Floats = np.exp(np.minimum(born - phase, 0.0) / life)
        return result

    if footprints is None:
        return here * kept(since)
    away = np.hypot(x, z)
    along = (gradient[:, 0] * x + gradient[:, 1] * z) / np.maximum(away, 1e-6)
    across = np.hypot(gradient[:, 0], gradient[:, 1])
    width = phase_width(gradient, *footprints)
    psi, width = seen_phases(psi, width, along, across, over, away, waves.relief, 0.5 * math.pi)
    since = np.mod(psi, turn)
    width = np.maximum(width, 1e-5)
    low, high = since - 0.5 * width, since + 0.5 * width

    def integral(phase: Floats) -> Floats:
        """∫₀ of what is left, over whole fronts and the rest."""
        turns = np.floor(phase / turn)
        rest = phase - turn * turns
        one = born + life * -math.expm1((born - turn) / life)
        result: Floats = turns * one + np.minimum(rest, born) + life * -np.expm1(np.minimum(born - rest, 0.0) / life)
        return result

    following = np.maximum(gate(sum_of.rho, source.group), left * here)
    whole = integral(np.full(1, turn))[0]
    within = np.where(high < turn, integral(np.minimum(high, turn)), whole) - integral(np.maximum(low, 0.0))
    covered = here * within - before * integral(np.minimum(low, 0.0))
    covered = covered + following * np.where(high > turn, integral(high) - whole, 0.0)
    narrow = (low > 0.0) & (high < turn) & (width < 1e-6)
    result: Floats = np.where(narrow, here * kept(since), np.clip(covered / width, 0.0, 1.0))
    return result


def _wrapped(angle: Floats) -> Floats:
    """The angle in [−π, π], rad."""
    result: Floats = angle - 2.0 * math.pi * np.round(angle / (2.0 * math.pi))
    return result


def _front(psi: Floats, intensity: float, base: float) -> Floats:
    """min(f, 1) of one wave for 0 < ψ ≤ 2π, where it is continuous; of the shape of ``psi``."""
    cotangent = np.cos(0.5 * psi) / np.maximum(np.sin(0.5 * psi), 1e-300)
    exponent = np.clip(cotangent * math.log(base), -EXPONENT, EXPONENT)
    result: Floats = np.minimum(np.exp(exponent) / intensity, 1.0)
    return result
