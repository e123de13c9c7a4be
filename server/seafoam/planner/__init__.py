"""Frame plans: what a scene compiles to."""

from seafoam.effects.effect import PlanError
from seafoam.framegraph.plan import FramePlan
from seafoam.planner.collect import AssemblyError
from seafoam.planner.planner import make_plan

__all__ = ["AssemblyError", "FramePlan", "PlanError", "make_plan"]
