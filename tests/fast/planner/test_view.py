"""Which passes a picture needs."""

import json
import math
from pathlib import Path

import pytest

from seafoam.framegraph.passes import BoundingSphere
from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.visibility import applies_to, drawn_passes, in_view
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.boats import Boat
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.water import Ripples, Water
from seafoam.scene.waves import ParametricWave

GOLDEN = json.loads((Path(__file__).parents[2] / "golden" / "views.json").read_text(encoding="utf-8"))
PRESETS = {(entry["preset"], entry["tier"]): entry for entry in GOLDEN}


def names(plan: FramePlan, camera: Camera, target: str = "screen") -> list[str]:
    """Names of the passes that draw, in order."""
    shown = drawn_passes(plan, camera, 320, 180, target)
    return [plan.passes[index].name for index, shows in shown.items() if shows]


@pytest.mark.parametrize(("preset", "tier"), PRESETS)
def test_pinned_views_are_those_of_today(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene, TIERS[tier])
    for picture in PRESETS[preset, tier]["pictures"]:
        drawn = drawn_passes(
            plan, Camera.model_validate(picture["camera"]), picture["width"], picture["height"], "screen"
        )
        assert [[index, shows] for index, shows in drawn.items()] == picture["drawn"]


def test_what_nothing_reads_is_not_drawn() -> None:
    scene = Scene(waves=(ParametricWave(),), water=Water(ripples=Ripples()), light=Light())
    plan = make_plan(scene, TIERS["standard"])
    up, down = (Camera(position=(0.0, 30.0, 0.0), pitch=pitch) for pitch in (1.0, -1.0))
    assert names(plan, Camera()) == [one.name for one in plan.passes if applies_to(one, "over")]
    assert names(plan, down) == [name for name in names(plan, Camera()) if name != "sky"]
    # No water, so no ripples either.
    assert names(plan, up) == ["sky", "tone"]
    assert names(plan, down, plan.linear)[-1] == "surface"


def test_a_boat_is_drawn_where_its_course_is_seen() -> None:
    boat = Boat(centre=(0.0, -100.0), radius=30.0)
    plan = make_plan(Scene(boats=(boat,)), TIERS["standard"])
    high = Camera(position=(0.0, 5.0, 0.0))
    for yaw, seen in ((0.0, True), (0.6, True), (1.2, False), (math.pi, False), (-1.2, False)):
        assert ("boats" in names(plan, high.model_copy(update={"yaw": yaw}))) == seen
    assert "boats" in names(plan, Camera(position=(0.0, 5.0, -100.0), yaw=2.0))


def test_spheres_are_seen_where_they_touch_the_picture() -> None:
    camera = Camera(position=(1.0, 2.0, 3.0), pitch=0.0, fov=math.pi / 2)
    for centre, radius, seen in (
        ((1.0, 2.0, -7.0), 0.0, True),
        ((1.0, 2.0, 4.0), 0.5, False),
        ((1.0, 2.0, 4.0), 1.5, True),
        ((1.0, 22.0, -7.0), 7.0, False),
        ((1.0, 22.0, -7.0), 7.2, True),
        ((31.0, 2.0, -7.0), 4.4, False),
        ((31.0, 2.0, -7.0), 4.5, True),
    ):
        assert in_view((BoundingSphere(centre=centre, radius=radius),), 0.0, camera, 200, 100) == seen
    assert not in_view((), 0.0, camera, 200, 100)
