"""Draws waters near and far at four times of day, to look at: ``python docs/make_walk.py FOLDER [PRESET ...]``.

A sheet for each preset: rows are dawn, noon, dusk and night, columns are views whose middle row spans 2, 10, 50 and
200 m of the water that the preset looks at, the horizon near the upper edge. ``--step`` draws the change of each pixel
within 1/60 s instead. Reports pixels that are black, white or not finite, and single pixels that stand out from all
eight neighbours.
"""

import argparse
import math
from pathlib import Path

import numpy as np
from make_pictures import sheet
from PIL import Image

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Relief, ReliefPart
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, Moon, Scene, Sky, load_preset

PRESETS = (
    *("default", "open-ocean", "storm", "swell", "beach", "coastline", "island-surf", "lagoon", "lake-calm"),
    *("lake-choppy", "river", "murky-estuary", "shallows", "moonlight", "sunset-sparkles", "drift-vortices"),
    *("spray-on-rocks", "explosion"),
)
SPANS = (2.0, 10.0, 50.0, 200.0)
"""Water across the middle row of a view, m."""
SUNS = {"dawn": (0.25, 0.05, -1.0), "noon": (2.4, 1.0, -1.8), "dusk": (-0.2, -0.02, 0.8), "night": (2.0, -0.6, 1.7)}
"""Azimuth of the sun from the look, its elevation (rad), and the exposure (stops)."""
PITCH = -0.38


def lit(scene: Scene, hour: str) -> Scene:
    """The scene at a time of day; at night under a moon."""
    assert scene.light is not None
    turn, elevation, exposure = SUNS[hour]
    look = scene.camera.yaw - 0.5 * math.pi
    sky = Sky() if scene.light.sky is None else scene.light.sky
    moon = Moon(azimuth=math.remainder(look + 0.2, 2.0 * math.pi), elevation=0.3) if hour == "night" else None
    update: dict[str, object] = {
        "day": None,
        "sun_azimuth": math.remainder(look + turn, 2.0 * math.pi),
        "sun_elevation": elevation,
        "exposure": exposure,
        "sky": sky.model_copy(update={"moon": moon, "stars": 1.0 if moon else 0.0}),
    }
    return scene.model_copy(update={"light": scene.light.model_copy(update=update)})


def top(scene: Scene, time: float, x: float, z: float) -> float:
    """Height of water or land at (x, z), m."""
    here = np.zeros(1)
    sea = sea_surface(scene, time, (x, z))
    parts: tuple[ReliefPart, ...] = (wave_set(scene, time, (x, z)), ring_set(scene, time, (x, z)))
    relief = Relief(parts if sea is None else (*parts, sea))
    if scene.shore is None:
        return float(relief.height(here, here)[0])
    coast = Coast(scene.shore, time, (x, z), relief)
    return max(float(coast.height(here, here)[0]), float(coast.ground(*coast.place(here, here))[0][0]))


def view(scene: Scene, time: float, span: float) -> Camera:
    """A view whose middle spans ``span`` metres of the water that the scene's camera looks at."""
    start = scene.camera
    x, y, z = start.position
    ahead = min(y / math.tan(max(-start.pitch, 0.08)), 60.0)
    at_x, at_z = x + ahead * math.sin(start.yaw), z - ahead * math.cos(start.yaw)
    away = span / (2.0 * math.tan(0.5 * start.fov) * 16.0 / 9.0)
    level = away * math.cos(PITCH)
    eye_x, eye_z = at_x - level * math.sin(start.yaw), at_z + level * math.cos(start.yaw)
    up = max(top(scene, time, eye_x, eye_z), top(scene, time, at_x, at_z), 0.0)
    return start.model_copy(
        update={"position": (eye_x, up - away * math.sin(PITCH), eye_z), "pitch": PITCH, "roll": 0.0}
    )


def outliers(shown: np.ndarray) -> int:
    """Pixels whose brightness differs by more than 40 levels from all eight neighbours, to one side."""
    grey = shown.astype(np.float64).mean(axis=-1)
    near = [np.roll(grey, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    alone = (grey > np.max(near, axis=0) + 40.0) | (grey < np.min(near, axis=0) - 40.0)
    return int(alone[1:-1, 1:-1].sum())


def walk(executor: Executor, name: str, size: tuple[int, int], step: bool) -> Image.Image:
    """The sheet of a preset."""
    preset = load_preset(name)
    cameras = [view(preset.scene, preset.time, span) for span in SPANS]
    made = []
    for hour in SUNS:
        scene = lit(preset.scene, hour)
        plan = make_plan(scene, TIERS["standard"])
        for span, camera in zip(SPANS, cameras, strict=True):
            drawn = executor.render(
                plan, time=preset.time, camera=camera, width=size[0], height=size[1], output="linear"
            )
            finite = bool(np.isfinite(drawn.pixels.astype(np.float64)).all())
            shown = executor.render(plan, time=preset.time, camera=camera, width=size[0], height=size[1]).pixels[
                ..., :3
            ]
            black, white = (int((shown == level).all(axis=-1).sum()) for level in (0, 255))
            print(
                f"{name} {hour} {span:g} m: finite {finite}, black {black}, white {white}, alone {outliers(shown)}",
                flush=True,
            )
            if step:
                later = executor.render(
                    plan, time=preset.time + 1.0 / 60.0, camera=camera, width=size[0], height=size[1]
                )
                change = np.abs(later.pixels[..., :3].astype(np.int16) - shown)
                shown = np.minimum(4 * change, 255).astype(np.uint8)
            made.append(Image.fromarray(np.ascontiguousarray(shown)))
    return sheet(made, len(SPANS), 2)


def main() -> None:
    """Write the sheets."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("presets", nargs="*", default=PRESETS)
    parser.add_argument("--width", type=int, default=320, help="width of a view, pixels")
    parser.add_argument("--step", action="store_true", help="change within 1/60 s, four times as bright")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    executor = Executor()
    for name in given.presets or PRESETS:
        made = walk(executor, name, (given.width, given.width * 9 // 16), given.step)
        made.save(given.folder / f"{name}{'-step' if given.step else ''}.png")
        executor.forget()
    executor.close()


if __name__ == "__main__":
    main()
