"""Draws the pictures of the docs: ``make docs``."""

import math
import sys
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

from PIL import Image

from seafoam.masks.catalogue import load_catalogue, load_mask
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, Caustics, Day, Foam, FrontSaturation, Moon, Scene, load_preset, preset_names

sys.path.append(str(Path(__file__).resolve().parents[1]))
from bench.drawn.foam import lying_still
from docs.masks.sheets import contact_sheet, magnified_sheet

PICTURES = Path(__file__).parent / "pictures"


def frame(executor: Executor, name: str, width: int, height: int) -> Image.Image:
    """A preset at its own time, nine samples per pixel."""
    preset = load_preset(name)
    quality = TIERS["high"].model_copy(update={"samples": 9})
    plan = make_plan(preset.scene, quality)
    rendered = executor.render(plan, time=preset.time, camera=preset.scene.camera, width=width, height=height)
    return Image.fromarray(rendered.pixels[..., :3])


def at_times(executor: Executor, names: Sequence[str]) -> Image.Image:
    """Presets at 0, 5 and 20 s, and from a height of 200 m, four samples per pixel."""
    pictures = []
    for name in names:
        scene = load_preset(name).scene
        plan = make_plan(scene, TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True}))
        x, _, z = scene.camera.position
        high = scene.camera.model_copy(update={"position": (x, 200.0, z), "pitch": -0.4})
        for time, camera in ((0.0, scene.camera), (5.0, scene.camera), (20.0, scene.camera), (20.0, high)):
            drawn = executor.render(plan, time=time, camera=camera, width=480, height=270)
            pictures.append(Image.fromarray(drawn.pixels[..., :3]))
    return sheet(pictures, 4)


def shore(executor: Executor, name: str, time: float, **water: object) -> Image.Image:
    """A preset of a shore, four samples a pixel."""
    scene = load_preset(name).scene
    scene = scene.model_copy(update={"water": scene.water.model_copy(update=water)})
    quality = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})
    rendered = executor.render(make_plan(scene, quality), time=time, camera=scene.camera, width=480, height=270)
    return Image.fromarray(rendered.pixels[..., :3])


def shores(executor: Executor) -> None:
    """Every shore at 0, 5 and 20 s, and the three comparisons of water colour of Outerra 2011: absorption lengths
    7/30/70 against 70/30/7 m at scattering 0.005, and scattering 0 against 0.02."""
    made = [
        shore(executor, name, time)
        for name in preset_names()
        if load_preset(name).scene.shore is not None
        for time in (0.0, 5.0, 20.0)
    ]
    sheet(made, 3).save(PICTURES / "shores.webp", quality=90)
    waters = (
        {"absorption_length": (7.0, 30.0, 70.0), "scattering": 0.005},
        {"absorption_length": (70.0, 30.0, 7.0), "scattering": 0.005},
        {"absorption_length": (7.0, 30.0, 70.0), "scattering": 0.0},
        {"absorption_length": (7.0, 30.0, 70.0), "scattering": 0.02},
    )
    sheet([shore(executor, "island-surf", 5.0, **water) for water in waters], 2).save(
        PICTURES / "water-colours.webp", quality=90
    )


def skies(executor: Executor) -> None:
    """The presets of skies, and the sky of lake-sunset in early summer without land; four samples a pixel."""
    scenes = [(load_preset(name).scene, 5.0) for name in ("lake-sunset", "moonlight", "cubemap-lake")]
    lake = scenes[0][0]
    assert lake.light is not None
    assert lake.light.sky is not None
    night = lake.light.sky.model_copy(update={"stars": 1.0, "moon": Moon(azimuth=-1.9, elevation=0.3, size=2.0)})
    for hour, exposure in ((4.7, -1.8), (13.0, -2.0), (23.5, 3.6)):
        day = Day(hour=hour, date=140.0, latitude=0.82, north=-2.6)
        changed = {"day": day, "exposure": exposure, "sky": night, "reflection": "sky"}
        light = lake.light.model_copy(update=changed)
        camera = lake.camera.model_copy(update={"pitch": 0.08})
        scenes.append((lake.model_copy(update={"light": light, "shore": None, "camera": camera}), 60.0 * hour))
    quality = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})
    drawn = [
        executor.render(make_plan(scene, quality), time=time, camera=scene.camera, width=480, height=270).pixels
        for scene, time in scenes
    ]
    sheet([Image.fromarray(pixels[..., :3]) for pixels in drawn], 3).save(PICTURES / "skies.webp", quality=88)


