"""The recipe of a frame: everything that its bytes depend on, as text that its PNG carries.

The web client reads it back (``webclient/src/take/recipe.ts``), and writes the same members into its own PNG files.
"""

import json
from collections.abc import Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from seafoam.quality import TIERS, Quality

if TYPE_CHECKING:
    from seafoam.render.service.jobs import FrameJob

RECIPE_VERSION = 1


def described(quality: Quality) -> str | dict[str, Any]:
    """Return the name of the tier with these settings, or the settings that differ from tier standard."""
    tier = next((name for name, settings in TIERS.items() if settings == quality), None)
    return tier or quality.model_dump(mode="json", exclude_defaults=True)


def recipe_of(job: "FrameJob", info: Mapping[str, str]) -> str:
    """Return a frame's recipe as JSON with sorted keys: the same job on the same renderer gives the same text.

    ``time`` is in seconds, ``width`` and ``height`` in pixels; ``scene``, ``quality``, ``camera`` and ``preset`` are
    what ``/api/frames`` takes. info: the renderer's ``renderer`` and ``version``.
    """
    document = {
        "recipe": RECIPE_VERSION,
        "seafoam": version("seafoam"),
        "renderer": f"{info['renderer']}, {info['version']}",
        "preset": job.preset,
        # With the frame's camera, whether it was sent in the scene or beside it: the same frame has the same bytes.
        "scene": job.scene.model_copy(update={"camera": job.camera}).model_dump(mode="json"),
        "quality": described(job.quality),
        "camera": job.camera.model_dump(mode="json"),
        "time": job.time,
        "width": job.width,
        "height": job.height,
    }
    return json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
