"""Presets: named scenes with title and summary."""

import json
from functools import lru_cache
from pathlib import Path
from typing import Literal, get_args

from pydantic import Field

from seafoam.scene.base import Part
from seafoam.scene.models import Scene

_DIRECTORY = Path(__file__).parent / "presets"

Group = Literal["Seas", "Light and objects", "Shores", "Lakes and rivers", "Figures of the paper"]
"""Headings of the menu under which presets are listed, in menu order."""


class Preset(Part):
    """A named scene with a recommended time and size."""

    name: str
    group: Group = Field(description="Heading of the menu under which the preset is listed")
    order: int = Field(description="Position within its group")
    title: str
    summary: str
    size: tuple[int, int] = Field(description="Recommended width and height, pixels")
    time: float = Field(default=0.0, description="Recommended time, s")
    scene: Scene


@lru_cache(maxsize=1)
def _presets() -> dict[str, Preset]:
    found = [
        Preset.model_validate({"name": path.stem, **json.loads(path.read_text(encoding="utf-8"))})
        for path in sorted(_DIRECTORY.glob("*.json"))
    ]
    return {preset.name: preset for preset in sorted(found, key=_place)}


def _place(preset: Preset) -> tuple[int, int]:
    return get_args(Group).index(preset.group), preset.order


def preset_names() -> tuple[str, ...]:
    """Return the names of all presets, in menu order."""
    return tuple(_presets())


def load_preset(name: str) -> Preset:
    """Return a preset by name. Raises ``KeyError`` if there is none."""
    return _presets()[name]
