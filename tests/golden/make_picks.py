"""Writes the golden vectors that pin which place of still water a pixel shows; run it as a script."""

import json
import math
from pathlib import Path

import numpy as np

from seafoam.reference.renderer import camera as cameras
from seafoam.scene.camera import Camera

PATH = Path(__file__).with_name("picks.json")

CAMERAS = (
    Camera(),
    Camera(position=(3.0, 2.5, -7.0), yaw=0.8, pitch=-0.4, fov=0.6),
    Camera(position=(-40.0, 12.0, 5.0), yaw=-2.9, pitch=0.1, roll=0.5, fov=1.4),
    Camera(position=(0.0, 60.0, 0.0), pitch=-math.pi / 2),
    Camera(position=(1e7, 4.0, -1e7), yaw=3.1, pitch=-0.2),
    Camera(position=(2.0, -3.0, 1.0), yaw=1.0, pitch=0.6),
)

SIZES = ((1440, 900), (390, 844))

PIXELS = ((0.5, 0.5), (0.1, 0.95), (0.9, 0.7), (0.5, 0.02), (0.31, 0.55), (1.0, 1.0))
"""Places in the picture from its upper left corner, as shares of its width and height."""

FARTHEST = 2000.0
"""Distance from the eye beyond which no place is picked, m."""


def picked(camera: Camera, width: int, height: int, x: float, y: float) -> dict[str, float] | None:
    """Where the ray of a point of the picture meets y = 0, m, and its distance; None where it does not, or far away."""
    view = cameras.view(camera, width, height)
    ray = cameras.rays(view, np.array(2.0 * x / width - 1.0), np.array(1.0 - 2.0 * y / height))
    if ray[1] == 0.0 or -view.eye[1] / ray[1] <= 0.0:
        return None
    way = -view.eye[1] / ray[1] * ray
    distance = float(np.linalg.norm(way))
    if distance > FARTHEST:
        return None
    return {"x": float(view.eye[0] + way[0]), "z": float(view.eye[2] + way[2]), "distance": distance}


def vectors() -> list[dict[str, object]]:
    """One entry a camera and size, with what each of the pixels shows."""
    return [
        {
            "camera": camera.model_dump(mode="json"),
            "width": width,
            "height": height,
            "picks": [
                {"x": u * width, "y": v * height, "place": picked(camera, width, height, u * width, v * height)}
                for u, v in PIXELS
            ],
        }
        for camera in CAMERAS
        for width, height in SIZES
    ]


if __name__ == "__main__":
    PATH.write_text("[\n" + ",\n".join(json.dumps(entry) for entry in vectors()) + "\n]\n", encoding="utf-8")