def drift(executor: Executor) -> Image.Image:
    """Vortices at three times; from above, traced back on maps of two sizes, and moved forward."""
    scene = load_preset("drift-vortices").scene
    place = scene.drift.place if scene.drift is not None else (0.0, 0.0)
    above = scene.camera.model_copy(update={"position": (place[0], 30.0, place[1]), "yaw": 0.0, "pitch": -math.pi / 2})
    back = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})
    fine, forward = (back.model_copy(update=parameters) for parameters in ({"drift_size": 1024}, {"drift": "forward"}))
    shots = [(back, time, scene.camera) for time in (0.0, 5.0, 20.0)]
    shots += [(quality, 33.0, above) for quality in (fine, back, forward)]
    made = []
    for quality, time, camera in shots:
        drawn = executor.render(make_plan(scene, quality), time=time, camera=camera, width=480, height=270)
        made.append(Image.fromarray(drawn.pixels[..., :3]))
    return sheet(made, 3)


def sparkles(executor: Executor) -> None:
    """The sun's path smooth, in sparkles, and as the lake's highlight; a burst on a rock at three times."""
    sunset, rocks = load_preset("sunset-sparkles"), load_preset("spray-on-rocks")
    assert sunset.scene.light is not None
    lights = ({"sparkles": None}, {}, {"sparkles": None, "specular": "blinn_phong"})
    scenes = [
        (sunset.scene.model_copy(update={"light": sunset.scene.light.model_copy(update=update)}), sunset.time)
        for update in lights
    ]
    scenes += [(rocks.scene, time) for time in (0.8, 1.6, 2.6)]
    quality = TIERS["standard"].model_copy(update={"samples": 4, "spray_count": 16384})
    made = []
    for scene, time in scenes:
        drawn = executor.render(make_plan(scene, quality), time=time, camera=scene.camera, width=480, height=270)
        made.append(Image.fromarray(drawn.pixels[..., :3]))
    sheet(made, 3).save(PICTURES / "sparkles.webp", quality=88)


def pool(executor: Executor) -> None:
    """The pool; without caustics; with five times the dispersion; Snell's window; along the floor; the open ocean from
    a depth of 4 m."""
    scene = load_preset("pool-caustics").scene
    assert scene.light is not None
    plain = scene.model_copy(update={"light": scene.light.model_copy(update={"caustics": None})})
    apart = scene.model_copy(update={"light": scene.light.model_copy(update={"caustics": Caustics(dispersion=5.0)})})
    ocean = load_preset("open-ocean").scene
    close = scene.camera.model_copy(update={"position": (0.0, 0.5, 0.0), "pitch": -1.0})
    views = (
        (scene, scene.camera),
        (plain, scene.camera),
        (apart, close),
        (scene, Camera(position=(0.0, -1.2, 0.0), yaw=-2.6, pitch=1.15, fov=1.7)),
        (scene, Camera(position=(0.0, -1.1, 0.0), pitch=0.12, fov=1.1)),
        (ocean, Camera(position=(0.0, -8.9, 0.0), yaw=-1.2, pitch=0.75, fov=1.5)),
    )
    quality = TIERS["high"].model_copy(update={"caustics_size": 1024})
    made = []
    for one, camera in views:
        drawn = executor.render(make_plan(one, quality), time=3.0, camera=camera, width=480, height=270)
        made.append(Image.fromarray(drawn.pixels[..., :3]))
    sheet(made, 3).save(PICTURES / "caustics.webp", quality=82)


def below(executor: Executor) -> None:
    """Nine presets seen from under their surface."""
    views = {
        "default": (0.6, -0.4, -0.3, 0.5, 1.0),
        "shallows": (0.0, -0.6, 0.0, 0.45, 1.3),
        "drift-vortices": (0.0, -0.9, 0.0, 0.7, 1.2),
        "lagoon": (-10.0, -0.5, 20.0, 0.1, 1.2),
        "beach": (-40.0, 0.0, 9.0, 0.1, 1.1),
        "boat-race": (0.0, -1.0, 5.0, 0.1, 1.0),
        "lake-sunset": (0.0, -0.5, 0.0, 1.1, 1.9),
        "paper-benchmark": (0.0, -0.3, 0.0, 0.6, 1.2),
        "river": (0.0, -0.4, 0.0, 0.7, 1.3),
    }
    quality = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})
    made = []
    for name, (x, y, z, pitch, fov) in views.items():
        preset = load_preset(name)
        start = preset.scene.camera
        middle = (start.position[0], start.position[2])
        if preset.scene.boats:
            boat = preset.scene.boats[0]
            turned = boat.bearing + boat.speed / boat.radius * preset.time
            middle = (boat.centre[0] + boat.radius * math.cos(turned), boat.centre[1] + boat.radius * math.sin(turned))
        camera = start.model_copy(
            update={"position": (middle[0] + x, y, middle[1] + z), "pitch": pitch, "fov": fov}
            | ({"yaw": -0.5} if preset.scene.boats else {})
        )
        plan = make_plan(preset.scene, quality)
        drawn = executor.render(plan, time=preset.time, camera=camera, width=480, height=270)
        made.append(Image.fromarray(drawn.pixels[..., :3]))
    sheet(made, 3).save(PICTURES / "below.webp", quality=82)


