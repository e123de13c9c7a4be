"""The planner: scenes become frame plans.

It knows slots and passes; of effects it knows what they contribute, and no formula.
"""

from seafoam.effects.effect import AssemblyError, PlanError
from seafoam.framegraph.plan import FramePlan
from seafoam.planner.planner import make_plan

__all__ = ["AssemblyError", "FramePlan", "PlanError", "make_plan"]
