"""The knobs of quality: those of the effects that run in a scene, and those of the planner's own spine."""

from typing import Any

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Cause, Knob
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene.models import Scene

SPINE = "frame"
"""Owner of the knobs that no effect owns: how the surface is found, how often, and with how many digits."""

SPINE_KNOBS: tuple[Knob, ...] = (
    Knob("/surface/method", "way to the surface", ("mesh", "march"), "geometry"),
    Knob("/surface/steps", "greatest number of march steps", (48, 96, 192, 384), "geometry"),
    Knob("/surface/tolerance", "end of the march, heights of a sample", (0.5, 0.2, 0.05, 0.02, 0.002), "geometry"),
    Knob("/surface/cells", "cells of the mesh along a side", (48, 96, 192, 384), "geometry"),
    Knob("/surface/refine", "Newton steps", (0, 1, 2, 4), "geometry"),
    Knob("/surface/filter", "waves under a pixel become roughness", (False, True), "filtering"),
    Knob("/samples", "samples a pixel", (1, 4, 9, 16), "filtering"),
    Knob("/samples_max", "samples of a pixel that stands out", (1, 4, 16), "filtering"),
    Knob("/samples_budget", "further samples, in the mean", (0.5, 1.0, 2.0), "filtering"),
    Knob("/samples_threshold", "contrast of a pixel that stands out", (0.1, 0.02, 0.004), "filtering"),
    Knob("/target", "digits of the linear frame", ("RGBA16F", "RGBA32F"), "precision"),
)


def every_knob() -> tuple[tuple[str, Knob], ...]:
    """Every knob there is, with the name of its owner."""
    spine = tuple((SPINE, knob) for knob in SPINE_KNOBS)
    return spine + tuple((effect.name, knob) for effect in EFFECTS for knob in effect.knobs)


def all_knobs(scene: Scene) -> tuple[tuple[str, Knob], ...]:
    """The spine's knobs and those of the effects that run in this scene, each with the name of its owner.

    Raises :class:`seafoam.planner.PlanError` for a scene that cannot be planned.
    """
    running = {SPINE} | {effect.name for effect in make_plan(scene, TIERS["standard"]).effects}
    return tuple((owner, knob) for owner, knob in every_knob() if owner in running)


def value_at(quality: Quality, pointer: str) -> Any:
    """The value that a JSON pointer names."""
    found: Any = quality
    for member in pointer.split("/")[1:]:
        found = getattr(found, member)
    return found


def with_value(quality: Quality, pointer: str, value: Any) -> Quality:
    """The quality with one value changed. Raises ``ValidationError`` where it is out of range."""
    document = quality.model_dump()
    *path, last = pointer.split("/")[1:]
    inner = document
    for member in path:
        inner = inner[member]
    if last not in inner:
        raise KeyError(pointer)
    inner[last] = value
    return Quality.model_validate(document)


def idealised(quality: Quality, cause: Cause, knobs: tuple[tuple[str, Knob], ...]) -> Quality:
    """The quality with every knob of one cause where the tier ``reference`` has it."""
    for _, knob in knobs:
        if knob.cause == cause:
            quality = with_value(quality, knob.pointer, value_at(TIERS["reference"], knob.pointer))
    return quality
