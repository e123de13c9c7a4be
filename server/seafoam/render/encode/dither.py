"""8-bit pictures without bands: 16 bits per channel, dithered by our own mask."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.catalogue import load_mask

MASK = "vac-1.5"
"""The mask with the finest pattern."""
_SHIFTS = ((0, 0), (171, 341), (341, 171), (0, 0))
"""Places of the mask for the channels, texels: apart, so that the pattern is not one of brightness alone."""
BAND = 32
"""Rows at a time: what is computed on stays in the processor's cache. A divisor of the mask's side."""


@lru_cache(maxsize=4)
def _thresholds(width: int) -> NDArray[np.uint16]:
    """The mask, tiled to a width: (side, width, 4) of whole numbers 0..255 that all occur equally often."""
    ranks = load_mask(MASK).ranks
    scaled = (ranks.astype(np.uint64) * 256 // ranks.size).astype(np.uint16)
    channels = np.stack([np.roll(scaled, shift, axis=(0, 1)) for shift in _SHIFTS], axis=-1)
    return np.ascontiguousarray(np.tile(channels, (1, -(-width // len(ranks)), 1))[:, :width])


def dithered(pixels: NDArray[np.uint16], first: int = 0) -> NDArray[np.uint8]:
    """Return (height, width, 4), 65535 = display white, as 8 bits.

    first: the picture's row that is row 0, a multiple of :data:`BAND`.

    A value between two levels becomes the upper one in as many places of the mask as it lies above the lower one, so a
    mean over the mask's tile differs from the mean of the values by less than a hundredth of a level. Black stays
    black and white white. The same pixels give the same result.
    """
    height, width, _ = pixels.shape
    result = np.empty(pixels.shape, np.uint8)
    mask = _thresholds(width)
    for top in range(0, height, BAND):
        values = pixels[top : top + BAND]
        at = (first + top) % len(mask)
        # 16 bits hold it: 65535 becomes 255 levels of 256 steps, and a threshold is less than a level.
        scaled = values >> 8
        np.subtract(values, scaled, out=scaled)
        scaled += mask[at : at + len(values)]
        scaled >>= 8
        result[top : top + BAND] = scaled
    return result
