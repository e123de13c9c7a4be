"""The points of a sweep: the tiers, and tier standard with one setting changed at a time."""

import json
from itertools import pairwise

from seafoam.accuracy.model import ParameterChoice, ParameterValue, Point
from seafoam.accuracy.parameters import all_parameters, with_value
from seafoam.quality import TIERS
from seafoam.render.service.jobs import plan_hash
from seafoam.scene.models import Scene


def points_of(scene: Scene) -> tuple[Point, ...]:
    """Return every quality measured for a scene, no two with the same plan; tiers first, fastest first.

    Raises :class:`seafoam.planner.PlanError` for a scene that cannot be planned.
    """
    seen = {plan_hash(scene, TIERS["standard"])}
    points = []
    for tier, quality in TIERS.items():
        plan = plan_hash(scene, quality)
        if tier == "standard" or plan not in seen:
            seen.add(plan)
            points.append(Point(id=tier, label=tier, tier=tier, parameter=None, quality=quality, plan=plan))
    standard = TIERS["standard"]
    for owner, parameter in all_parameters(scene):
        for value in parameter.steps:
            quality = with_value(standard, parameter.pointer, value)
            plan = plan_hash(scene, quality)
            if plan in seen:
                continue
            seen.add(plan)
            points.append(
                Point(
                    id=point_id(parameter.pointer, value),
                    label=f"{parameter.title}: {shown(value)}",
                    tier=None,
                    parameter=ParameterChoice(
                        owner=owner,
                        pointer=parameter.pointer,
                        title=parameter.title,
                        cause=parameter.cause,
                        value=value,
                    ),
                    quality=quality,
                    plan=plan,
                )
            )
    return tuple(points)


def chains(scene: Scene, points: tuple[Point, ...]) -> list[tuple[str, ParameterChoice, ParameterChoice, str, str]]:
    """Return neighbouring values of each setting whose plans differ: (owner, from, to, point from, point to)."""
    by_plan = {point.plan: point.id for point in points}
    pairs = []
    for owner, parameter in all_parameters(scene):
        links: list[tuple[ParameterChoice, str]] = []
        for value in parameter.steps:
            plan = plan_hash(scene, with_value(TIERS["standard"], parameter.pointer, value))
            choice = ParameterChoice(
                owner=owner, pointer=parameter.pointer, title=parameter.title, cause=parameter.cause, value=value
            )
            if plan in by_plan and (not links or links[-1][1] != by_plan[plan]):
                links.append((choice, by_plan[plan]))
        pairs += [
            (owner, before, after, id_before, id_after) for (before, id_before), (after, id_after) in pairwise(links)
        ]
    return pairs


def point_id(pointer: str, value: ParameterValue) -> str:
    """Return the name of tier standard with one setting changed."""
    return f"{pointer[1:].replace('/', '.')}={shown(value)}"


def shown(value: ParameterValue) -> str:
    """Return the value of a setting as JSON without quotes."""
    return value if isinstance(value, str) else json.dumps(value)
