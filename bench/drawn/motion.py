"""Motion: flicker, changes between frames other than smooth motion, of a second at 60 Hz under a slow camera, and of
ten seconds at 30 Hz from every preset's own camera.

One sample a pixel against 64, and tiers for motion against 16.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.report import Column, Table
from bench.watch import Watch
from seafoam.accuracy.metrics import LEVEL, Picture, displayed, tone_curve
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, ToneCurve, load_preset, preset_names

PRESETS = ("default", "open-ocean", "storm", "beach", "drift-vortices")
SIZE = (160, 90)
RATE = 60.0
FRAMES = 61
"""Frames of one second, both ends included."""
SPEED = 0.3
"""Speed of the camera along its heading, m/s."""
SAMPLES = (1, 64)
LONG_SIZE, LONG_RATE, LONG_SAMPLES = (320, 180), 30.0, 16
STARTS = tuple(0.5 * i for i in range(20))
"""Times at which three frames follow one another, from the preset's own, s."""
MOST = 2.0
"""Target: maximum flicker of one sample over that of 64."""
LUMA = (0.2126, 0.7152, 0.0722)
"""Weights of R, G and B (ITU-R BT.709)."""


def shown(picture: Picture, curve: ToneCurve | None) -> NDArray[np.float64]:
    """Luma of a linear picture as a screen shows it, (height, width) in [0, 1]: tone-mapped and sRGB-encoded.

    picture: (height, width, ≥ 3) of linear light; curve: ``light.tone``, None where the scene is unlit.
    Encoded, because eyes see steps of it about alike, dark or bright.
    """
    result: NDArray[np.float64] = displayed(picture, curve).astype(np.float64) @ np.array(LUMA)
    return result


def flicker(frames: Sequence[NDArray[Any]]) -> float:
    """Root mean square of the second difference in time, x(t − 1) − 2 x(t) + x(t + 1), 8-bit levels.

    frames: at least three, evenly apart in time, each (height, width) in [0, 1]. What stays scores 0, and so does what
    grows or fades evenly; what comes for a frame and goes again scores 2.4 times its height there. In frequencies it
    is a high pass, 4 sin²(πf/F) at f of F frames a second: 0.01 at 1 Hz and 4 at 30 Hz of 60. A moving edge scores
    too, so a clip is judged against the same clip from many samples (:func:`excess`). Ours; no model of the eye.

    Raises ``ValueError`` for fewer frames or frames of different shapes.
    """
    if len(frames) < 3 or any(frame.ndim != 2 or frame.shape != frames[0].shape for frame in frames):
        raise ValueError("flicker requires at least three frames (height, width), all of one shape")
    square, count = 0.0, 0
    for before, now, after in zip(frames[:-2], frames[1:-1], frames[2:], strict=True):
        bend = before.astype(np.float64) - 2.0 * now + after
        square += float((bend**2).sum())
        count += bend.size
    return LEVEL * float(np.sqrt(square / count))


def excess(frames: Sequence[NDArray[Any]], truth: Sequence[NDArray[Any]], floor: float = 0.05) -> float:
    """Flicker of a clip over that of the same clip drawn with many samples, ≥ 0: 1 is no more than motion itself.

    frames, truth: as :func:`flicker` takes them; floor: least flicker of the truth, levels, above 0, so that a still
    clip of noise is no infinity. Raises ``ValueError`` as :func:`flicker` does, and where the clips differ in length.
    """
    if len(frames) != len(truth) or not floor > 0.0:
        raise ValueError("both clips must have as many frames, and the floor must be above 0")
    return flicker(frames) / max(flicker(truth), floor)


def moved(camera: Camera, way: float) -> Camera:
    """The camera moved along its heading by a distance, m, at constant height."""
    x, y, z = camera.position
    return camera.model_copy(update={"position": (x + way * math.sin(camera.yaw), y, z - way * math.cos(camera.yaw))})


def long_flicker(executor: Executor, name: str, quality: Quality) -> float:
    """Flicker of ten seconds of a preset, levels: the root mean square of that of three frames at each start."""
    preset = load_preset(name)
    plan, curve, squares = make_plan(preset.scene, quality), tone_curve(preset.scene), []
    for start in STARTS:
        times = [preset.time + start + i / LONG_RATE for i in range(3)]
        width, height = LONG_SIZE
        shape = {"camera": preset.scene.camera, "width": width, "height": height, "output": "linear"}
        squares.append(flicker([shown(executor.render(plan, time=at, **shape).pixels, curve) for at in times]) ** 2)
    return math.sqrt(sum(squares) / len(squares))


def _long(executor: Executor, watch: Watch) -> Table:
    rows: list[tuple[object, ...]] = []
    for name in preset_names():
        with watch.step(f"{name}, ten seconds"):
            many = TIERS["standard"].model_copy(update={"samples": LONG_SAMPLES})
            one, fast, truth = (long_flicker(executor, name, q) for q in (TIERS["standard"], TIERS["fast"], many))
            rows.append((name, truth, one, one / max(truth, 0.05), fast, fast / max(truth, 0.05)))
    two = "{:.2f}".format
    return Table(
        "Motion of ten seconds",
        f"{LONG_SIZE[0]} x {LONG_SIZE[1]}, {len(STARTS)} times three frames at {LONG_RATE:g} Hz, the preset's own "
        f"camera. Flicker of the picture as above, levels, and over that of {LONG_SAMPLES} samples, of 0.05 at least.",
        (
            Column("preset", "preset"),
            Column("many", f"{LONG_SAMPLES} samples", two),
            Column("standard", "standard", two),
            Column("standard_ratio", "ratio", two),
            Column("fast", "fast", two),
            Column("fast_ratio", "ratio", two),
        ),
        rows,
    )


def measure(executor: Executor, watch: Watch, presets: Sequence[str] = PRESETS) -> list[Table]:
    """Draw every preset's clip with one and with many samples, and tabulate their flicker; then that of ten seconds."""
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
    return [table, _long(executor, watch)]


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
