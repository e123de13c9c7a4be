"""Frame plans: compiled scenes."""

from seafoam.effects.contribution import PlanError
from seafoam.plan.model import FramePlan
from seafoam.plan.planner import AssemblyError, make_plan

__all__ = ["AssemblyError", "FramePlan", "PlanError", "make_plan"]