BEFORE: dict[str, dict[str, object]] = {
    "default": {"mask": "mix", "mask_tile": 5.0},
    "open-ocean": {"mask": "mix", "mask_tile": 8.0, "fade": 0.35, "texture": 0.6},
    "storm": {"mask": "mix", "mask_tile": 26.0, "fade": 0.4, "texture": 0.75},
    "swell": {"mask": "mix", "mask_tile": 5.0, "fade": 0.35, "texture": 0.6},
    "shallows": {"mask": "clump", "mask_tile": 5.0},
    "boat-race": {"mask": "mix", "mask_tile": 2.2},
    "spray-on-rocks": {"mask": "clump", "mask_tile": 5.0},
    "drift-vortices": {"mask": "bubble", "mask_tile": 2.5},
    "boat-in-storm": {"mask": "mix", "mask_tile": 26.0, "fade": 0.4, "texture": 0.75},
    "island-surf": {"mask": "clump", "mask_tile": 5.0},
    "coastline": {"mask": "clump", "mask_tile": 6.0},
    "beach": {"mask": "clump", "mask_tile": 4.0},
    "lagoon": {"mask": "clump", "mask_tile": 4.0},
    "murky-estuary": {"mask": "clump", "mask_tile": 2.5},
    "lake-choppy": {"mask": "mix", "mask_tile": 1.6, "cells": True},
    "explosion": {"mask": "mix", "mask_tile": 6.0},
    "river": {"mask": "mix", "mask_tile": 2.5},
}
"""The presets' foam before octaves and foam's history were added."""
GROUPS = {"default": (0.3, 0.75), "shallows": (0.35, 0.9)}
"""Group thresholds of that time: foam that lasts needs fewer groups."""


def before_history(foam: Foam, name: str) -> Foam:
    """The preset's foam without its history, with the former group thresholds."""
    still = lying_still(foam)
    made = [
        one.model_copy(update={"group": GROUPS.get(name, one.group)}) if isinstance(one, FrontSaturation) else one
        for one in still.saturation
    ]
    return still.model_copy(update={"saturation": tuple(made)})


def foam(executor: Executor) -> None:
    """Every preset's foam before and now; one, two and four octaves by height; foam without and with its history."""
    quality = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})

    def drawn(
        scene: Scene, time: float, camera: Camera | None = None, size: tuple[int, int] = (640, 360)
    ) -> Image.Image:
        width, height = size
        pixels = executor.render(
            make_plan(scene, quality), time=time, camera=camera or scene.camera, width=width, height=height
        ).pixels
        executor.forget()
        return Image.fromarray(pixels[..., :3])

    def changed(scene: Scene, foam: Foam | None, aeration: float | None = None) -> Scene:
        water = scene.water if aeration is None else scene.water.model_copy(update={"aeration": aeration})
        return scene.model_copy(update={"foam": foam, "water": water})

    pairs = []
    for name, before in BEFORE.items():
        preset = load_preset(name)
        assert preset.scene.foam is not None
        then = before_history(preset.scene.foam, name).model_copy(update={**before, "octaves": 1})
        pairs += [drawn(changed(preset.scene, then, 0.0), preset.time), drawn(preset.scene, preset.time)]
    sheet(pairs, 4).save(PICTURES / "foam-presets.webp", quality=80)

    default = load_preset("default")
    assert default.scene.foam is not None
    near = [
        drawn(
            changed(default.scene, default.scene.foam.model_copy(update={"octaves": octaves})),
            default.time,
            default.scene.camera.model_copy(update={"position": (0.0, height, 0.0), "pitch": -0.5}),
        )
        for height in (4.4, 12.0, 45.0)
        for octaves in (1, 2, 4)
    ]
    sheet(near, 3).save(PICTURES / "foam-octaves.webp", quality=82)

    lives = []
    above = Camera(position=(0.0, 70.0, 0.0), yaw=-0.25, pitch=-0.55, fov=0.9)
    for name, times, camera in (("default", (9.0, 11.0), None), ("storm", (9.0, 30.0), above)):
        scene = load_preset(name).scene
        assert scene.foam is not None
        for foam_now in (before_history(scene.foam, name), scene.foam):
            lives += [drawn(changed(scene, foam_now), time, camera, (800, 450)) for time in times]
    sheet(lives, 2).save(PICTURES / "foam-lives.webp", quality=80)
    beach = load_preset("beach").scene
    moments = [drawn(beach, 7.0 + 1.5 * i, size=(800, 450)) for i in range(6)]
    sheet(moments, 2).save(PICTURES / "foam-beach.webp", quality=80)


