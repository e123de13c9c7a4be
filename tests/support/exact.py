"""The qualities at which samples are held to the truth."""

from seafoam.quality import EXACT, TIERS

__all__ = ["EXACT", "SQUARE", "UNFILTERED"]

SQUARE = TIERS["standard"].model_copy(update={"pixel_width": 1})
"""Tier ``standard`` with a sample for every pixel, so that pixels can be compared one by one."""

UNFILTERED = EXACT.model_copy(update={"samples": 16})
"""The formulas alone, 16 samples a pixel."""
