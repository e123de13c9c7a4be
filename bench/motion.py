"""Motion: flicker of a second at 60 Hz under a slow camera, one sample a pixel against 64."""

import math
from collections.abc import Sequence

from bench.report import Column, Table
from bench.watch import Watch
from seafoam.accuracy.metrics import tone_curve
from seafoam.accuracy.motion import excess, flicker, shown
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.presets import load_preset

PRESETS = ("default", "open-ocean", "storm", "beach", "drift-vortices")
SIZE = (160, 90)
RATE = 60.0
FRAMES = 61
"""Frames of one second, both ends included."""
SPEED = 0.3
"""Speed of the camera along its heading, m/s."""
SAMPLES = (1, 64)
MOST = 2.0
"""Target: maximum flicker of one sample over that of 64."""


def moved(camera: Camera, way: float) -> Camera:
    """The camera moved along its heading by a distance, m, at constant height."""
    x, y, z = camera.position
    return camera.model_copy(update={"position": (x + way * math.sin(camera.yaw), y, z - way * math.cos(camera.yaw))})


def measure(executor: Executor, watch: Watch, presets: Sequence[str] = PRESETS) -> list[Table]:
    """Draw every preset's clip with one and with many samples, and tabulate their flicker."""
    rows: list[tuple[object, ...]] = []
    for name in presets:
        with watch.step(f"{name}, motion"):
            rows.append(_row(executor, name))
    two = "{:.2f}".format
    table = Table(
        "Motion",
        f"{SIZE[0]} x {SIZE[1]}, {FRAMES} frames at {RATE:g} Hz, the camera {SPEED:g} m/s forward, quality standard. "
        f"Flicker: root mean square second difference in time, levels. The aim: at most {MOST:g} times that of "
        f"{SAMPLES[1]} samples.",
        (
            Column("preset", "preset"),
            Column("foam_one", "foam: 1 sample", two),
            Column("foam_many", f"{SAMPLES[1]}", two),
            Column("foam_ratio", "ratio", two),
            Column("picture_one", "picture: 1 sample", two),
            Column("picture_many", f"{SAMPLES[1]}", two),
            Column("picture_ratio", "ratio", two),
            Column("within", "within"),
        ),
        rows,
    )
    return [table]


def _row(executor: Executor, name: str) -> tuple[object, ...]:
    preset = load_preset(name)
    curve = tone_curve(preset.scene)
    pictures, foams = [], []
    for samples in SAMPLES:
        plan = make_plan(preset.scene, TIERS["standard"].model_copy(update={"samples": samples}))
        pictures.append([])
        foams.append([])
        for i in range(FRAMES):
            camera = moved(preset.scene.camera, SPEED * i / RATE)
            time = preset.time + i / RATE
            frame = executor.render(
                plan, time=time, camera=camera, width=SIZE[0], height=SIZE[1], output="linear"
            ).pixels
            pictures[-1].append(shown(frame, curve))
            foams[-1].append(frame[..., 3].copy())
    ratios = [excess(*clips) for clips in (foams, pictures)]
    levels = [flicker(clip) for clips in (foams, pictures) for clip in clips]
    within = "yes" if max(ratios) <= MOST else "no"
    return (name, *levels[:2], ratios[0], *levels[2:], ratios[1], within)
