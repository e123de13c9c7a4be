"""The qualities at which samples are held to the truth."""

from seafoam.quality import EXACT

__all__ = ["EXACT", "UNFILTERED"]

UNFILTERED = EXACT.model_copy(update={"samples": 16})
"""The formulas alone, 16 samples a pixel."""