def boats(executor: Executor) -> None:
    """The boats' presets at three times; the race's mirror: of the sky alone, planar, by rays from the water."""
    quality = TIERS["standard"].model_copy(update={"samples": 4, "foam_relief": True})
    made = []
    for name, times in (("boat-race", (0.0, 6.0, 11.0)), ("boat-in-storm", (49.0, 52.0, 56.0))):
        scene = load_preset(name).scene
        for time in times:
            drawn = executor.render(make_plan(scene, quality), time=time, camera=scene.camera, width=480, height=270)
            made.append(Image.fromarray(drawn.pixels[..., :3]))
    race = load_preset("boat-race").scene
    assert race.light is not None
    close = race.camera.model_copy(update={"yaw": 0.25, "pitch": -0.12, "fov": 0.3})
    for reflection, way in (("sky", "map"), ("planar", "map"), ("planar", "traced")):
        scene = race.model_copy(update={"light": race.light.model_copy(update={"reflection": reflection})})
        plan = make_plan(scene, quality.model_copy(update={"reflection": way}))
        drawn = executor.render(plan, time=6.0, camera=close, width=480, height=270)
        made.append(Image.fromarray(drawn.pixels[..., :3]))
    sheet(made, 3).save(PICTURES / "boats.webp", quality=82)


def sheet(pictures: list[Image.Image], columns: int, gap: int = 6) -> Image.Image:
    """Pictures of one size in rows."""
    width, height = pictures[0].size
    rows = -(-len(pictures) // columns)
    made = Image.new("RGB", (columns * (width + gap) - gap, rows * (height + gap) - gap), "white")
    for i, picture in enumerate(pictures):
        made.paste(picture, ((i % columns) * (width + gap), (i // columns) * (height + gap)))
    return made


def write_smaller(name: str, png: bytes) -> None:
    """Write an opaque PNG's pixels as a lossless WebP: of black and white patterns it has less than half the bytes."""
    with Image.open(BytesIO(png)) as picture:
        picture.convert("RGB").save(PICTURES / f"{name}.webp", lossless=True, method=6)


def main() -> None:
    """Write every picture."""
    executor = Executor()
    frame(executor, "default", 1280, 720).save(PICTURES / "default.webp", quality=92)
    early = [name for name in preset_names() if name.startswith("paper-") or name == "shallows"]
    figures = [frame(executor, name, 480, 270 if name != "paper-threshold" else 240) for name in early]
    figures = [picture.resize((480, 270)) if picture.size != (480, 270) else picture for picture in figures]
    sheet(figures, 4).save(PICTURES / "figures.webp", quality=92)
    at_times(executor, ("open-ocean", "swell", "storm", "river")).save(PICTURES / "seas.webp", quality=90)
    at_times(executor, ("lake-calm", "lake-choppy", "explosion")).save(PICTURES / "lakes.webp", quality=90)
    shores(executor)
    skies(executor)
    drift(executor).save(PICTURES / "drift.webp", quality=76)
    sparkles(executor)
    pool(executor)
    below(executor)
    boats(executor)
    foam(executor)
    executor.close()
    masks = [(name, load_mask(name)) for name in load_catalogue()]
    write_smaller("masks", contact_sheet([(name, m.ranks, m.tables.spectrum) for name, m in masks]))
    write_smaller("masks-magnified", magnified_sheet([(name, m.ranks, m.quantile) for name, m in masks]))


if __name__ == "__main__":
    main()
