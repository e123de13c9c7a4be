"""Writes the golden vectors that pin the uniform rules of both executors; run it as a script."""

import json
import math
from pathlib import Path

from seafoam.framegraph.evaluation import FrameState, evaluate_rule
from seafoam.framegraph.rules import CameraRule, Clamp, Constant, Loop, PassIndex, Phase, Rule, Viewport, Wrap
from seafoam.scene.camera import Camera

PATH = Path(__file__).with_name("uniform_rules.json")

RULES: list[Rule] = [
    Constant(value=(0.0, -1.5, 1e-7)),
    Phase(offset=0.3, rate=2.1, k=(-0.4, 0.7)),
    Phase(offset=-5.9, rate=17.003, k=(62.8, -0.001)),
    Phase(offset=math.pi, rate=0.0, k=(0.0, 0.0)),
    Wrap(k=(0.07, 0.02)),
    Wrap(k=(-1.0, 0.0), offset=0.25, period=3.7),
    Wrap(k=(0.3, -0.2), period=256.0, rate=-1.7),
    Loop(period=60.0),
    Loop(period=0.1),
    Loop(period=7.3, offset=-2.25),
    Clamp(offset=-1e9, rate=1.0, low=0.0, high=55.3),
    Clamp(offset=-3.5, k=(-1.0, 0.0), low=-1e8, high=1e8),
    Clamp(offset=12.0, rate=-0.25, k=(0.0, 1.0), low=-40.0, high=9.0),
    *(CameraRule(what=what) for what in ("eye_height", "ray_x", "ray_y", "ray_z")),
    CameraRule(what="view_projection", top=2.3),
    CameraRule(what="view_projection", top=50.0),
    Viewport(),
    Viewport(times=2),
    Viewport(of="picture", times=4),
    PassIndex(),
]

STATES = [
    (0.0, Camera(), 320, 180, 320, 180, 0),
    (12.5, Camera(position=(3.0, 1.7, -8.0), yaw=0.9, pitch=-0.4, roll=0.1, fov=1.1), 1280, 720, 256, 256, 3),
    (1e9, Camera(position=(1e7, 30.0, -1e7), yaw=-3.0, pitch=1.5708, fov=0.3), 1, 4096, 4, 16384, 1),
    (-1e9, Camera(position=(-1e7, -2.0, 123.456), yaw=6.0, pitch=-1.5708, roll=-3.0, fov=2.5), 390, 844, 780, 1688, 2),
    (1e9 + 1e-6, Camera(position=(-1e-12, 6.0, 1e-12)), 333, 77, 333, 77, 5),
]


def vectors() -> list[dict[str, object]]:
    """One entry a rule and state."""
    entries: list[dict[str, object]] = []
    for rule in RULES:
        for time, camera, width, height, target_width, target_height, index in STATES:
            state = FrameState(time, camera, width, height, target_width, target_height, index)
            entries.append(
                {
                    "rule": rule.model_dump(mode="json"),
                    "state": {
                        "time": time,
                        "camera": camera.model_dump(mode="json"),
                        "width": width,
                        "height": height,
                        "target_width": target_width,
                        "target_height": target_height,
                        "pass_index": index,
                    },
                    "value": list(evaluate_rule(rule, state)),
                }
            )
    return entries


if __name__ == "__main__":
    PATH.write_text("[\n" + ",\n".join(json.dumps(entry) for entry in vectors()) + "\n]\n", encoding="utf-8")
