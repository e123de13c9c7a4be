"""Making a mask: a permutation of 0..N-1 on a torus whose level sets are the foam patterns."""

from __future__ import annotations

import numpy as np

from . import bubble, filtered, void_cluster
from .families import Family, check_method, check_parameters
from .torus import Progress, Ranks, no_progress


def make_mask(
    family: str,
    *,
    sigma: float | None = None,
    size: int = 512,
    seed: int = 0,
    method: str = "batched",
    progress: Progress = no_progress,
) -> Ranks:
    """Construct a mask.

    family: one of :data:`seafoam.masks.families.FAMILIES`.
    sigma: the family's length parameter in texels; ``None`` takes its default.
    size: tile side in texels, one of ``families.SIZES``.
    seed: 0..2^32-1, for a PCG64 generator. The same arguments give the same ranks on the same machine; across
        machines FFT rounding may order near-equal texels otherwise, so files are the reference, not this call.
    method: how ``vac`` is ordered, ``"exact"`` (one texel at a time) or ``"batched"``; no other family reads it.
    progress: called with fractions in 0..1, not decreasing; the last is 1.

    Returns uint32 ranks of shape (size, size), each of 0..size^2-1 once. Raises ``ValueError`` for bad arguments.
    """
    asked = check_parameters(family, sigma, size, seed)
    chosen_method = check_method(method)
    rng = np.random.Generator(np.random.PCG64(asked.seed))
    match asked.family:
        case "vac":
            build = void_cluster.exact if chosen_method == "exact" else void_cluster.batched
            return build(asked.size, asked.sigma, rng, progress)
        case "bubble":
            return bubble.bubble(asked.size, asked.sigma, rng, progress)
        case "mix":
            return bubble.mix(asked.size, asked.sigma, rng, progress)
        case "blur":
            ranks = filtered.blur(asked.size, asked.sigma, rng)
        case "clump":
            ranks = filtered.clump(asked.size, asked.sigma, rng)
    progress(1.0)
    return ranks
