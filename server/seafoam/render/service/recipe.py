"""The recipe of a frame: everything that its bytes depend on, as text that its file carries.

``seafoam render --again`` draws the frame from it once more (:mod:`seafoam.cli.again`). The web client reads that of
PNG files back (``webclient/src/take/recipe.ts``), and writes the same members into its own PNG files.
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


def renderer_of(info: Mapping[str, str]) -> str:
    """Return a renderer as recipes name it. info: its ``renderer`` and ``version``."""
    return f"{info['renderer']}, {info['version']}"


def recipe_of(job: "FrameJob", info: Mapping[str, str], plan: str) -> str:
    """Return a frame's recipe as JSON with sorted keys: the same job on the same renderer gives the same text.

    ``time`` is in seconds, ``width`` and ``height`` in pixels; ``scene``, ``quality``, ``camera`` and ``preset`` are
    what ``/api/frames`` takes, as are ``dither`` and ``precision``, which only the formats that they concern have.
    info: the renderer's ``renderer`` and ``version``. plan: SHA-256 of the frame plan.
    """
    document = {
        "recipe": RECIPE_VERSION,
        "seafoam": version("seafoam"),
        "renderer": renderer_of(info),
        "plan": plan,
        "format": job.format,
        "preset": job.preset,
        # With the frame's camera, whether it was sent in the scene or beside it: the same frame has the same bytes.
        "scene": job.scene.model_copy(update={"camera": job.camera}).model_dump(mode="json"),
        "quality": described(job.quality),
        "camera": job.camera.model_dump(mode="json"),
        "time": job.time,
        "width": job.width,
        "height": job.height,
        **({"dither": job.dither} if job.format in ("png", "webp") else {}),
        **({"precision": job.precision} if job.format == "exr" else {}),
    }
    return json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
