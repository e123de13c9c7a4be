"""Cost and error of each tier at several scales, from which the page selects its quality.

``make fronts`` writes ``public/fronts.json`` for the presets that it lacks; with names as arguments, for those. Time is
processor time of all threads on a software renderer; error is the RMSE of the picture, rendered at a scale and enlarged
bilinearly, against ``high`` with 16 samples a pixel.
"""

import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.optimize import nnls

from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality, Tier
from seafoam.render.gl.executor import Executor
from seafoam.scene import Preset, load_preset, preset_names

FILE = Path(__file__).parent / "public/fronts.json"
SIZE = (480, 270)
SCALES = (1.0, 0.7, 0.5, 0.35, 0.25)
TRUTH = TIERS["high"].model_copy(update={"samples": 16})
MOVING: tuple[Tier, ...] = tuple(tier for tier in TIERS if tier != "reference")
"""Tiers for pictures that move; ``reference`` is for stills."""


def _drawn(executor: Executor, preset: Preset, quality: Quality, scale: float) -> tuple[NDArray[Any], float]:
    """The picture at ``SIZE``, and the seconds of the processor that its second frame took."""
    width, height = (round(side * scale) for side in SIZE)
    plan = make_plan(preset.scene, quality)
    seconds = 0.0
    for _ in range(2):
        began = time.process_time()
        rendered = executor.render(
            plan, time=preset.time, camera=preset.scene.camera, width=width, height=height, output="rgba8"
        )
        seconds = time.process_time() - began
    picture = Image.fromarray(np.ascontiguousarray(rendered.pixels[..., :3]))
    return np.asarray(picture.resize(SIZE, Image.Resampling.BILINEAR), float), seconds


def front_of(executor: Executor, preset: Preset) -> list[dict[str, Any]]:
    """By tier: ms of a frame whatever its size, ms of a million pixels, and the RMSE in levels at each scale."""
    width, height = SIZE
    truth, _ = _drawn(executor, preset, TRUTH, 1.0)
    front = []
    for tier in MOVING:
        renders = [_drawn(executor, preset, TIERS[tier], scale) for scale in SCALES]
        # Least squares of fixed + pixels · scale² with relative errors.
        seconds = np.array([time for _, time in renders])
        design = np.stack((np.ones(len(SCALES)), 1e-6 * width * height * np.square(SCALES)), axis=1)
        (fixed, pixels), _ = nnls(design / seconds[:, None], np.ones(len(SCALES)))
        errors = [float(np.sqrt(np.mean(np.square(picture - truth)))) for picture, _ in renders]
        front.append(
            {
                "tier": tier,
                "fixed": round(1000.0 * float(fixed), 2),
                # Noise may hide the cost of a pixel, which is never zero.
                "pixels": round(max(1.0, 1000.0 * float(pixels)), 2),
                "errors": [round(error, 2) for error in errors],
            }
        )
    return front


def main(names: Sequence[str]) -> None:
    """Measure these presets; of none: those that the file lacks, or of other tiers."""
    kept: dict[str, Any] = {"scales": SCALES, "presets": {}}
    if FILE.is_file():
        kept = json.loads(FILE.read_text(encoding="utf-8"))
    executor = Executor()
    try:
        for name in preset_names():
            known = [cost["tier"] for cost in kept["presets"].get(name, [])]
            if name in names or (not names and known != list(MOVING)):
                kept["presets"][name] = front_of(executor, load_preset(name))
                print(name, *kept["presets"][name], sep="\n  ", flush=True)
                fronts = {each: kept["presets"][each] for each in preset_names() if each in kept["presets"]}
                lines = ",\n".join(f"  {json.dumps(each)}: {json.dumps(front)}" for each, front in fronts.items())
                FILE.write_text(f'{{"scales": {json.dumps(SCALES)},\n "presets": {{\n{lines}\n}}}}\n', encoding="utf-8")
    finally:
        executor.close()


if __name__ == "__main__":
    main(sys.argv[1:])
