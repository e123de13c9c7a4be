"""Which passes a picture needs: those that can show something in it, and what these read.

The web client carries the same few lines; ``tests/golden/views.json`` pins both.
"""

import math
from collections.abc import Iterable, Mapping

from seafoam.framegraph.evaluation import axes
from seafoam.framegraph.passes import Ball, Pass, View
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import TargetInput
from seafoam.scene.models import Camera

LEVEL = 0.01
"""Rays that fall or rise by less, of the picture's middle ray, may meet either water or sky."""


def drawn_passes(plan: FramePlan, camera: Camera, width: int, height: int, target: str) -> dict[int, bool]:
    """Positions of the passes that ``target`` needs, in drawing order; False: only to clear what it draws into.

    ``camera``: from where, ``width`` × ``height`` pixels. A pass is needed where it draws into something that is needed
    and is of this eye's kind; one out of view (:attr:`seafoam.framegraph.passes.Pass.view`) only if it clears.
    """
    eye = "over" if camera.position[1] >= plan.top else "under"
    needed = {target}
    found: dict[int, bool] = {}
    for index, one in reversed([*enumerate(plan.passes)]):
        if one.eye not in ("any", eye) or one.target not in needed:
            continue
        shows = in_view(one.view, plan.top, camera, width, height)
        if shows or one.state.clear:
            found[index] = shows
        if shows:
            needed |= reads(one)
    return dict(sorted(found.items()))


def passes_into(passes: Mapping[int, Pass], targets: Iterable[str]) -> dict[int, Pass]:
    """Of ``passes`` by position those that draw into ``targets`` or into what these read, in drawing order."""
    needed = set(targets)
    found: dict[int, Pass] = {}
    for index, one in sorted(passes.items(), reverse=True):
        if one.target in needed:
            found[index] = one
            needed |= reads(one)
    return dict(sorted(found.items()))


def reads(one: Pass) -> set[str]:
    """The targets that a pass reads."""
    return {source.target for source in one.inputs.values() if isinstance(source, TargetInput)}


def everywhere(plan: FramePlan) -> FramePlan:
    """The plan with every pass drawn for its eye, whether what it shows is in the picture or not."""
    return plan.model_copy(update={"passes": tuple(one.model_copy(update={"view": "any"}) for one in plan.passes)})


def in_view(view: View, top: float, camera: Camera, width: int, height: int) -> bool:
    """Whether a pass of this view can show something. ``top``: the highest that a crest can reach, m."""
    if view == "any":
        return True
    right, up, forward = axes(camera)
    tangent = math.tan(0.5 * camera.fov)
    sides = (right, tangent * width / height), (up, tangent)
    if isinstance(view, tuple):
        return any(_meets(ball, camera, forward, sides) for ball in view)
    if camera.position[1] < top:
        return True
    spread = sum(reach * abs(axis[1]) for axis, reach in sides)
    return forward[1] + spread >= -LEVEL if view == "rising" else forward[1] - spread <= LEVEL


_Axis = tuple[float, float, float]


def _meets(ball: Ball, camera: Camera, forward: _Axis, sides: tuple[tuple[_Axis, float], ...]) -> bool:
    """Whether a ball meets the pyramid of the picture's rays; it may say yes to one that only comes near an edge."""
    way = [place - eye for place, eye in zip(ball.centre, camera.position, strict=True)]
    ahead = _dot(way, forward)
    if ahead < -ball.radius:
        return False
    return all(abs(_dot(way, axis)) - ahead * reach <= ball.radius * math.hypot(1.0, reach) for axis, reach in sides)


def _dot(a: list[float], b: _Axis) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
