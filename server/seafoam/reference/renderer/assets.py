"""Masks and textures that foam reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seafoam.masks import Mask, mask_by_name
from seafoam.ocean.stokes import foam_life
from seafoam.reference import sampling
from seafoam.reference.types import Floats
from seafoam.scene.models import Scene
from seafoam.textures import foam_texture


@dataclass(frozen=True, eq=False)
class Assets:
    """Masks and textures that foam reads."""

    thresholds: Floats
    """Thresholds m of the mask, (size, size), row v and column u."""
    spans: list[Floats]
    """Levels of (low, width), the range of the thresholds in each texel; level l is (size/2^l, size/2^l, 2)."""
    quantiles: Floats
    """Tables of Q, see :func:`sampling.quantile`, (1 + levels, 65): of the B-spline mask, then of each level."""
    ramps: Floats
    """Tables of an octave's ramp, (2 + levels, 65): of the B-spline mask, of each level, width over the former."""
    texture: list[Floats]
    """Box-averaged levels of the foam texture t in [0, 1]."""
    older: tuple[Assets, ...] = ()
    """The same of the masks of older foam."""

    @staticmethod
    def of(mask: Mask, texture: Floats, older: Sequence[Mask] = ()) -> Assets:
        """From a mask, a foam texture (size, size) in [0, 1] and masks of older foam."""
        return Assets(
            older=tuple(Assets.of(other, texture) for other in older if other.ranks.shape == mask.ranks.shape),
            thresholds=sampling.thresholds(mask.ranks),
            spans=[level.astype(np.float64) for level in mask.spans],
            quantiles=mask.quantiles,
            ramps=mask.ramps,
            texture=sampling.box_chain(np.asarray(texture, np.float64)),
        )

    @staticmethod
    def for_scene(scene: Scene) -> Assets | None:
        """The images of a scene's foam; None without foam. Raises ``KeyError`` or ``ValueError`` for a bad mask."""
        if scene.foam is None:
            return None
        life = foam_life(scene)
        older = [mask_by_name(name) for name in life.masks] if life is not None else []
        return Assets.of(mask_by_name(scene.foam.mask), foam_texture(), older)
