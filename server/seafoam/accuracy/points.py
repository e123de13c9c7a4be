"""The quality settings, of effects and of the planner itself, and the points of a sweep.

Points are the tiers, and tier standard with one setting changed at a time.
"""

import json
from collections.abc import Iterator
from itertools import groupby, pairwise
from typing import Any

from seafoam.accuracy.model import ParameterChoice, ParameterValue, Point
from seafoam.effects import EFFECTS, outside
from seafoam.effects.effect import Cause, QualityParameter
from seafoam.extensions import Extensions
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.service.jobs import plan_hash
from seafoam.scene import Scene

SPINE = "frame"
"""Owner of the settings that no effect owns: surface intersection, number of samples, and number format."""

SPINE_KNOBS: tuple[QualityParameter, ...] = (
    QualityParameter("/surface/method", "surface intersection", ("mesh", "march"), "geometry"),
    QualityParameter("/surface/steps", "maximum ray-marching steps", (48, 96, 192, 384), "geometry"),
    QualityParameter(
        "/surface/tolerance", "ray-marching tolerance, sample heights", (0.5, 0.2, 0.1, 0.02, 0.002), "geometry"
    ),
    QualityParameter("/surface/cells", "mesh cells per side", (48, 96, 192, 384), "geometry"),
    QualityParameter("/surface/refine", "Newton steps", (0, 1, 2, 4), "geometry"),
    QualityParameter("/surface/filter", "waves below a pixel become roughness", (False, True), "filtering"),
    QualityParameter("/samples", "samples per pixel", (1, 4, 9, 16), "filtering"),
    QualityParameter("/pixel_width", "width of a drawn pixel, pixels", (1, 2, 3, 4), "filtering"),
    QualityParameter("/samples_max", "maximum samples of an adaptive pixel", (1, 4, 16), "filtering"),
    QualityParameter("/samples_budget", "mean additional samples per pixel", (0.5, 1.0, 2.0), "filtering"),
    QualityParameter("/samples_threshold", "contrast threshold of adaptive samples", (0.1, 0.02, 0.004), "filtering"),
    QualityParameter("/target", "format of the linear frame", ("RGBA16F", "RGBA32F"), "precision"),
)


def every_parameter() -> tuple[tuple[str, QualityParameter], ...]:
    """Return every setting, with the name of its owner."""
    spine = tuple((SPINE, parameter) for parameter in SPINE_KNOBS)
    return spine + tuple(
        (effect.name, parameter) for effect in (*EFFECTS, *outside()) for parameter in effect.parameters
    )


def all_parameters(scene: Scene) -> tuple[tuple[str, QualityParameter], ...]:
    """Return the planner's settings and those of the effects in this scene, each with the name of its owner.

    Raises :class:`seafoam.planner.PlanError` for a scene that cannot be planned.
    """
    running = {SPINE} | {effect.name for effect in make_plan(scene, TIERS["standard"]).effects}
    return tuple((owner, parameter) for owner, parameter in every_parameter() if owner in running)


def value_at(quality: Quality, pointer: str) -> Any:
    value: Any = quality
    for member in pointer.split("/")[1:]:
        value = value.part(member) if isinstance(value, Extensions) else getattr(value, member)
    return value


def with_value(quality: Quality, pointer: str, value: Any) -> Quality:
    """Return the quality with one value changed. Raises ``ValidationError`` if it is out of range, or unknown."""
    document = quality.model_copy(update={"extensions": quality.extensions.with_defaults()}).model_dump()
    *path, last = pointer.split("/")[1:]
    inner = document
    for member in path:
        inner = inner[member]
    inner[last] = value
    return Quality.model_validate(document)


def idealised(quality: Quality, cause: Cause) -> Quality:
    """Return the quality with every setting of one cause as in tier ``reference``."""
    for _, parameter in every_parameter():
        if parameter.cause == cause:
            quality = with_value(quality, parameter.pointer, value_at(TIERS["reference"], parameter.pointer))
    return quality


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
    return value if isinstance(value, str) else json.dumps(value)
