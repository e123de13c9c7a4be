"""Tables with which a mask can be thresholded at any scale with exact coverage.

The limit at every scale is a threshold of the interpolated mask, whose values are not uniformly distributed: the
saturation is first mapped by its quantile function, the quantile table. Under minification, a footprint is a few texels
of a level that each approximate the distribution of their thresholds: the spans, with a quantile table for each level.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seafoam.masks.formats import quantised
from seafoam.masks.torus import Field, Ranks

Level = NDArray[np.float32]
QUANTILE_ENTRIES = 65
SUBTEXELS = 8
"""Sample positions a texel and axis at which the interpolated mask's distribution is taken."""
SPLINE_SCALE = 3072
"""What the B-spline's weights at odd eighths of a texel are whole parts of: 6 times 8 cubed."""
ENTRY_BITS = 21
"""Of 0..1 in which :func:`spans` looks thresholds up in the quantile table."""
SPAN_STEPS = 256
"""Steps of 0..1 in which spans begin and end: what a texel covers differs by 0.001 to 0.005 root mean square from that
of endless digits, a tenth of what four by four texels leave in a footprint."""
OCTAVE_RAMP = 0.6
"""Width, in shares of the plane, of the ramp that an octave leaves to the next: 0.4 leaves walls smooth, 0.9 dissolves
them."""
RAMP_SAMPLES = 4096
"""Values of the interpolated mask over which the ramp's mean is taken."""
END_MARGIN = 1.0 / 64.0
"""The interpolated mask lies within this of its sampled extremes: its second derivatives are at most 2, and at an
extreme, where the gradient is zero, a sample is at most 1/16 texel away along each axis."""


def thresholds(ranks: Ranks) -> Field:
    """u = (rank + 0.5) / N in 0..1, float64 of the shape of ``ranks``."""
    return (ranks + 0.5) / ranks.size


def bspline_weights(f: float) -> tuple[float, float, float, float]:
    """Uniform cubic B-spline weights of texels i-1, i, i+1, i+2 at i + f, 0 <= f < 1; they sum to 1."""
    g = 1.0 - f
    return (
        g**3 / 6.0,
        (3.0 * f**3 - 6.0 * f**2 + 4.0) / 6.0,
        (-3.0 * f**3 + 3.0 * f**2 + 3.0 * f + 1.0) / 6.0,
        f**3 / 6.0,
    )


def bspline_samples(ranks: Ranks, subtexels: int = SUBTEXELS) -> NDArray[np.float32]:
    """u interpolated by the cubic B-spline (16 taps, no prefilter) at a regular grid of subtexel positions.

    Returns (rows * subtexels, columns * subtexels) float32. Samples lie (j + 0.5) / subtexels past texel centres.
    """
    values = thresholds(ranks).astype(np.float32)
    for _axis in (0, 1):
        size = values.shape[0]
        fine = np.empty((size, subtexels, values.shape[1]), np.float32)
        for j in range(subtexels):
            weights = bspline_weights((j + 0.5) / subtexels)
            fine[:, j] = sum(np.float32(w) * np.roll(values, 1 - tap, axis=0) for tap, w in enumerate(weights))
        values = np.ascontiguousarray(fine.reshape(size * subtexels, -1).T)
    return values


def quantile_position(s: ArrayLike) -> Field:
    """Place t in 0..1 of a saturation s in 0..1 on the quantile table; linear entry index is 64 t.

    t = sqrt(s / 2) up to s = 1/2 and 1 - sqrt((1 - s) / 2) above. The table is close near 0 and 1, where the
    quantile function of an interpolated mask is steepest: at even steps of s, the thinnest foam (s < 1/64)
    would lie between two entries and come out much too sparse.
    """
    share = np.clip(np.asarray(s, np.float64), 0.0, 1.0)
    return np.where(share <= 0.5, np.sqrt(share / 2.0), 1.0 - np.sqrt((1.0 - share) / 2.0))


def quantile_saturation(t: ArrayLike) -> Field:
    """Inverse of :func:`quantile_position`: s = 2 t^2 up to t = 1/2 and 1 - 2 (1 - t)^2 above."""
    position = np.asarray(t, np.float64)
    return np.where(position <= 0.5, 2.0 * position**2, 1.0 - 2.0 * (1.0 - position) ** 2)


