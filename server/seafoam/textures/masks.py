"""Textures of halftone masks. docs/masks.md."""

from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from seafoam.masks.catalogue import drawn_mask
from seafoam.masks.formats import quantised
from seafoam.masks.prefilter import atlas
from seafoam.scene import MASK_NAME, MASKS_MOST
from seafoam.textures.spec import Image, TextureSpec

MaskTable = Literal["ranks", "ranks-8", "thresholds-half", "atlas", "quantiles", "ramps"]
_JOINED = ("quantiles", "ramps")


class MaskTexture(TextureSpec):
    """A table of a mask, or of several over one another: those of living foam, youngest first.

    ``ranks`` (R16UI), ``ranks-8`` (R8UI) and ``thresholds-half`` (R16F): the mask itself; ``atlas`` (RG32UI): see
    :func:`seafoam.masks.prefilter.atlas`; ``quantiles`` (RG32F): an entry and the next, a row for the magnified mask
    and one for each level; ``ramps``: the same of an octave's ramp.
    """

    kind: ClassVar[str] = "mask"
    masks: tuple[Annotated[str, Field(max_length=40, pattern=MASK_NAME)], ...] = Field(
        min_length=1, max_length=1 + MASKS_MOST
    )
    table: MaskTable

    @model_validator(mode="after")
    def _joins(self) -> Self:
        if len(self.masks) > 1 and self.table not in _JOINED:
            raise ValueError(f"table: several masks have only {' and '.join(_JOINED)}")
        return self

    @property
    def address(self) -> str:
        """``mask/NAME/TABLE``, names joined by +: short enough to be written by hand."""
        return f"{self.kind}/{'+'.join(self.masks)}/{self.table}"

    @classmethod
    def of_fields(cls, text: str) -> Self:
        """Return the texture called ``NAME/TABLE``. Raises ``ValueError``."""
        names, _, table = text.partition("/")
        return cls.model_validate({"masks": names.split("+"), "table": table})

    def image(self) -> Image:
        """Return the table. Raises ``UnknownMaskError``, or ``ValueError`` for masks of different sizes."""
        masks = [drawn_mask(name) for name in self.masks]
        if len({mask.ranks.shape for mask in masks}) > 1:
            raise ValueError("masks: must be of one size")
        mask = masks[0]
        match self.table:
            case "ranks":
                return Image("R16UI", (quantised(mask.ranks, 16).astype("<u2"),))
            case "ranks-8":
                return Image("R8UI", (quantised(mask.ranks, 8).astype(np.uint8),))
            case "thresholds-half":
                return Image("R16F", (mask.thresholds.astype("<f2"),))
            case "atlas":
                return Image("RG32UI", (atlas(mask.ranks, mask.spans).astype("<u4"),))
            case "quantiles":
                return _entries([one.filtering.quantiles for one in masks])
            case "ramps":
                return _entries([one.filtering.ramps for one in masks])


def _entries(tables: list[NDArray[np.float64]]) -> Image:
    """Return tables (rows, n) with each entry followed by the next, so that one fetch reads both."""
    whole = np.concatenate(tables)
    return Image("RG32F", (np.stack((whole[:, :-1], whole[:, 1:]), axis=-1).astype("<f4"),))
