"""Section 7: the tone curves, and the sRGB curve of displays. Colours are RGB along the last axis."""

import numpy as np

from seafoam.reference.types import Floats
from seafoam.scene import ToneCurve


def tone(x: Floats, curve: ToneCurve = "filmic") -> Floats:
    """The tone curve of linear light x ≥ 0 (..., 3), in [0, 1]; of the shape of ``x``. ``curve``: ``light.tone``."""
    if curve == "filmic":
        return np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)
    # Photographic: with a long shoulder.
    squares = (x * x).sum(axis=-1, keepdims=True)
    norm = (x**3).sum(axis=-1, keepdims=True) / np.maximum(squares, 1e-12)
    level = _shoulder(norm)
    hue: Floats = np.maximum(1.0 + 1.2 * (x / np.maximum(norm, 1e-6) - 1.0), 0.0)
    return np.clip(level * hue + level * level * (_shoulder(x) - level * hue), 0.0, 1.0)


def _shoulder(x: Floats) -> Floats:
    return np.minimum(1.01 * x * (x + 0.02) / (x * (x + 0.42) + 0.05), 1.0)


def srgb(x: Floats) -> Floats:
    """The sRGB curve of linear light in [0, 1]; of the shape of ``x``."""
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 0.0031308) ** (1.0 / 2.4) - 0.055)
