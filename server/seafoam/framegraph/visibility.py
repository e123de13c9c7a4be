"""Selects the passes that a picture needs: those that can be visible in it, and their inputs.

The web client implements the same function; ``tests/golden/views.json`` tests both.
"""

import math
from collections.abc import Iterable, Mapping

from seafoam.framegraph.evaluation import axes
from seafoam.framegraph.plan import BoundingSphere, Eye, FramePlan, Pass, View
from seafoam.framegraph.resources import TargetInput
from seafoam.scene import Camera
from seafoam.sums import summed

LEVEL = 0.01
"""Vertical component, relative to the central ray's length, below which a ray may hit water or sky."""


def eye_of(plan: FramePlan, camera: Camera) -> Eye:
    """Return the camera's height relative to the plan's crests and troughs."""
    height = camera.position[1]
    return "over" if height >= plan.top else "between" if height >= plan.trough else "under"


def applies_to(drawn: Pass, eye: Eye) -> bool:
    return drawn.eye == "any" or eye in drawn.eye


def drawn_passes(plan: FramePlan, camera: Camera, width: int, height: int, target: str) -> dict[int, bool]:
    """Return the indices of the passes that ``target`` needs, in drawing order; False: only to clear their target.

    ``camera``: viewpoint, ``width`` × ``height`` pixels. A pass is needed if it draws into a target that is needed and
    matches the camera height; one out of view (:attr:`seafoam.framegraph.plan.Pass.view`) only if it clears.
    """
    eye = eye_of(plan, camera)
    needed = {target}
    selected: dict[int, bool] = {}
    for index, drawn in reversed([*enumerate(plan.passes)]):
        if not applies_to(drawn, eye) or drawn.target not in needed:
            continue
        visible = in_view(drawn.view, plan.top, camera, width, height)
        if visible or drawn.state.clear:
            selected[index] = visible
        if visible:
            needed |= reads(drawn)
    return dict(sorted(selected.items()))


def passes_into(passes: Mapping[int, Pass], targets: Iterable[str]) -> dict[int, Pass]:
    """Return those of ``passes`` by index that draw into ``targets`` or into their inputs, in drawing order."""
    needed = set(targets)
    selected: dict[int, Pass] = {}
    for index, drawn in sorted(passes.items(), reverse=True):
        if drawn.target in needed:
            selected[index] = drawn
            needed |= reads(drawn)
    return dict(sorted(selected.items()))


def reads(drawn: Pass) -> set[str]:
    return {source.target for source in drawn.inputs.values() if isinstance(source, TargetInput)}


def in_view(view: View, top: float, camera: Camera, width: int, height: int) -> bool:
    """Whether a pass of this view can be visible. ``top``: upper bound of the crests' height, m."""
    if view == "any":
        return True
    right, up, forward = axes(camera)
    tangent = math.tan(0.5 * camera.fov)
    sides = (right, tangent * width / height), (up, tangent)
    if isinstance(view, tuple):
        return any(_intersects(sphere, camera, forward, sides) for sphere in view)
    if camera.position[1] < top:
        return True
    spread = summed(reach * abs(axis[1]) for axis, reach in sides)
    return forward[1] + spread >= -LEVEL if view == "rising" else forward[1] - spread <= LEVEL


_Axis = tuple[float, float, float]


def _intersects(sphere: BoundingSphere, camera: Camera, forward: _Axis, sides: tuple[tuple[_Axis, float], ...]) -> bool:
    """Whether a bounding sphere intersects the pyramid of the picture's rays; conservative near its edges."""
    offset = [centre - eye for centre, eye in zip(sphere.centre, camera.position, strict=True)]
    ahead = _dot(offset, forward)
    if ahead < -sphere.radius:
        return False
    return all(
        abs(_dot(offset, axis)) - ahead * reach <= sphere.radius * math.hypot(1.0, reach) for axis, reach in sides
    )


def _dot(a: list[float], b: _Axis) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
