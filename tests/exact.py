"""The quality at which samples are held to the truth, which knows nothing of footprints."""

from seafoam.quality import TIERS

_REFERENCE = TIERS["reference"]
UNFILTERED = _REFERENCE.model_copy(update={"surface": _REFERENCE.surface.model_copy(update={"filter": False})})
"""Tier reference with every wave and ripple whole at every sample."""
