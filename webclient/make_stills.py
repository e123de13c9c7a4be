"""Stills: each preset's first moment, rendered by the server for the page to show at first, and its thumbnail.

``make stills`` writes ``public/stills`` for the presets whose still is missing or outdated; with names as arguments,
for those. A still is an AVIF picture, 720 rows high and wider than most windows, which show its middle; thumbnails are
WebP: thirty of them in AVIF took 0.4 s of the page's start on one core.
"""

import hashlib
import json
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import scene_sha256
from seafoam.render.gl.executor import Executor
from seafoam.scene import Preset, load_preset, preset_names

FOLDER = Path(__file__).parent / "public/stills"
INDEX = Path(__file__).parent / "stills.json"
"""By preset, the hash of the start that its still shows, the ink of the page's heading over it, and whether what lies
behind that is of one tone."""

SIZE = (1728, 720)
SMALL = (240, 135)
QUALITY = TIERS["standard"].model_copy(update={"samples": 4})
STILL_LOSS = 38
"""Pillow's ``quality`` of AVIF."""
SMALL_LOSS = 70
"""Pillow's ``quality`` of WebP."""
HEADINGS = ((16 / 10, 0.42, 0.22), (6 / 13, 0.95, 0.36))
"""Aspect ratio of a window, and width and height of its upper left corner that the heading takes, in shares of it."""
INKS = {"light": 0.87, "dark": 0.009}
"""Relative luminances of the heading's colours (``style.css``)."""
EXTREMES = (10, 90)
"""Percentiles of the luminance behind the heading at which an ink must be read."""
EVEN = 2.5
"""Least contrast there, below which neither ink is read by itself."""


def start_of(preset: Preset) -> str:
    """SHA-256 of all that a preset's first moment depends on but the shaders' text: scene with camera, and time."""
    text = json.dumps([scene_sha256(preset.scene), preset.time])
    return hashlib.sha256(text.encode()).hexdigest()


def still_of(name: str) -> Path:
    """Where a preset's still is."""
    return FOLDER / f"{name}.avif"


def thumbnail_of(name: str) -> Path:
    """Where a preset's small picture is."""
    return FOLDER / f"{name}.small.webp"


def heading_of(name: str) -> dict[str, str | bool]:
    """The ink that is read better where it is read worst, over the preset's still in wide and in narrow windows."""
    with Image.open(still_of(name)) as still:
        pixels = np.asarray(still.convert("RGB"), np.float64) / 255.0
    linear = np.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4)
    luminance = linear @ (0.2126, 0.7152, 0.0722)
    rows, columns = luminance.shape
    behind = []
    for ratio, width, height in HEADINGS:
        side = (columns - rows * ratio) / 2
        corner = luminance[: round(height * rows), round(side) : round(side + width * rows * ratio)]
        behind += list(np.percentile(corner, EXTREMES))

    def contrast(ink: float) -> float:
        return min((max(ink, each) + 0.05) / (min(ink, each) + 0.05) for each in behind)

    best = max(INKS, key=lambda ink: contrast(INKS[ink]))
    return {"ink": best, "even": bool(contrast(INKS[best]) >= EVEN)}


def _draw(executor: Executor, preset: Preset) -> None:
    width, height = SIZE
    plan = make_plan(preset.scene, QUALITY)
    rendered = executor.render(
        plan, time=preset.time, camera=preset.scene.camera, width=width, height=height, output="rgba8"
    )
    picture = Image.fromarray(np.ascontiguousarray(rendered.pixels[..., :3]))
    picture.save(still_of(preset.name), "AVIF", quality=STILL_LOSS)
    side = (width - height * SMALL[0] / SMALL[1]) / 2
    middle = (side, 0.0, width - side, float(height))
    small = picture.resize(SMALL, Image.Resampling.LANCZOS, box=middle)
    small.save(thumbnail_of(preset.name), "WEBP", quality=SMALL_LOSS, method=6)


def main(names: Sequence[str]) -> None:
    """Draw the stills of these presets; without names, of those that are missing or outdated."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    index: dict[str, dict[str, str | bool]] = json.loads(INDEX.read_text(encoding="utf-8")) if INDEX.is_file() else {}
    presets = [load_preset(name) for name in preset_names()]
    outdated = [preset.name for preset in presets if index.get(preset.name, {}).get("start") != start_of(preset)]
    executor = Executor()
    try:
        for preset in presets:
            if preset.name in (names or outdated):
                _draw(executor, preset)
                index[preset.name] = {"start": start_of(preset), **heading_of(preset.name)}
                kept = {each.name: index[each.name] for each in presets if each.name in index}
                INDEX.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
                print(f"{preset.name}: {still_of(preset.name).stat().st_size:,} bytes", flush=True)
    finally:
        executor.close()
    known = {path for name in preset_names() for path in (still_of(name), thumbnail_of(name))}
    for path in set(FOLDER.iterdir()) - known:
        path.unlink()


if __name__ == "__main__":
    main(sys.argv[1:])
