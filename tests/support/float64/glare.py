"""Section 7: glare around bright light, of a whole frame."""

import numpy as np

from seafoam.reference.types import Floats, smoothstep

LEVELS = 6
MOST = 4096.0


def spread(frame: Floats, share: float) -> Floats:
    """The finished linear frame (H, W, 3), rows from the bottom, with a ``share`` of its light spread; (H, W, 3)."""
    height, width = frame.shape[:2]
    rows, columns = -(-height // 4), -(-width // 4)
    padded = np.pad(np.minimum(frame, MOST), ((0, 4 * rows - height), (0, 4 * columns - width), (0, 0)), mode="edge")
    levels = [padded.reshape(rows, 4, columns, 4, 3).mean(axis=(1, 3))]
    for k in range(1, LEVELS):
        part = 4 << k
        rows, columns = -(-height // part), -(-width // part)
        y, x = np.meshgrid(2.0 * np.arange(rows) + 1.0, 2.0 * np.arange(columns) + 1.0, indexing="ij")
        levels.append(_taps(levels[-1], x, y, 0.75))
    total, weight = levels[-1], 1.0
    for finer, coarser in zip(levels[-2::-1], levels[:0:-1], strict=True):
        share_of = 1.0 - float(smoothstep(0.08, 0.25, 1.0 / coarser.shape[0]))
        y, x = np.meshgrid(
            0.5 * np.arange(finer.shape[0]) + 0.25, 0.5 * np.arange(finer.shape[1]) + 0.25, indexing="ij"
        )
        total, weight = finer + share_of * _taps(total, x, y, 0.5), 1.0 + share_of * weight
    y, x = np.meshgrid(0.25 * np.arange(height) + 0.125, 0.25 * np.arange(width) + 0.125, indexing="ij")
    return frame + share / LEVELS * (_bilinear(total, x, y) - weight * frame)


def _taps(image: Floats, x: Floats, y: Floats, apart: float) -> Floats:
    """Mean of four bilinear readings around places (r, c), texels, ``apart`` texels from them along both axes."""
    return 0.25 * sum(
        (_bilinear(image, x + i * apart, y + j * apart) for i in (-1.0, 1.0) for j in (-1.0, 1.0)),
        start=np.zeros((*x.shape, 3)),
    )


def _bilinear(image: Floats, x: Floats, y: Floats) -> Floats:
    """An image (h, w, 3) at places (r, c) in texels from its corner, its edges continued; (r, c, 3)."""
    height, width = image.shape[:2]
    left, low = np.floor(x - 0.5), np.floor(y - 0.5)
    a, b = (x - 0.5 - left)[..., None], (y - 0.5 - low)[..., None]
    i = [np.clip(left.astype(int) + k, 0, width - 1) for k in (0, 1)]
    j = [np.clip(low.astype(int) + k, 0, height - 1) for k in (0, 1)]
    bottom = image[j[0], i[0]] * (1.0 - a) + image[j[0], i[1]] * a
    top = image[j[1], i[0]] * (1.0 - a) + image[j[1], i[1]] * a
    return bottom * (1.0 - b) + top * b
