"""Which passes a picture needs."""

import json
import math
from pathlib import Path

import pytest

from seafoam.framegraph.passes import BoundingSphere
from seafoam.framegraph.visibility import drawn_passes, in_view
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.camera import Camera
from seafoam.scene.presets import load_preset

GOLDEN = json.loads((Path(__file__).parents[2] / "golden" / "views.json").read_text(encoding="utf-8"))
PRESETS = {(entry["preset"], entry["tier"]): entry for entry in GOLDEN}


@pytest.mark.parametrize(("preset", "tier"), PRESETS)
def test_pinned_views_are_those_of_today(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene, TIERS[tier])
    for picture in PRESETS[preset, tier]["pictures"]:
        drawn = drawn_passes(
            plan, Camera.model_validate(picture["camera"]), picture["width"], picture["height"], "screen"
        )
        assert [[index, shows] for index, shows in drawn.items()] == picture["drawn"]


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
