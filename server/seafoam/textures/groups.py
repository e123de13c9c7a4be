"""The field of wave groups, as a tile that the waves read. docs/formulae.md, section 2."""

import math
from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from seafoam.ocean.groups import AMPLITUDE, TEXELS, group_waves
from seafoam.textures.spec import Image, TextureSpec


class WaveGroupField(TextureSpec):
    """The field and its gradient over a period, RGBA16F (128, 128): (n, ∂n/∂x, ∂n/∂z, 0), see :func:`group_field`."""

    kind: ClassVar[str] = "wave-groups"

    seed: int = Field(ge=0, le=65535)

    def image(self) -> Image:
        """Return :func:`group_field` as half floats."""
        return Image("RGBA16F", (group_field(self.seed).astype("<f2"),))


@lru_cache(maxsize=16)
def group_field(seed: int) -> NDArray[np.float64]:
    """(TEXELS, TEXELS, 4) float64, row z, column x: n = sin X in [−1, 1], its derivatives per period, and 0.

    X is the sum of the cosines of :func:`group_waves`. Sines by ``math`` alone, so that every machine has the same
    bytes.
    """
    step = np.arange(TEXELS)
    x, by_x, by_z = (np.zeros((TEXELS, TEXELS)) for _ in range(3))
    for ix, iz, phase in group_waves(seed):
        angles = [2.0 * math.pi * j / TEXELS + phase for j in range(TEXELS)]
        place = (ix * step[None, :] + iz * step[:, None]) % TEXELS
        x += AMPLITUDE * np.array([math.cos(angle) for angle in angles])[place]
        slope = -2.0 * math.pi * AMPLITUDE * np.array([math.sin(angle) for angle in angles])[place]
        by_x += ix * slope
        by_z += iz * slope
    flat = x.ravel().tolist()
    n = np.array([math.sin(value) for value in flat]).reshape(x.shape)
    change = np.array([math.cos(value) for value in flat]).reshape(x.shape)
    field = np.stack((n, change * by_x, change * by_z, np.zeros_like(x)), axis=-1)
    field.flags.writeable = False
    return field
