"""The corners of the noise of wave groups. docs/formulae.md, section 2."""

from typing import ClassVar

import numpy as np
from pydantic import Field

from seafoam.ocean.groups import PERIOD, group_corners
from seafoam.textures.spec import Image, TextureSpec


class WaveGroupCorners(TextureSpec):
    """Four corners of each cell, RG32UI (PERIOD, PERIOD), row along the second axis.

    Red holds those at the cell's (0, 0) and, 16 bits up, (1, 0); green those at (0, 1) and (1, 1).
    """

    kind: ClassVar[str] = "wave-groups"

    seed: int = Field(ge=0, le=65535)

    def image(self) -> Image:
        """Return :func:`seafoam.ocean.groups.group_corners`, packed."""
        here = group_corners(self.seed).astype(np.uint32)
        right = np.roll(here, -1, axis=1)
        pairs = here | right << np.uint32(16)
        assert pairs.shape == (PERIOD, PERIOD)
        return Image("RG32UI", (np.stack((pairs, np.roll(pairs, -1, axis=0)), axis=-1).astype("<u4"),))
