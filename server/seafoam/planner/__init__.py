"""The planner: compiles scenes into frame plans. It contains no formula of an effect."""

from seafoam.effects.effect import PlanError
from seafoam.framegraph.plan import FramePlan
from seafoam.planner.planner import make_geometry_plan, make_plan

__all__ = ["FramePlan", "PlanError", "make_geometry_plan", "make_plan"]
