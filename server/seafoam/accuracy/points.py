"""The points of a sweep: the tiers, and tier standard with one setting changed at a time."""

import json
from collections.abc import Iterator
from itertools import groupby, pairwise

from seafoam.accuracy.model import ParameterChoice, ParameterValue, Point
from seafoam.accuracy.parameters import all_parameters, with_value
from seafoam.quality import TIERS, Quality
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
    for choice, quality, plan in _settings(scene):
        if plan not in seen:
            seen.add(plan)
            name, value = choice.pointer[1:].replace("/", "."), shown(choice.value)
            label = f"{choice.title}: {value}"
            made = Point(id=f"{name}={value}", label=label, tier=None, parameter=choice, quality=quality, plan=plan)
            points.append(made)
    return tuple(points)


def chains(scene: Scene, points: tuple[Point, ...]) -> list[tuple[ParameterChoice, ParameterChoice, str, str]]:
    """Return neighbouring values of each setting whose plans differ: (from, to, point from, point to)."""
    by_plan = {point.plan: point.id for point in points}
    pairs = []
    for _, settings in groupby(_settings(scene), lambda setting: (setting[0].owner, setting[0].pointer)):
        known = [(choice, by_plan[plan]) for choice, _, plan in settings if plan in by_plan]
        # Of neighbours with one plan, the first.
        links = [next(alike) for _, alike in groupby(known, lambda link: link[1])]
        pairs += [(before, after, first, second) for (before, first), (after, second) in pairwise(links)]
    return pairs


def _settings(scene: Scene) -> Iterator[tuple[ParameterChoice, Quality, str]]:
    """Yield every value of every setting of a scene: the choice, tier standard with it, and the hash of that plan."""
    for owner, parameter in all_parameters(scene):
        said = {"owner": owner, "pointer": parameter.pointer, "title": parameter.title, "cause": parameter.cause}
        for value in parameter.steps:
            quality = with_value(TIERS["standard"], parameter.pointer, value)
            choice = ParameterChoice(**said, value=value)
            yield choice, quality, plan_hash(scene, quality)


def shown(value: ParameterValue) -> str:
    """Return the value of a setting as JSON without quotes."""
    return value if isinstance(value, str) else json.dumps(value)