SHARES = quantile_saturation(np.arange(QUANTILE_ENTRIES) / (QUANTILE_ENTRIES - 1))
"""Saturations of the entries of a table."""
FINE_SHARES = quantile_saturation(np.linspace(0.0, 1.0, 16 * QUANTILE_ENTRIES))
"""Those between which quantiles of a level are sought."""


def quantile_table(ranks: Ranks) -> list[float]:
    """65 values of Q at ``quantile_saturation(i / 64)``: the B-spline interpolated mask is below Q(s) on a share
    s of the plane.

    Non-decreasing, within 0..1. Entry 0 is at most the least value of the interpolated mask and entry 64 at least
    its greatest, so that s = 0 shows nothing and s = 1 everything.
    """
    samples = np.sort(bspline_samples(ranks), axis=None)
    place = SHARES * (samples.size - 1)
    below = np.floor(place).astype(np.intp)
    above = np.minimum(below + 1, samples.size - 1)
    table = samples[below] + (place - below) * (samples[above].astype(np.float64) - samples[below])
    table[0] = max(float(samples[0]) - END_MARGIN, 0.0)
    table[-1] = min(float(samples[-1]) + END_MARGIN, 1.0)
    return [float(value) for value in table]


def quantile_lookup(table: ArrayLike, s: ArrayLike) -> Field:
    """Q(s) by linear interpolation of a :func:`quantile_table`, as the shaders do it; of the shape of ``s``."""
    entries = np.asarray(table, np.float64)
    return np.interp(quantile_position(s), np.linspace(0.0, 1.0, entries.size), entries)


def spans(ranks: Ranks, table: ArrayLike) -> list[Level]:
    """Mip chain of (low, width): in a texel of level l thresholds lie evenly in [low, low + width], near enough.

    The thresholds are those of the interpolated mask, each sent through the inverse of its quantile function
    (``table``), so that they are below s on a share s of the plane, as the mask's own are, and magnified and minified
    foam have one limit. Mean and deviation are the texel's; a spread that would leave 0..1 is narrowed about its mean
    until it does not, so nothing is covered at s = 0 and all at s = 1. Both are whole steps of 1/256, widths
    one or more. Level l is (size >> l, size >> l, 2) float32.

    In whole numbers that fit 32 bits, so that GLSL (``shaders/foam/mask``) makes the same of a mask to the last bit;
    0.4 % of the texels are off by a step of 1/256 from what endless digits give, none by more.
    """
    even = np.stack([_even(part, table) for part in _spline_quarters(ranks)])
    total = even.sum(axis=0)
    centre = (total + 8) >> 4
    # In 1/65536 and in 1/65536 squared.
    mean, variance = (total + 2) >> 2, ((even - centre) ** 2).sum(axis=0)
    chain = []
    while True:
        # The deviation times sqrt 12 is the width: the greatest with (2 width - 1)^2 <= 12 variance 512^2.
        root = np.sqrt(((3 * variance) >> 12).astype(np.float64)).astype(np.int64)
        width = np.minimum((root + 1) >> 1, (np.minimum(mean, 65536 - mean) + 64) >> 7)
        width = np.clip(width, 1, SPAN_STEPS)
        low = np.clip((mean - 128 * width + 128) >> 8, 0, SPAN_STEPS - width)
        chain.append((np.stack((low, width), axis=-1) / SPAN_STEPS).astype(np.float32))
        if mean.shape[0] == 1:
            return chain
        finer, (mean, variance) = mean, (_mean_of_four(mean), _mean_of_four(variance))
        variance += _mean_of_four((finer - mean.repeat(2, axis=0).repeat(2, axis=1)) ** 2)


