"""Tables of waves: the integral of a front's foam over its phase, for the filtered look (docs/formulae.md, section 4);
the spectrum of an open sea, and the roots of unity of its transform.
"""

import math
from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from seafoam.ocean.arrays import read_only
from seafoam.ocean.waves.cascades import cascades
from seafoam.scene import Sea
from seafoam.sums import summed
from seafoam.textures.spec import Image, TextureSpec

FRONT_NODES = 256
"""Nodes of the table."""
_GAUSS = tuple(zip(*(part.tolist() for part in np.polynomial.legendre.leggauss(8)), strict=True))
ROOTS = 512


class FrontIntegral(TextureSpec):
    """The integral of the front saturation, RGBA32F (1, 256), see :func:`front_integral`."""

    kind: ClassVar[str] = "front-integral"
    intensity: float = Field(ge=0.01, le=1e4, description="C")
    log_base: float = Field(ge=0.1, le=10.0, description="ln E")

    def image(self) -> Image:
        return Image("RGBA32F", (front_integral(self.intensity, self.log_base).astype("<f4")[None],))


def front_full(intensity: float, log_base: float) -> float:
    """ψ₁ in (0, 2π): up to here min(f, 1) is 1, rad. ``intensity``: C; ``log_base``: ln E."""
    return 2.0 * math.atan2(log_base, math.log(intensity))


def front_fading(intensity: float, log_base: float) -> float:
    """∫ min(f, 1) dψ from ψ₁ to 2π, rad."""
    return float(front_integral(intensity, log_base)[-1, 0])


@lru_cache(maxsize=64)
def front_integral(intensity: float, log_base: float) -> NDArray[np.float32]:
    """(256, 4) float32: the integral of min(f, 1) over the phase from ψ₁, f = E^cot(ψ/2)/C, piecewise cubic.

    The nodes are spread evenly over [ψ₁, 2π], a step h apart. Between node i and the next, at ψ = ψ₁ + (i + t)h, the
    integral is a + h(bt + ct² + dt³) with (a, b, c, d) the row of node i: a is the integral up to the node, b is f
    there, and the cubic meets both at the next node. The last row holds the whole integral.

    Eight-point Gauss quadrature between nodes, by ``math`` alone, so that its bytes do not depend on the processor's
    vector units.
    """
    start = front_full(intensity, log_base)
    step = (2.0 * math.pi - start) / (FRONT_NODES - 1)

    def f(psi: float) -> float:
        sine = math.sin(0.5 * psi)
        exponent = log_base * math.cos(0.5 * psi) / sine if sine > 1e-9 else -math.inf
        return math.exp(min(exponent, 80.0)) / intensity

    table = np.zeros((FRONT_NODES, 4), np.float32)
    total = 0.0
    for node in range(FRONT_NODES):
        psi = start + node * step
        here, following = f(psi), f(psi + step)
        mean = 0.5 * summed(w * f(psi + 0.5 * step * (1.0 + x)) for x, w in _GAUSS)
        table[node] = total, here, 3.0 * mean - 2.0 * here - following, here + following - 2.0 * mean
        total += step * mean
    return read_only(table)


class SeaSpectrum(TextureSpec):
    """Spectrum of an FFT sea, RG32F (4·BAND, 8·BAND): first (Re, Im) of h₀ in m, then (turns in a loop, 0)."""

    kind: ClassVar[str] = "sea"
    sea: Sea
    depth: float | None = Field(default=None, ge=0.05, le=11000.0, description="m; absent: deep water")

    @field_validator("sea")
    @classmethod
    def _spectrum_alone(cls, sea: Sea) -> Sea:
        plain = Sea()
        return sea.model_copy(update={"model": plain.model, "choppiness": plain.choppiness})

    def image(self) -> Image:
        made = cascades(self.sea, self.depth)
        amplitude = np.concatenate([of.h0 for of in made], axis=1)
        turns = np.concatenate([of.turns for of in made], axis=1)
        below = np.stack((amplitude.real, amplitude.imag), axis=-1)
        above = np.stack((turns, np.zeros_like(turns)), axis=-1)
        return Image("RG32F", (np.concatenate((below, above)).astype("<f4"),))


class FftTwiddles(TextureSpec):
    """Roots of unity, RG32F (1, 512)."""

    kind: ClassVar[str] = "fft-twiddles"

    def image(self) -> Image:
        return Image("RG32F", (fft_twiddles()[None].astype("<f4"),))


def fft_twiddles() -> NDArray[np.float32]:
    """(512, 2) float32: cos and sin of 2πj/512, computed by ``math`` alone."""
    angles = [2.0 * math.pi * j / ROOTS for j in range(ROOTS)]
    return np.array([(math.cos(angle), math.sin(angle)) for angle in angles], np.float32)
