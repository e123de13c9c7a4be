"""Makes the pictures of the docs again: ``make docs``."""

from collections.abc import Sequence
from pathlib import Path

from PIL import Image

from seafoam.masks.catalogue import load_catalogue, load_mask
from seafoam.masks.plots import contact_sheet, magnified_sheet
from seafoam.plan import make_plan
from seafoam.quality import TIERS
from seafoam.render.executor import Executor
from seafoam.scene.presets import load_preset, preset_names

PICTURES = Path(__file__).parent / "pictures"


def frame(executor: Executor, name: str, width: int, height: int, **foam: object) -> Image.Image:
    """A preset at its best time, nine samples a pixel."""
    preset = load_preset(name)
    scene = preset.scene
    if foam and scene.foam is not None:
        scene = scene.model_copy(update={"foam": scene.foam.model_copy(update=foam)})
    quality = TIERS["high"].model_copy(update={"samples": 9})
    rendered = executor.render(
        make_plan(scene, quality), time=preset.time, camera=scene.camera, width=width, height=height
    )
    return Image.fromarray(rendered.pixels[..., :3])


def at_times(executor: Executor, names: Sequence[str]) -> Image.Image:
    """Presets at 0, 5 and 20 s, and from 200 m, four samples a pixel."""
    pictures = []
    for name in names:
        scene = load_preset(name).scene
        plan = make_plan(scene, TIERS["standard"].model_copy(update={"samples": 4}))
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
    quality = TIERS["standard"].model_copy(update={"samples": 4})
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


def boats(executor: Executor) -> None:
    """The boats' presets at three times; the race's mirror: of the sky alone, planar, by rays from the water."""
    quality = TIERS["standard"].model_copy(update={"samples": 4})
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


def main() -> None:
    """Write every picture."""
    executor = Executor()
    frame(executor, "default", 1280, 720).save(PICTURES / "default.webp", quality=92)
    early = [name for name in preset_names() if name.startswith("paper-") or name == "shallows"]
    figures = [frame(executor, name, 480, 270 if name != "paper-threshold" else 240) for name in early]
    figures = [picture.resize((480, 270)) if picture.size != (480, 270) else picture for picture in figures]
    sheet(figures, 4).save(PICTURES / "figures.webp", quality=92)
    looks = ("textured", "halftone", "fading", "halftone_textured", "listing", "filtered")
    sheet([frame(executor, "paper-wake", 480, 270, look=look) for look in looks], 3).save(
        PICTURES / "looks.webp", quality=92
    )
    at_times(executor, ("open-ocean", "swell", "storm", "river")).save(PICTURES / "seas.webp", quality=90)
    at_times(executor, ("lake-calm", "lake-choppy", "explosion")).save(PICTURES / "lakes.webp", quality=90)
    shores(executor)
    boats(executor)
    executor.close()
    masks = [(name, load_mask(name)) for name in load_catalogue()]
    (PICTURES / "masks.png").write_bytes(contact_sheet([(name, m.ranks, m.spectrum) for name, m in masks]))
    (PICTURES / "masks-magnified.png").write_bytes(magnified_sheet([(name, m.ranks, m.quantile) for name, m in masks]))


if __name__ == "__main__":
    main()
