"""Formats of textures, targets and pictures, as moderngl names them."""

from typing import Literal

import numpy as np

Output = Literal["rgba8", "rgba16", "linear", "samples"]

TEXTURE_FORMATS = {
    "R8": (1, "f1"),
    "R8UI": (1, "u1"),
    "R16UI": (1, "u2"),
    "RG32UI": (2, "u4"),
    "R16F": (1, "f2"),
    "R32F": (1, "f4"),
    "RG32F": (2, "f4"),
    "RGBA32F": (4, "f4"),
}
"""Components and moderngl dtype of each texture format."""

TARGET_FORMATS = {
    "RGBA16": (4, "nu2"),
    "RGBA16F": (4, "f2"),
    "RGBA32F": (4, "f4"),
    "RGBA8": (4, "f1"),
    "RG32UI": (2, "u4"),
}
"""Components and moderngl dtype of each target format."""

READ: dict[Output, tuple[str, Literal["f1", "nu2", "f4"], type[np.uint8 | np.uint16 | np.float32]]] = {
    "rgba8": ("RGBA8", "f1", np.uint8),
    "rgba16": ("RGBA16", "nu2", np.uint16),
    "linear": ("RGBA8", "f4", np.float32),
    "samples": ("RGBA8", "f4", np.float32),
}
"""Format of the displayed picture's target; moderngl dtype and type of what is read."""
