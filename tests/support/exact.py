"""The qualities at which samples are held to the truth, and plans that leave nothing out."""

from unittest.mock import patch

from seafoam.framegraph.plan import FramePlan
from seafoam.planner import collect, make_plan
from seafoam.quality import EXACT, TIERS, Quality
from seafoam.scene import Scene

__all__ = ["EXACT", "SQUARE", "UNFILTERED", "everywhere", "whole_plan"]

SQUARE = TIERS["standard"].model_copy(update={"pixel_width": 1})
"""Tier ``standard`` with a sample for every pixel, so that pixels can be compared one by one."""

UNFILTERED = EXACT.model_copy(update={"samples": 16})
"""The formulas alone, 16 samples a pixel."""


def whole_plan(scene: Scene, quality: Quality) -> FramePlan:
    """Return the plan of everything that a scene names, drawn from everywhere, even if it cannot be seen."""
    with patch.object(collect, "NEGLIGIBLE", -1.0):
        return everywhere(make_plan.__wrapped__(scene, quality))


def everywhere(plan: FramePlan) -> FramePlan:
    """Return the plan without culling: every pass is drawn for its camera height, visible or not."""
    return plan.model_copy(update={"passes": tuple(drawn.model_copy(update={"view": "any"}) for drawn in plan.passes)})
