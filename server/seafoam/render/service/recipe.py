"""The recipe of a frame, text that its file carries: :meth:`seafoam.render.service.jobs.FrameJob.recipe` writes it.

``seafoam render --again`` draws the frame from it once more (:mod:`seafoam.cli.again`). The web client reads that of
PNG files back (``webclient/src/take/recipe.ts``), and writes the same members into its own PNG files.
"""

from collections.abc import Mapping
from typing import Any

from seafoam.quality import TIERS, Quality

RECIPE_VERSION = 1


def described(quality: Quality) -> str | dict[str, Any]:
    """Return the name of the tier with these settings, or the settings that differ from tier standard."""
    tier = next((name for name, settings in TIERS.items() if settings == quality), None)
    return tier or quality.model_dump(mode="json", exclude_defaults=True)


def renderer_of(info: Mapping[str, str]) -> str:
    """Return a renderer as recipes name it. info: its ``renderer`` and ``version``."""
    return f"{info['renderer']}, {info['version']}"
