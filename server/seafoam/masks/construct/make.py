"""Constructs masks: permutations of 0..N-1 on a torus whose level sets are the foam patterns."""

import math

import numpy as np

from seafoam.masks.construct import bubble, lace, void_cluster
from seafoam.masks.families import METHODS, MaskSpec, check_parameters
from seafoam.masks.torus import Progress, Ranks, band_passed, filter_noise, gaussian_response, rank


def make_mask(
    family: str,
    *,
    sigma: float | None = None,
    size: int | tuple[int, int] = 512,
    seed: int = 0,
    aspect: float = 1.0,
    age: float = 0.0,
    method: str = "batched",
    progress: Progress = lambda _: None,
) -> Ranks:
    """Construct a mask.

    family: one of :data:`seafoam.masks.families.FAMILIES`.
    sigma: the family's length parameter in texels; ``None`` takes its default.
    size: side of the tile, or its width and height; 32 to 1024 texels each.
    seed: 0..2^32-1, for a PCG64 generator. The same arguments give the same ranks on the same machine; across
        machines FFT rounding may order near-equal texels otherwise, so files are the reference, not this call.
    aspect, age: of ``lace`` alone, see :func:`seafoam.masks.construct.lace.lace`.
    method: how ``vac`` is ordered, ``"exact"`` (one texel at a time) or ``"batched"``; no other family reads it.
    progress: called with fractions in 0..1, not decreasing; the last is 1.

    Returns uint32 ranks of shape (height, width), each of 0..N-1 once. Raises ``ValueError`` for bad arguments.
    """
    if method not in METHODS:
        raise ValueError(f"method {method!r} is not one of {', '.join(METHODS)}")
    return build(check_parameters(family, sigma, size, seed, aspect, age), exact=method == "exact", progress=progress)


def build(parameters: MaskSpec, *, exact: bool = False, progress: Progress = lambda _: None) -> Ranks:
    """Construct the mask of checked parameters; otherwise as :func:`make_mask`."""
    rng, shape = np.random.Generator(np.random.PCG64(parameters.seed)), parameters.shape
    match parameters.family:
        case "vac":
            return void_cluster.ordered(shape, parameters.sigma, rng, progress, exact=exact)
        case "bubble":
            return bubble.bubble(shape, parameters.sigma, rng, progress)
        case "mix":
            return bubble.mix(shape, parameters.sigma, rng, progress)
        case "lace":
            ranks = lace.lace(shape, parameters.sigma, parameters.aspect, parameters.age, rng, progress)
        case "blur":
            # The literal reading of the sentence in Yingst, Alford and Parberry (2011) that a Gaussian filters white
            # noise: its spectrum has neither the oscillation nor the high frequencies that the paper plots.
            ranks = rank(filter_noise(rng, shape, gaussian_response(shape, parameters.sigma)))
        case "clump":
            ranks = rank(band_passed(rng, shape, parameters.sigma, bubble.WIDE_PER_NARROW * parameters.sigma))
    progress(1.0)
    return ranks


def estimated_seconds(parameters: MaskSpec) -> float:
    """Time that :func:`build` in batches is not expected to exceed on one core of a recent server, in seconds.

    Fitted to measurements on a Zen 4 class core with about a quarter to spare; good for refusing a request, not
    for a progress bar.
    """
    tile = parameters.width * parameters.height / 512**2
    match parameters.family:
        case "vac":
            return _batched_seconds(parameters.sigma, tile)
        case "bubble" | "mix":
            return 0.5 * tile + _batched_seconds(bubble.SITE_SIGMA, tile / parameters.sigma**2)
        case "lace":
            return 1.5 * tile
        case "blur" | "clump":
            return 0.1 * tile


def _batched_seconds(sigma: float, tile: float) -> float:
    """Passes grow as sigma^2, and the cost of one as the tile area over a fixed overhead."""
    passes = sigma**2 / void_cluster.batch_share(sigma) + 1.5
    # Larger tiles do not fit the caches.
    return passes * (0.12 * tile * math.sqrt(max(tile, 1.0)) + 0.004)