def _spline_quarters(ranks: Ranks) -> list[NDArray[np.int64]]:
    """The interpolated mask in 1/2^21 at the middles of each texel's sixteenths, row by row; of its shape."""
    doubled = 2 * quantised(ranks, 16).astype(np.int64) + max(65536 // ranks.size, 1)
    rows = [(across + 256) >> 9 for across in _quarters(doubled, 1)]
    # 131072 steps of the doubled mask, times the scale twice, over the 512 that are gone: 1152 times 2^21.
    return [(part + 576) // 1152 for row in rows for part in _quarters(row, 0)]


def _quarters(values: NDArray[np.int64], axis: int) -> list[NDArray[np.int64]]:
    """The cubic B-spline along an axis 3/8 and 1/8 before each texel's middle and behind; :data:`SPLINE_SCALE` is 1."""
    entries = []
    for first, eighths in ((-2, 5), (-2, 7), (-1, 1), (-1, 3)):
        weights = (round(SPLINE_SCALE * weight) for weight in bspline_weights(eighths / 8.0))
        taps = (weight * np.roll(values, -first - tap, axis=axis) for tap, weight in enumerate(weights))
        entries.append(np.sum(list(taps), axis=0))
    return entries


def _even(values: NDArray[np.int64], table: ArrayLike) -> NDArray[np.int64]:
    """Interpolated thresholds in 1/2^21 -> the share of the plane below them, 1/16384, at most 16383."""
    entries = (np.asarray(table, np.float32).astype(np.float64) * (1 << ENTRY_BITS)).astype(np.int64)
    below = np.clip(np.searchsorted(entries, values, side="right") - 1, 0, entries.size - 2)
    step = np.maximum(entries[below + 1] - entries[below], 1)
    place = below * 1024 + np.clip(values - entries[below], 0, step) * 1024 // step
    end = np.minimum(place, 65536 - place)
    share = (end * end + 65536) >> 17
    even: NDArray[np.int64] = np.minimum(np.where(place <= 32768, share, 16384 - share), 16383)
    return even


def _mean_of_four(values: NDArray[np.int64]) -> NDArray[np.int64]:
    half = values.shape[0] // 2
    mean: NDArray[np.int64] = (values.reshape(half, 2, half, 2).sum(axis=(1, 3)) + 2) >> 2
    return mean


def span_quantiles(chain: Sequence[Level]) -> Field:
    """For each level of :func:`spans` 65 values of Q at ``quantile_saturation(i / 64)``; (levels, 65) float64.

    Texels whose thresholds lie evenly in their spans cover a share s of the plane together where each is thresholded
    at Q(s). Thresholds in a texel are not quite even, so Q is not quite s: thresholded at s = 0.09 itself, small texels
    of a fine mask would cover little more than half of that.
    """
    grid = FINE_SHARES
    rows = []
    for level in chain:
        low, width = np.moveaxis(level.astype(np.float64).reshape(-1, 2), -1, 0)
        slope = 1.0 / width
        covered = np.zeros_like(grid)
        # Each texel covers a ramp from its lowest threshold on, less the same ramp from its highest on.
        for sign, ends in ((1.0, low), (-1.0, low + width)):
            order = np.argsort(ends, kind="stable")
            passed = np.searchsorted(ends[order], grid)
            slopes = np.concatenate(([0.0], np.cumsum(slope[order])))
            offsets = np.concatenate(([0.0], np.cumsum((slope * ends)[order])))
            covered += sign * (grid * slopes[passed] - offsets[passed])
        row = np.interp(SHARES, np.maximum.accumulate(covered / low.size), grid)
        row[0], row[-1] = 0.0, 1.0
        rows.append(row)
    return np.stack(rows)


def ramp_threshold(s: ArrayLike) -> Field:
    """T at which a ramp of :data:`OCTAVE_RAMP` = w over even thresholds, clamp((T - u) / w, 0, 1), covers a share s.

    0 at s = 0 and 1 + w at s = 1, where all is whole. The mean over u in 0..1 is T^2 / (2 w) up to T = w, T - w / 2 up
    to T = 1 and 1 - (1 + w - T)^2 / (2 w) beyond.
    """
    share, w = np.clip(np.asarray(s, np.float64), 0.0, 1.0), OCTAVE_RAMP
    return np.where(
        share < w / 2.0,
        np.sqrt(2.0 * w * share),
        np.where(share <= 1.0 - w / 2.0, share + w / 2.0, 1.0 + w - np.sqrt(2.0 * w * (1.0 - share))),
    )


def ramp_tables(quantile: ArrayLike, chain: Sequence[Level]) -> Field:
    """Where the ramp of an octave stands so that it covers a share s, 65 entries a row; (levels + 2, 65) float64.

    Entry i is for ``quantile_saturation(i / 64)``. Row 0: T for the interpolated mask, whose values b the ramp makes
    clamp((T - b) / W, 0, 1) of; its width W is in the last row. Rows 1 and on: T for the texels of a level of
    :func:`spans`, ramp :data:`OCTAVE_RAMP`. Both ends of the ramp go through the distribution of what it is laid
    over, so the cover is s at every scale.
    """
    threshold, width = _spline_ramp(np.asarray(quantile, np.float64))
    return np.vstack((threshold, [_span_ramp(level) for level in chain], width))


def _spline_ramp(quantile: Field) -> tuple[Field, Field]:
    """T and W of the ramp over the interpolated mask, straight between its ends in shares of the plane; (65,) each."""
    even = ramp_threshold(SHARES)
    low, high = np.maximum(even - OCTAVE_RAMP, 0.0), np.minimum(even, 1.0)
    top, bottom = np.minimum(even / OCTAVE_RAMP, 1.0), np.maximum(even - 1.0, 0.0) / OCTAVE_RAMP
    rise = np.where(top > bottom, top - bottom, 1.0)
    width = (quantile_lookup(quantile, high) - quantile_lookup(quantile, low)) / rise
    # At both ends the ramp has shrunk to a point: as steep as beside it.
    width[0], width[-1] = width[1], width[-2]
    threshold = quantile_lookup(quantile, high) + bottom * width
    # Between its ends the distribution is bent: moved until the mean is the share.
    values = quantile_lookup(quantile, (np.arange(RAMP_SAMPLES) + 0.5) / RAMP_SAMPLES)
    left, right = threshold - width, threshold + width
    for _ in range(40):
        middle = 0.5 * (left + right)
        mean = np.clip((middle[:, None] - values) / width[:, None], 0.0, 1.0).mean(axis=1)
        left, right = np.where(mean < SHARES, middle, left), np.where(mean < SHARES, right, middle)
    threshold[1:-1] = 0.5 * (left + right)[1:-1]
    threshold[0], threshold[-1] = quantile[0], quantile[-1] + width[-1]
    return threshold, width


def _span_ramp(level: Level) -> Field:
    """T of the ramp over the texels of a level; (65,)."""
    low, width = np.moveaxis(np.rint(level.reshape(-1, 2) * SPAN_STEPS).astype(np.int64), -1, 0)
    # Integral of the ramp over a texel's thresholds: from its lowest on, less from its highest on.
    count = SPAN_STEPS + 1
    ends = np.bincount(low, SPAN_STEPS / width, count) - np.bincount(low + width, SPAN_STEPS / width, count)
    grid = ramp_threshold(FINE_SHARES)
    above = np.maximum(grid[:, None] - np.arange(count) / SPAN_STEPS, 0.0)
    limited = np.minimum(above, OCTAVE_RAMP)
    covered = (limited * limited / (2.0 * OCTAVE_RAMP) + (above - limited)) @ ends / low.size
    row = np.interp(SHARES, np.maximum.accumulate(covered), grid)
    row[0], row[-1] = 0.0, 1.0 + OCTAVE_RAMP
    return row


def atlas(ranks: Ranks, chain: Sequence[Level]) -> NDArray[np.uint32]:
    """A mask and its :func:`spans` in one image, (size, 5 size / 2, 2) uint32: a fetch gets four texels of a row.

    A column holds its texel, the one before and the two behind, round the torus, 16 bits each, the first in the lowest.
    From left to right: the mask, floor(rank 65536 / N); level 0 of the spans, low 256 in the lower 8 bits and
    width 256 - 1 in the upper; the other levels one below the other, level l from row size - 2 (size >> l) on.
    """
    size = ranks.shape[0]
    image = np.zeros((size, 2 * size + size // 2, 4), np.uint16)

    def put(x: int, y: int, words: NDArray[np.uint16]) -> None:
        side = words.shape[0]
        for channel in range(4):
            image[y : y + side, x : x + side, channel] = np.roll(words, 1 - channel, axis=1)

    put(0, 0, quantised(ranks, 16).astype(np.uint16))
    for number, level in enumerate(chain):
        low, width = np.moveaxis(np.rint(level * SPAN_STEPS).astype(np.uint16), -1, 0)
        x, y = (2 * size, size - 2 * level.shape[0]) if number else (size, 0)
        put(x, y, low | (width - np.uint16(1)) << np.uint16(8))
    return image.view(np.uint32)
