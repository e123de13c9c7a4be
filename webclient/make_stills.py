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
from seafoam.render.gl.executor import Executor
from seafoam.scene.presets import Preset, load_preset, preset_names

FOLDER = Path(__file__).parent / "public/stills"
INDEX = Path(__file__).parent / "stills.json"
"""By preset, the hash of the start that its still shows."""

SIZE = (1728, 720)
SMALL = (240, 135)
QUALITY = TIERS["standard"].model_copy(update={"samples": 4})
STILL_LOSS = 50
"""Pillow's ``quality`` of AVIF."""
SMALL_LOSS = 70
"""Pillow's ``quality`` of WebP."""


def start_of(preset: Preset) -> str:
    """SHA-256 of all that a preset's first moment depends on but the shaders' text: scene with camera, and time."""
    text = json.dumps([preset.scene.model_dump(mode="json"), preset.time], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def still_of(name: str) -> Path:
    """Where a preset's still is."""
    return FOLDER / f"{name}.avif"


def thumbnail_of(name: str) -> Path:
    """Where a preset's small picture is."""
    return FOLDER / f"{name}.small.webp"


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
    index: dict[str, str] = json.loads(INDEX.read_text(encoding="utf-8")) if INDEX.is_file() else {}
    presets = [load_preset(name) for name in preset_names()]
    outdated = [preset.name for preset in presets if index.get(preset.name) != start_of(preset)]
    executor = Executor()
    try:
        for preset in presets:
            if preset.name in (names or outdated):
                _draw(executor, preset)
                index[preset.name] = start_of(preset)
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
