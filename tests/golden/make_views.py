"""Writes the golden vectors that pin which passes both executors draw; run it as a script."""

import json
import math
from pathlib import Path

from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import TargetInput
from seafoam.framegraph.visibility import drawn_passes
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.camera import Camera
from seafoam.scene.presets import load_preset

PATH = Path(__file__).with_name("views.json")

PLANS = (("default", "standard"), ("boat-race", "standard"), ("boat-in-storm", "fast"), ("island-surf", "standard"))

CAMERAS = (
    Camera(),
    Camera(position=(0.0, 60.0, 0.0), pitch=-math.pi / 2),
    Camera(position=(0.0, 60.0, 0.0), pitch=math.pi / 2),
    Camera(position=(0.0, 60.0, 0.0), pitch=0.9, fov=0.6),
    Camera(position=(0.0, 60.0, 0.0), pitch=-0.5, fov=0.9, roll=0.4),
    Camera(position=(0.0, 60.0, 0.0), pitch=-0.5, fov=1.1, yaw=math.pi),
    Camera(position=(0.0, -3.0, 0.0), pitch=1.2),
    Camera(position=(1e7, 40.0, -1e7), pitch=-0.1),
    Camera(position=(300.0, 8.0, 300.0), yaw=1.0, fov=0.4),
)

SIZES = ((320, 180), (90, 400))


def small(plan: FramePlan) -> dict[str, object]:
    """What of a plan says which of its passes are drawn."""
    return {
        "top": plan.top,
        "trough": plan.trough,
        "passes": [
            {
                "name": one.name,
                "when": one.when,
                "eye": one.model_dump(mode="json")["eye"],
                "view": one.model_dump(mode="json")["view"],
                "target": one.target,
                "inputs": {
                    name: source.model_dump() for name, source in one.inputs.items() if isinstance(source, TargetInput)
                },
                "state": {"clear": one.state.clear},
            }
            for one in plan.passes
        ],
    }


def vectors() -> list[dict[str, object]]:
    """One entry a plan, with what is drawn for each camera and size."""
    entries: list[dict[str, object]] = []
    for preset, tier in PLANS:
        plan = make_plan(load_preset(preset).scene, TIERS[tier])  # type: ignore[index]
        drawn = [
            {
                "camera": camera.model_dump(mode="json"),
                "width": width,
                "height": height,
                "drawn": [
                    [index, shows] for index, shows in drawn_passes(plan, camera, width, height, "screen").items()
                ],
            }
            for camera in CAMERAS
            for width, height in SIZES
        ]
        entries.append({"preset": preset, "tier": tier, "plan": small(plan), "pictures": drawn})
    return entries


if __name__ == "__main__":
    PATH.write_text("[\n" + ",\n".join(json.dumps(entry) for entry in vectors()) + "\n]\n", encoding="utf-8")
