"""Integral of the front saturation over its phase, a table for the filtered look (docs/formulae.md, section 4)."""

import math

import numpy as np
from numpy.typing import NDArray

FRONT_NODES = 256
"""Nodes of the table."""
_GAUSS = tuple(zip(*(part.tolist() for part in np.polynomial.legendre.leggauss(8)), strict=True))


def front_full(intensity: float, log_base: float) -> float:
    """ψ₁ in (0, 2π): up to here min(f, 1) is 1, rad. ``intensity``: C; ``log_base``: ln E."""
    return 2.0 * math.atan2(log_base, math.log(intensity))


def front_integral_name(intensity: float, log_base: float) -> str:
    """Name in the texture store of the table for C and ln E."""
    return f"front-integral/{intensity!r}/{log_base!r}"


def front_integral(intensity: float, log_base: float) -> NDArray[np.float32]:
    """(256, 2) float32: ∫₀^ψ min(f, 1) dψ and f at nodes spread evenly over [ψ₁, 2π], f = E^cot(ψ/2)/C.

    Eight-point Gauss quadrature between nodes, by ``math`` alone, so that its bytes do not depend on the processor's
    vector units.
    """
    start = front_full(intensity, log_base)
    step = (2.0 * math.pi - start) / (FRONT_NODES - 1)

    def f(psi: float) -> float:
        sine = math.sin(0.5 * psi)
        exponent = log_base * math.cos(0.5 * psi) / sine if sine > 1e-9 else -math.inf
        return math.exp(min(exponent, 80.0)) / intensity

    table = np.empty((FRONT_NODES, 2), np.float32)
    total = start
    for node in range(FRONT_NODES):
        psi = start + node * step
        table[node] = total, f(psi)
        total += 0.5 * step * sum(w * f(psi + 0.5 * step * (1.0 + x)) for x, w in _GAUSS)
    return table
